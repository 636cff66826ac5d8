#include "report/walk/walk_arrays.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"
#include "unit/report/walk/unpacked.hpp"

namespace enfilade {
namespace {

using test::numbers;

TEST(WalkArrays, HoldTheLightOfEachPlace) {
  test::LitRooms rooms(2, 3);
  rooms.subdivide(1.0);
  const auto light = [](const Vec3& p) { return 10.0 + 3.0 * p.x - 2.0 * p.y + p.z; };
  rooms.set_irradiance(light);
  const LightChannels channels(rooms.scene);
  const WalkStoreys storeys(rooms.solved(), {});
  const WalkArrays made = walk_arrays(rooms.solved(), channels, storeys);
  auto found = test::unpacked(made.arrays);
  const auto frames = numbers<float>(found["frames"]), points = numbers<float>(found["points"]),
             middles = numbers<float>(found["middles"]),
             exitance = numbers<float>(found["exitance"]);
  const auto point_count = numbers<std::uint32_t>(found["point_count"]),
             face_count = numbers<std::uint32_t>(found["face_count"]),
             corners = numbers<std::uint32_t>(found["corners"]);
  const auto corner_count = numbers<std::uint16_t>(found["corner_count"]),
             halves = numbers<std::uint16_t>(found["light"]);
  const auto outside = numbers<std::uint8_t>(found["outside"]);
  // Two rooms of 6 faces and a lamp, and the shell of 6 faces, which lies in no cell.
  ASSERT_EQ(point_count.size(), 20u);
  ASSERT_EQ(made.polygons, 20u);
  ASSERT_EQ(exitance.size(), 60u);
  EXPECT_EQ(exitance[3 * 6 + 1], 100.0f);
  std::size_t face = 0, corner = 0, first_point = 0, at = 0, checked = 0;
  for (std::size_t k = 0; k < made.polygons; ++k) {
    EXPECT_EQ(outside[k], k >= 14 ? 1 : 0);
    const auto place = [&](float x, float y) {
      Vec3 p = made.centre;
      for (int c = 0; c < 3; ++c)
        p[c] += frames[9 * k + static_cast<std::size_t>(c)] +
                x * frames[9 * k + 3 + static_cast<std::size_t>(c)] +
                y * frames[9 * k + 6 + static_cast<std::size_t>(c)];
      return p;
    };
    const auto check = [&](const Vec3& p) {
      for (int c = 0; c < 3; ++c, ++at) {
        const double expected = k < 14 ? light(p) : 0.0;
        EXPECT_NEAR(made.scale * test::from_half(halves[at]), expected,
                    std::abs(expected) / 2048.0 + 1e-4);
        ++checked;
      }
    };
    for (std::uint32_t i = 0; i < face_count[k]; ++i, ++face) {
      for (std::uint16_t j = 0; j < corner_count[face]; ++j, ++corner) {
        ASSERT_LT(corners[corner], point_count[k]);
        const std::size_t p = first_point + corners[corner];
        check(place(points[2 * p], points[2 * p + 1]));
      }
      check(place(middles[2 * face], middles[2 * face + 1]));
    }
    first_point += point_count[k];
  }
  EXPECT_EQ(checked, halves.size());
  EXPECT_EQ(face, made.faces);
  EXPECT_EQ(corner, made.corners);
  EXPECT_GT(face, 60u);
}

TEST(WalkArrays, ComeWithTheShareOfEachLamp) {
  // The wide states hold the whole light, then a quarter of it and the rest.
  test::LitRooms rooms, wide(1, 3);
  rooms.set_irradiance([](const Vec3& p) { return 4.0 + p.x; });
  wide.set_irradiance([](const Vec3& p) { return 4.0 + p.x; });
  const LightChannels channels(rooms.scene);
  const WalkStoreys storeys(rooms.solved(), {});
  const WalkShares shares{{"left", "right"}, wide.states};
  const WalkArrays made = walk_arrays(rooms.solved(), channels, storeys, shares);
  auto found = test::unpacked(made.arrays);
  ASSERT_EQ(made.scales.size(), 2u);
  const auto whole = numbers<std::uint16_t>(found["light"]),
             first = numbers<std::uint16_t>(found["share_0"]),
             lamp = numbers<std::uint16_t>(found["lamp"]);
  EXPECT_EQ(first, whole);  // alike in all bands here, and so in the same units
  EXPECT_EQ(found["share_1"], found["light"]);
  ASSERT_EQ(lamp.size(), 13u);
  EXPECT_EQ(lamp[0], 0);
  EXPECT_EQ(lamp[6], 1) << "the first share in which the lamp shines";
}

}  // namespace
}  // namespace enfilade
