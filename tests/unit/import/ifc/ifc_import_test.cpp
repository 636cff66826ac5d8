#include "import/ifc/ifc_import.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <string>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

/// An IFC file with a building of one storey (#10), lengths in millimetres; `entities` follow.
std::string model(const std::string& entities, const std::string& schema = "IFC4") {
  return "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
         "FILE_NAME('x','2020-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('" +
         schema +
         "'));\nENDSEC;\nDATA;\n"
         "#1=IFCCARTESIANPOINT((0.,0.,0.));\n#2=IFCAXIS2PLACEMENT3D(#1,$,$);\n"
         "#3=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#2,$);\n"
         "#4=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n#6=IFCUNITASSIGNMENT((#4));\n"
         "#7=IFCPROJECT('0000000000000000000001',$,'P',$,$,$,$,(#3),#6);\n"
         "#8=IFCLOCALPLACEMENT($,#2);\n"
         "#9=IFCBUILDING('0000000000000000000002',$,'B',$,$,#8,$,$,.ELEMENT.,$,$,$);\n"
         "#10=IFCBUILDINGSTOREY('0000000000000000000003',$,'Ground',$,$,#8,$,$,.ELEMENT.,0.);\n"
         "#11=IFCRELAGGREGATES('0000000000000000000004',$,$,$,#7,(#9));\n"
         "#12=IFCRELAGGREGATES('0000000000000000000005',$,$,$,#9,(#10));\n"
         "#13=IFCDIRECTION((0.,0.,1.));\n" +
         entities + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// A box from (x, y, z) to (x + w, y + d, z + h); its solid is #first, its product shape
/// #(first + 9).
std::string box(int first, double x, double y, double z, double w, double d, double h) {
  const auto n = [&](int i) { return "#" + std::to_string(first + i); };
  const auto at = [&](double px, double py) {
    return "((" + std::to_string(px) + "," + std::to_string(py) + "))";
  };
  return n(1) + "=IFCCARTESIANPOINT" + at(x, y) + ";\n" + n(2) + "=IFCCARTESIANPOINT" +
         at(x + w, y) + ";\n" + n(3) + "=IFCCARTESIANPOINT" + at(x + w, y + d) + ";\n" + n(4) +
         "=IFCCARTESIANPOINT" + at(x, y + d) + ";\n" + n(5) + "=IFCPOLYLINE((" + n(1) + "," + n(2) +
         "," + n(3) + "," + n(4) + "," + n(1) + "));\n" + n(6) +
         "=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$," + n(5) + ");\n" + n(7) +
         "=IFCCARTESIANPOINT((0.,0.," + std::to_string(z) + "));\n" + n(10) +
         "=IFCAXIS2PLACEMENT3D(" + n(7) + ",$,$);\n" + n(0) + "=IFCEXTRUDEDAREASOLID(" + n(6) +
         "," + n(10) + ",#13," + std::to_string(h) + ");\n" + n(8) +
         "=IFCSHAPEREPRESENTATION(#3,'Body','SweptSolid',(" + n(0) + "));\n" + n(9) +
         "=IFCPRODUCTDEFINITIONSHAPE($,$,(" + n(8) + "));\n";
}

const std::string wall =
    box(100, 0, 0, 0, 4000, 200, 3000) +
    "#120=IFCWALL('0000000000000000000010',$,'wall',$,$,#8,#109,$,$);\n"
    "#121=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000011',$,$,$,(#120),#10);\n";
const std::string opening =
    box(200, 1000, -100, 1000, 1000, 400, 1000) +
    "#220=IFCOPENINGELEMENT('0000000000000000000020',$,'hole',$,$,#8,#209,$,.OPENING.);\n"
    "#221=IFCRELVOIDSELEMENT('0000000000000000000021',$,$,$,#120,#220);\n";

struct Imported {
  Scene scene;
  std::string warnings;
};

class IfcImport : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("node --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs Node.js";
  }
  static Imported import(const std::string& text, const ImportOptions& options = {}) {
    const TemporaryFolder folder;
    Warnings warnings;
    Scene scene = import_ifc(folder.write("m.ifc", text), options, warnings);
    return {std::move(scene), all_warnings(warnings)};
  }
  static std::string fault(const std::string& text) {
    return input_error([&] { import(text); });
  }
  static double area_of(const Scene& scene) {
    double area = 0.0;
    for (const Surface& surface : scene.surfaces) area += area_m2(surface.vertices);
    return area;
  }
};

