#include "import/radiance/radiance_material.hpp"

#include <numbers>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using std::numbers::pi;

RadianceMaterial material(const std::string& text) {
  RadianceText words("m.rad", text);
  return radiance_material(read_radiance_primitive(words));
}

auto near(double a, double b, double c) {
  return ElementsAre(DoubleNear(a, 1e-12), DoubleNear(b, 1e-12), DoubleNear(c, 1e-12));
}

TEST(RadianceMaterial, DiffusePartOfReflectingOnes) {
  EXPECT_THAT(material("void plastic m 0 0 5 .5 .4 .3 0 0").reflectance, near(0.5, 0.4, 0.3));
  EXPECT_TRUE(material("void plastic m 0 0 5 .5 .4 .3 0 0").losses.empty());
  const RadianceMaterial metal = material("void metal m 0 0 5 .5 .4 .3 .8 .1");
  EXPECT_THAT(metal.reflectance, near(0.1, 0.08, 0.06));
  EXPECT_THAT(metal.losses, ElementsAre(HasSubstr("specular")));
  EXPECT_FALSE(metal.emits());
  const RadianceMaterial trans = material("void trans m 0 0 7 .5 .4 .3 .1 0 .5 .2");
  EXPECT_THAT(trans.reflectance, near(0.225, 0.18, 0.135));
  EXPECT_THAT(trans.losses, ElementsAre(HasSubstr("specular"), HasSubstr("transmission")));
  EXPECT_THAT(material("void trans2 m 4 0 0 1 . 0 8 .5 .5 .5 0 .1 .2 .4 0").reflectance,
              near(0.3, 0.3, 0.3));
  EXPECT_THAT(material("void transfunc m 2 f g.cal 0 6 .5 .5 .5 .2 .5 0").reflectance,
              near(0.2, 0.2, 0.2));
}

TEST(RadianceMaterial, RadianceBecomesExitance) {
  for (const char* text : {"void light m 0 0 3 1 2 3", "void glow m 0 0 4 1 2 3 -1",
                           "void illum m 1 glass 0 3 1 2 3"}) {
    const RadianceMaterial emitter = material(text);
    EXPECT_THAT(emitter.exitance, near(pi, 2 * pi, 3 * pi)) << text;
    EXPECT_FALSE(emitter.reflects());
  }
  // A half angle of 30 degrees holds a quarter of the flux.
  const RadianceMaterial spot = material("void spotlight m 0 0 7 4 8 0 60 0 0 -1");
  EXPECT_THAT(spot.exitance, near(pi, 2 * pi, 0));
  EXPECT_TRUE(spot.losses.empty());
  ASSERT_TRUE(spot.distribution);
  EXPECT_NEAR(spot.distribution->data->flux(), pi / 4.0, 1e-3);
  EXPECT_LT(glm::length(spot.distribution->frame(glm::dmat3(1.0)).aim - Vec3(0, 0, -1)), 1e-12);
}

TEST(RadianceMaterial, WhatHasNoDiffusePart) {
  for (const char* text : {"void mirror m 0 0 3 .9 .9 .9"}) {
    const RadianceMaterial black = material(text);
    EXPECT_FALSE(black.reflects() || black.emits() || black.passes_light) << text;
    EXPECT_THAT(black.losses, ElementsAre(HasSubstr("taken as black")));
  }
  EXPECT_TRUE(material("void antimatter m 1 void 0 0").passes_light);
}

// Radiance's manual: a transmissivity of 0.96 is a transmittance of 0.88 at normal incidence.
TEST(RadianceMaterial, GlassPassesLight) {
  const RadianceMaterial pane = material("void glass m 0 0 3 .96 .3 0");
  ASSERT_EQ(pane.transmittance.size(), 3u);
  EXPECT_NEAR(pane.transmittance[0], 0.88, 2e-3);
  EXPECT_NEAR(pane.transmittance[1], 0.275, 1e-3);
  EXPECT_EQ(pane.transmittance[2], 0.0);
  EXPECT_FALSE(pane.reflects() || pane.emits() || pane.passes_light);
  EXPECT_TRUE(pane.losses.empty());
}

TEST(RadianceMaterial, OutOfRange) {
  const RadianceMaterial white = material("void plastic m 0 0 5 1 .5 1.2 0 0");
  EXPECT_THAT(white.reflectance, near(0.999, 0.5, 0.999));
  EXPECT_THAT(white.losses, ElementsAre(HasSubstr("0.999")));
  const auto fault = [](const std::string& text) { return input_error([&] { material(text); }); };
  EXPECT_THAT(fault("void plastic m\n0 0 4 1 1 1 0"),
              HasSubstr("m.rad: line 1: plastic \"m\" has 4 numbers, not 5"));
  EXPECT_THAT(fault("void plastic m 0 0 5 -1 1 1 0 0"), HasSubstr("color below zero"));
  EXPECT_THAT(fault("void plastic m 0 0 5 1 1 1 1.5 0"), HasSubstr("number 4 is outside 0..1"));
  EXPECT_THAT(fault("void light m 0 0 3 1 -2 1"), HasSubstr("color below zero"));
  EXPECT_THAT(fault("void light m 0 0 3 1 1e308 1"), HasSubstr("too bright"));
  EXPECT_THAT(fault("void light m 0 0 3 1 1e400 1"), HasSubstr("finite number"));
}

}  // namespace
}  // namespace enfilade
