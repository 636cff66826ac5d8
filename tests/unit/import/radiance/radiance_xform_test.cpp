#include "import/radiance/radiance_xform.hpp"

#include "import/radiance/radiance_command.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const RadiancePlace place{"room.rad", 3};

RadianceXform xform(const std::string& options) {
  return parse_radiance_command("xform " + options, place).xform;
}

Vec3 image(const std::string& options, const Vec3& p) {
  return xform(options + " a.rad").copies.at(0).image_of({p})[0];
}

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(glm::length(a - b), 1e-12) << a.x; }

TEST(RadianceXform, EachStepAlone) {
  const Vec3 p(1, 2, 3);
  expect_near(image("-t 1 -2 .5", p), {2, 0, 3.5});
  expect_near(image("-s 2", p), {2, 4, 6});
  expect_near(image("-rx 90", p), {1, -3, 2});
  expect_near(image("-ry 90", p), {3, 2, -1});
  expect_near(image("-rz +90", p), {-2, 1, 3});
  expect_near(image("-mx", p), {-1, 2, 3});
  expect_near(image("-my -mz", p), {1, -2, -3});
}

TEST(RadianceXform, StepsAreTakenInOrder) {
  expect_near(image("-t 1 0 0 -rz 90", {0, 0, 0}), {0, 1, 0});
  expect_near(image("-rz 90 -t 1 0 0", {0, 0, 0}), {1, 0, 0});
  expect_near(image("-t 1 1 1 -s 3 -mx -t 10 0 0", {1, 0, 0}), {4, 3, 3});
}

TEST(RadianceXform, AMirrorKeepsTheFrontInFront) {
  const Polygon up{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const auto normal_after = [&](const std::string& options) {
    return normal(xform(options + " a.rad").copies.at(0).image_of(up));
  };
  expect_near(normal_after("-mx"), {0, 0, 1});
  expect_near(normal_after("-mz"), {0, 0, -1});
  expect_near(normal_after("-mx -my"), {0, 0, 1});
}

TEST(RadianceXform, NamesAndFiles) {
  const RadianceXform named = xform("-n desk a.rad sub/b.rad");
  EXPECT_EQ(named.prefix, "desk");
  EXPECT_THAT(named.files, ElementsAre("a.rad", "sub/b.rad"));
  const RadianceXform piped =
      parse_radiance_command("xform -n in a.rad | xform -n out -m white -I", place).xform;
  EXPECT_EQ(piped.prefix, "out.in");
  EXPECT_EQ(piped.modifier, "white");
  EXPECT_TRUE(piped.inverts);
}

TEST(RadianceXform, ArraysAndIterations) {
  const RadianceXform array = xform("-t 0 0 7 -a 3 -t 1 0 0 -a 2 -t 0 5 0 -i 2 -t 0 0 1 a.rad");
  ASSERT_EQ(array.copies.size(), 6u);
  expect_near(array.copies.front().shift, {0, 0, 9});
  expect_near(array.copies.back().shift, {2, 5, 9});
  EXPECT_THAT(input_error([] { xform("-a 2000 -t 1 0 0 -a 2000 -t 0 1 0 a.rad"); }),
              HasSubstr("more than 1000000 copies"));
  EXPECT_THAT(input_error([] { xform("-a 1.5 -t 1 0 0 a.rad"); }), HasSubstr("no fitting count"));
}

TEST(RadianceXform, AnythingElseIsRefusedWithAWayOut) {
  const auto fault = [](const std::string& command) {
    return input_error([&] { parse_radiance_command(command, place); });
  };
  for (const char* command :
       {"gensurf grey b 1 1 1", "xform a.rad | rm b", "", "xform $HOME/a.rad", "xform a.rad; rm b",
        "xformer a.rad", "xform -rw 3 a", "cat -n a.rad", "genbox g b 1 1 1 |"})
    EXPECT_THAT(fault(command), HasSubstr("xform -e model.rad")) << command;
  EXPECT_THAT(fault("gensurf grey b 1 1 1"), testing::StartsWith("room.rad: line 3: the command"));
  EXPECT_THAT(fault("xform -t 1 2"), HasSubstr("breaks off after -t"));
  EXPECT_THAT(fault("xform -t 1 2 a.rad"), HasSubstr("\"a.rad\" stands where a finite number"));
  EXPECT_THAT(fault("xform -s 0 a.rad"), HasSubstr("scale"));
  EXPECT_THAT(fault("xform -s 2"), HasSubstr("names no file"));
  EXPECT_THAT(fault("genbox grey b 1 1"), HasSubstr("breaks off before the size"));
  EXPECT_THAT(fault("genprism grey b 2 0 0 1 1"), HasSubstr("no fitting number of corners"));
}

}  // namespace
}  // namespace enfilade