TEST_F(IfcImport, OpeningsAreCutExactlyAndBecomePortals) {
  for (const char* schema : {"IFC2X3", "IFC4", "IFC4X3"}) {
    std::string text = model(wall + opening, schema);
    if (std::string(schema) == "IFC2X3") {  // walls and openings have one attribute less there
      text.replace(text.find("#109,$,$);"), 10, "#109,$);");
      text.replace(text.find("#209,$,.OPENING.);"), 18, "#209,$);");
    }
    const auto [scene, warnings] = import(text);
    EXPECT_NEAR(area_of(scene), 26.8 - 2.0 + 0.8, 1e-3) << schema;
    ASSERT_EQ(scene.building.portals.size(), 1u) << schema;
    EXPECT_EQ(scene.building.portals[0].kind, "IfcOpeningElement");
    EXPECT_LT(glm::length(scene.building.portals[0].box.hi - Vec3(2, 0.3, 2)), 1e-4);
    EXPECT_FALSE(scene.surfaces[0].two_sided);  // a solid
    EXPECT_EQ(scene.surfaces[0].object, "IfcWall/120@Ground");
    EXPECT_THAT(warnings, HasSubstr("\"wall\": has no colour: reflectance taken as 0.5"));
  }
}

TEST_F(IfcImport, SolidsFaceOutward) {
  const Scene scene = import(model(wall)).scene;
  double volume = 0.0;
  for (const Surface& surface : scene.surfaces)
    volume += glm::dot(surface.vertices[0], 0.5 * area_vector(surface.vertices)) / 3.0;
  EXPECT_NEAR(volume, 4.0 * 0.2 * 3.0, 1e-4);
}

TEST_F(IfcImport, ColoursAndGlass) {
  const std::string style =
      "#30=IFCCOLOURRGB($,0.2,0.4,0.6);\n#31=IFCSURFACESTYLERENDERING(#30,0.,$,$,$,$,$,$,.FLAT.);\n"
      "#32=IFCSURFACESTYLE($,.BOTH.,(#31));\n#33=IFCSTYLEDITEM(#100,(#32),$);\n";
  const auto [scene, warnings] = import(model(wall + style));
  EXPECT_NEAR(scene.surfaces[0].reflectance[1], 0.4, 1e-6);
  EXPECT_THAT(warnings, testing::Not(HasSubstr("no colour")));
  const std::string window =
      opening + box(300, 1000, 90, 1000, 1000, 20, 1000) +
      "#320=IFCWINDOW('0000000000000000000030',$,'pane',$,$,#8,#309,$,1000.,1000.,$,$,$);\n"
      "#321=IFCRELFILLSELEMENT('0000000000000000000031',$,$,$,#220,#320);\n"
      "#330=IFCSURFACESTYLERENDERING(#30,0.8,$,$,$,$,$,$,.FLAT.);\n"
      "#332=IFCSURFACESTYLE($,.BOTH.,(#330));\n#333=IFCSTYLEDITEM(#300,(#332),$);\n";
  const Imported glazed = import(model(wall + style + window));
  double opaque_m2 = 0.0, passed = 1.0;
  for (const Surface& surface : glazed.scene.surfaces) {
    if (!surface.is_pane()) opaque_m2 += area_m2(surface.vertices);
    if (surface.is_pane() && area_m2(surface.vertices) > 0.9) passed *= surface.transmittance[0];
  }
  EXPECT_NEAR(opaque_m2, 25.6, 1e-3);
  EXPECT_NEAR(passed, 0.8, 1e-6);
  // One pane, so that light at an angle is dimmed once: not two faces with the root of it.
  EXPECT_EQ(std::ranges::count_if(glazed.scene.surfaces, &Surface::is_pane), 1);
  ASSERT_EQ(glazed.scene.building.portals.size(), 1u);
  EXPECT_EQ(glazed.scene.building.portals[0].kind, "IfcWindow");
  EXPECT_NEAR(glazed.scene.building.portals[0].transmittance, 0.8, 1e-6);
  EXPECT_LT(glm::length(glazed.scene.building.portals[0].box.lo - Vec3(1, -0.1, 1)), 1e-4);
}

TEST_F(IfcImport, TheDiffuseColourOfARenderingIsItsReflectance) {
  const auto red_of = [](const std::string& diffuse) {
    return import(model(wall +
                        "#29=IFCCOLOURRGB($,0.2,0.3,0.4);\n#30=IFCCOLOURRGB($,0.8,0.6,0.4);\n"
                        "#31=IFCSURFACESTYLERENDERING(#30,0.," +
                        diffuse +
                        ",$,$,$,$,$,.FLAT.);\n#32=IFCSURFACESTYLE($,.BOTH.,(#31));\n"
                        "#33=IFCSTYLEDITEM(#100,(#32),$);\n"))
        .scene.surfaces[0]
        .reflectance[0];
  };
  EXPECT_NEAR(red_of("$"), 0.8, 1e-6);
  EXPECT_NEAR(red_of("#29"), 0.2, 1e-6);
  EXPECT_NEAR(red_of("IFCNORMALISEDRATIOMEASURE(0.5)"), 0.4, 1e-6);
  EXPECT_NEAR(red_of("IFCNORMALISEDRATIOMEASURE(0.)"), 0.8, 1e-6);  // written for none
}

TEST_F(IfcImport, ASpaceMayHaveABoundingBoxAlone) {
  const auto [scene, warnings] = import(model(
      wall +
      "#400=IFCCARTESIANPOINT((500.,0.,0.));\n#401=IFCBOUNDINGBOX(#400,4000.,5000.,3000.);\n"
      "#402=IFCSHAPEREPRESENTATION(#3,'Box','BoundingBox',(#401));\n"
      "#403=IFCPRODUCTDEFINITIONSHAPE($,$,(#402));\n#404=IFCCARTESIANPOINT((1000.,2000.,100.));\n"
      "#405=IFCDIRECTION((0.,1.,0.));\n#406=IFCAXIS2PLACEMENT3D(#404,#13,#405);\n"
      "#407=IFCLOCALPLACEMENT(#8,#406);\n"
      "#420=IFCSPACE('0000000000000000000040',$,'101',$,$,#407,#403,$,.ELEMENT.,$,$);\n"));
  ASSERT_EQ(scene.building.rooms.size(), 1u);
  const BuildingRoom& room = scene.building.rooms[0];
  EXPECT_LT(glm::length(room.box.lo - Vec3(-4, 2.5, 0.1)), 1e-4);
  EXPECT_LT(glm::length(room.box.hi - Vec3(1, 6.5, 3.1)), 1e-4);
  EXPECT_NEAR(room.floor_area_m2, 20.0, 1e-3);
  EXPECT_EQ(room.outline.size(), 4u);
}

TEST_F(IfcImport, SpacesBecomeRoomsAndFixturesLights) {
  const std::string room =
      box(400, 0, 0, 0, 4000, 5000, 3000) +
      "#420=IFCSPACE('0000000000000000000040',$,'101',$,$,#8,#409,'Office',.ELEMENT.,$,$);\n"
      "#421=IFCRELAGGREGATES('0000000000000000000041',$,$,$,#10,(#420));\n"
      "#422=IFCPROPERTYSINGLEVALUE('Illuminance',$,IFCILLUMINANCEMEASURE(500.),$);\n"
      "#423=IFCPROPERTYSET('0000000000000000000042',$,'Pset_SpaceLightingRequirements',$,(#422));\n"
      "#424=IFCRELDEFINESBYPROPERTIES('0000000000000000000043',$,$,$,(#420),#423);\n";
  const std::string lamps =
      box(500, 1900, 2400, 2900, 200, 200, 100) +
      "#520=IFCLIGHTFIXTURE('0000000000000000000050',$,'lamp A',$,$,#8,#509,$,$);\n"
      "#521=IFCPROPERTYSINGLEVALUE('Luminous Flux',$,IFCREAL(3000.),$);\n"
      "#522=IFCPROPERTYSET('0000000000000000000051',$,'Light',$,(#521));\n"
      "#523=IFCRELDEFINESBYPROPERTIES('0000000000000000000052',$,$,$,(#520),#522);\n" +
      box(600, 900, 2400, 2900, 200, 200, 100) +
      "#620=IFCLIGHTFIXTURE('0000000000000000000060',$,'lamp B',$,$,#8,#609,$,$);\n";
  const auto [scene, warnings] = import(model(wall + room + lamps));
  ASSERT_EQ(scene.building.rooms.size(), 1u);
  const BuildingRoom& office = scene.building.rooms[0];
  EXPECT_EQ(office.name + office.long_name + office.storey, "101OfficeGround");
  EXPECT_EQ(office.required_lx, 500.0);
  EXPECT_NEAR(office.floor_area_m2, 20.0, 1e-3);
  EXPECT_EQ(office.outline.size(), 4u);
  EXPECT_LT(glm::length(office.box.hi - Vec3(4, 5, 3)), 1e-4);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(scene.lights[0].intensity[0], 3000.0 / (4.0 * std::numbers::pi), 1e-6);
  EXPECT_LT(glm::length(scene.lights[0].p - Vec3(2, 2.5, 2.89)), 1e-4);
  ASSERT_EQ(scene.building.luminaires.size(), 2u);
  EXPECT_EQ(scene.building.luminaires[0].flux_lm, 3000.0);
  EXPECT_EQ(scene.building.luminaires[0].light, 0);
  EXPECT_EQ(scene.building.luminaires[1].light, -1);
  EXPECT_LT(glm::length(scene.building.luminaires[0].aim - Vec3(0, 0, -1)), 1e-9);
  EXPECT_LT(glm::length(scene.building.luminaires[0].up - Vec3(0, 1, 0)), 1e-9);
  EXPECT_THAT(warnings, HasSubstr("lamp \"lamp B\": tells no luminous flux"));
}

TEST_F(IfcImport, FixturesWithoutABodyShineFromTheirPlace) {
  const std::string place =
      "#500=IFCCARTESIANPOINT((1000.,2000.,2500.));\n#501=IFCAXIS2PLACEMENT3D(#500,$,$);\n"
      "#502=IFCLOCALPLACEMENT(#8,#501);\n";
  // One by the flux of its light source, which has a place of its own, one by a property of its
  // type.
  const std::string source =
      "#510=IFCCOLOURRGB($,1.,1.,1.);\n"
      "#508=IFCCARTESIANPOINT((0.,0.,-200.));\n#509=IFCAXIS2PLACEMENT3D(#508,$,$);\n"
      "#511=IFCLIGHTSOURCEGONIOMETRIC('n',#510,$,$,#509,$,6000.,2500.,.LIGHTEMITTINGDIODE.,$);\n"
      "#512=IFCSHAPEREPRESENTATION(#3,'Lighting','LightSource',(#511));\n"
      "#513=IFCPRODUCTDEFINITIONSHAPE($,$,(#512));\n"
      "#514=IFCLIGHTFIXTURE('0000000000000000000050',$,'a',$,$,#502,#513,$,$);\n";
  const std::string typed =
      "#520=IFCLIGHTFIXTURETYPE('0000000000000000000060',$,'T5',$,$,(#522),$,$,$,.POINTSOURCE.);\n"
      "#521=IFCPROPERTYSINGLEVALUE('LuminousFlux',$,IFCLUMINOUSFLUXMEASURE(1200.),$);\n"
      "#522=IFCPROPERTYSET('0000000000000000000061',$,'Lamp',$,(#521));\n"
      "#523=IFCLIGHTFIXTURE('0000000000000000000062',$,'b',$,$,#502,$,$,$);\n"
      "#524=IFCRELDEFINESBYTYPE('0000000000000000000063',$,$,$,(#523),#520);\n";
  const BuildingData building = import(model(wall + place + source + typed)).scene.building;
  ASSERT_EQ(building.luminaires.size(), 2u);
  EXPECT_EQ(building.luminaires[0].flux_lm, 2500.0);
  EXPECT_EQ(building.luminaires[1].flux_lm, 1200.0);
  EXPECT_EQ(building.luminaires[1].type, "T5");
  EXPECT_LT(glm::length(building.luminaires[0].p - Vec3(1, 2, 2.3)), 1e-6);
  EXPECT_LT(glm::length(building.luminaires[1].p - Vec3(1, 2, 2.5)), 1e-6);
  const std::string spot =
      "#530=IFCCOLOURRGB($,1.,1.,1.);\n"
      "#531=IFCLIGHTSOURCESPOT('beam',#530,$,1000.,#1,100.,0.,0.,0.,#13,1.,0.5,0.3);\n";
  EXPECT_THAT(import(model(wall + spot)).warnings,
              HasSubstr("IfcLightSourceSpot \"beam\": tells no luminous flux: left out"));
}

/// A fixture of type T5 whose light source, of 2500 lm, stands along `axis` and has `data` (#515).
std::string fixture(const std::string& data, const std::string& axis = "0.,0.,1.") {
  return "#500=IFCCARTESIANPOINT((1000.,2000.,2500.));\n#501=IFCAXIS2PLACEMENT3D(#500,$,$);\n"
         "#502=IFCLOCALPLACEMENT(#8,#501);\n#510=IFCCOLOURRGB($,1.,1.,1.);\n"
         "#507=IFCDIRECTION((" +
         axis +
         "));\n"
         "#508=IFCCARTESIANPOINT((0.,0.,0.));\n#509=IFCAXIS2PLACEMENT3D(#508,#507,$);\n"
         "#511=IFCLIGHTSOURCEGONIOMETRIC('n',#510,$,$,#509,$,6000.,2500.,.LIGHTEMITTINGDIODE.,"
         "#515);\n#512=IFCSHAPEREPRESENTATION(#3,'Lighting','LightSource',(#511));\n"
         "#513=IFCPRODUCTDEFINITIONSHAPE($,$,(#512));\n"
         "#514=IFCLIGHTFIXTURE('0000000000000000000050',$,'a',$,'T5',#502,#513,$,$);\n" +
         data;
}

/// A cosine about the axis, of `lumens` for 1000 lm of the lamp, at angles in units of `degrees`.
std::string cosine(double lumens, double degrees = 1.0, int last = 90) {
  std::string angles, candela;
  for (int angle = 0; angle <= last; angle += 5) {
    const char* comma = angle > 0 ? "," : "";
    angles += comma + std::to_string(angle / degrees);
    candela += comma + std::to_string(lumens / std::numbers::pi *
                                      std::max(0.0, std::cos(angle * std::numbers::pi / 180.0)));
  }
  return "(" + angles + "),(" + candela + ")";
}

std::string distribution(const std::string& first, const std::string& second = "") {
  const std::string more = second.empty() ? "" : ",#517";
  return "#515=IFCLIGHTINTENSITYDISTRIBUTION(.TYPE_C.,(#516" + more + "));\n" +
         "#516=IFCLIGHTDISTRIBUTIONDATA(" + first + ");\n" +
         (second.empty() ? "" : "#517=IFCLIGHTDISTRIBUTIONDATA(" + second + ");\n");
}

/// A unit of angles of so many radians.
std::string angle_unit(const std::string& radians) {
  return "#700=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n#701=IFCUNITASSIGNMENT((#704));\n"
         "#702=IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(" +
         radians +
         "),#700);\n"
         "#703=IFCDIMENSIONALEXPONENTS(0,0,0,0,0,0,0);\n"
         "#704=IFCCONVERSIONBASEDUNIT(#703,.PLANEANGLEUNIT.,'u',#702);\n";
}

TEST_F(IfcImport, LightSourcesTellTheirDistributions) {
  const auto light_of = [&](const std::string& entities) {
    const Imported imported = import(model(wall + entities));
    EXPECT_EQ(imported.scene.lights.size(), 1u);
    return imported.scene.lights.at(0);
  };
  const auto towards = [](const LightSource& light, const Vec3& w) {
    return light.intensity[0] * relative_intensity(light, glm::normalize(w));
  };
  const Vec3 down(0, 0, -1);
  // 80% of the lamp's 2500 lm leave the luminaire (linear between angles: 0.1% less).
  for (const LightSource& light :
       {light_of(fixture(distribution("0.," + cosine(800.0)))),
        light_of(angle_unit("1.") +
                 fixture(distribution("0.," + cosine(800.0, 180.0 / std::numbers::pi)))),
        light_of(angle_unit("0.01745329252") +
                 fixture(distribution("0.," + cosine(800.0, 1.0, 180))))}) {
    ASSERT_NE(light.distribution, nullptr);
    EXPECT_NEAR(4.0 * std::numbers::pi * light.intensity[0], 2000.0, 5.0);
    EXPECT_NEAR(towards(light, down), 2000.0 / std::numbers::pi, 0.01);
    EXPECT_EQ(towards(light, -down), 0.0);
  }
  // Planes in any order; a light source that stands on its head shines up.
  const std::string dark = "180.,(0.,90.),(0.,0.)", bright = "0.,(0.,90.),(0.,300.)";
  for (const std::string& planes : {distribution(dark, bright), distribution(bright, dark)}) {
    const LightSource light = light_of(fixture(planes));
    EXPECT_GT(towards(light, light.frame.right + down),
              10.0 * towards(light, -light.frame.right + down));
  }
  const LightSource uplight = light_of(fixture(distribution("0.," + cosine(800.0)), "0.,0.,-1."));
  EXPECT_NEAR(towards(uplight, -down), 2000.0 / std::numbers::pi, 0.01);
  EXPECT_EQ(towards(uplight, down), 0.0);
}

TEST_F(IfcImport, LightDistributionsThatCannotBeAreTold) {
  const Imported uneven =
      import(model(wall + fixture(distribution("0.,(0.,90.),(9.,9.)", "90.,(0.,80.),(9.,9.)"))));
  ASSERT_EQ(uneven.scene.lights.size(), 1u);
  EXPECT_EQ(uneven.scene.lights[0].distribution, nullptr);
  EXPECT_THAT(uneven.warnings,
              HasSubstr("lamp \"a\": has a light distribution that cannot be used"));
  for (const double lumens : {2000.0, 0.8}) {  // candela, and candela for one lumen
    const Imported other = import(model(wall + fixture(distribution("0.," + cosine(lumens)))));
    ASSERT_NE(other.scene.lights.at(0).distribution, nullptr);
    EXPECT_NEAR(4.0 * std::numbers::pi * other.scene.lights[0].intensity[0], 2500.0, 1e-6);
    EXPECT_THAT(other.warnings, HasSubstr("lm for 1000 lm of the lamp"));
  }
}

TEST_F(IfcImport, LightSourcesNameTheirPhotometricFiles) {
  const Imported named = import(model(
      wall +
      fixture("#515=IFCDOCUMENTREFERENCE('http://lamps.example/Panel%20600.ies',$,$,$,$);\n")));
  ASSERT_EQ(named.scene.building.luminaires.size(), 1u);
  EXPECT_EQ(named.scene.building.luminaires[0].file, "Panel 600");
  EXPECT_EQ(named.scene.building.luminaires[0].type, "T5");
}

TEST_F(IfcImport, DoorsMayStandOpen) {
  const std::string door =
      box(300, 1000, 90, 0, 1000, 20, 2000) +
      "#320=IFCDOOR('0000000000000000000030',$,'door',$,$,#8,#309,$,2000.,1000.,$,$,$);\n";
  const double closed = area_of(import(model(wall + door)).scene);
  ImportOptions options;
  options.open_doors = true;
  const Imported open = import(model(wall + door), options);
  EXPECT_NEAR(closed - area_of(open.scene), 2.0 * (2.0 + 0.02 + 0.04), 1e-3);
  EXPECT_EQ(open.scene.building.portals.size(), 1u);
}

TEST_F(IfcImport, MissingEntitiesCostTheirProductAlone) {
  std::string text = model(wall + box(200, 0, 1000, 0, 1000, 1000, 1000) +
                           "#220=IFCSLAB('0000000000000000000020',$,'slab',$,$,#8,#209,$,$);\n");
  const std::size_t at = text.find("#203=");
  text.erase(at, text.find('\n', at) - at);
  const auto [scene, warnings] = import(text);
  EXPECT_NEAR(area_of(scene), 26.8, 1e-3);
  EXPECT_THAT(warnings, HasSubstr("IfcSlab \"slab\": leads to #203, which is not in the file"));
}

TEST_F(IfcImport, TextThatIsCutOffIsTold) {
  std::string text = model(
      wall + "/* #1=( */ #130=( IFCA(1.) IFCB('(') );\n#131=IFCB(#130);\n");  // of several types,
                                                                              // well formed
  EXPECT_EQ(import(text).warnings, "\"wall\": has no colour: reflectance taken as 0.5\n");
  text.erase(text.find("ENDSEC;\nEND-ISO"));
  const Imported cut = import(text);
  EXPECT_NEAR(area_of(cut.scene), 26.8, 1e-3);
  EXPECT_THAT(cut.warnings, HasSubstr("file: ends before END-ISO-10303-21: it is cut off"));
}

TEST_F(IfcImport, FaultsAreOneLine) {
  EXPECT_THAT(fault("hello"), HasSubstr("m.ifc: file: is no STEP file"));
  EXPECT_THAT(fault(model(wall, "CONFIG_CONTROL_DESIGN")),
              HasSubstr("a schema that is not IFC2x3"));
  EXPECT_THAT(fault(model("")), HasSubstr("holds no shapes"));
  EXPECT_THAT(fault(model("#100=IFCCARTESIANPOINT((0.,.2));\n")),
              HasSubstr("line 20: entity #100 has a number that begins with its point"));
  EXPECT_THAT(fault(model("#100=IFCCA000));\n")), HasSubstr("entity #100 closes a parenthesis"));
  EXPECT_THAT(fault(model("#100=IFCWALL;\n")), HasSubstr("has not one list of attributes"));
  ImportOptions options;
  options.units = "mm";
  EXPECT_THAT(input_error([&] { import(model(wall), options); }), HasSubstr("names its own unit"));
}

TEST(IfcProgram, WithoutNodeTheRemedyIsNamed) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH") == nullptr ? "" : std::getenv("PATH");
  ::setenv("PATH", folder.file("").c_str(), 1);
  Warnings warnings;
  const std::string error =
      input_error([&] { import_ifc(folder.write("m.ifc", model(wall)), {}, warnings); });
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(error, HasSubstr("needs Node.js to be imported, which is not installed; install it"));
}

}  // namespace
}  // namespace enfilade
