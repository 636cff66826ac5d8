#include "report/drawing/bitmap.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>

namespace enfilade {
namespace {

Bitmap decoded(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  image.format = PNG_FORMAT_RGB;
  Bitmap bitmap(static_cast<int>(image.width), static_cast<int>(image.height));
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, bitmap.pixels.data(), 0, nullptr));
  return bitmap;
}

TEST(Bitmap, PngHoldsEveryPixel) {
  Bitmap bitmap(37, 11);
  for (std::size_t i = 0; i < bitmap.pixels.size(); ++i) {
    bitmap.pixels[i] = {static_cast<std::uint8_t>(i * 7), static_cast<std::uint8_t>(i * 13),
                        static_cast<std::uint8_t>(i * 29)};
  }
  const Bitmap back = decoded(encode_png(bitmap, "a picture"));
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 11);
  EXPECT_EQ(back.pixels, bitmap.pixels);
}

TEST(Bitmap, FillIsCutAtTheEdges) {
  Bitmap bitmap(4, 3);
  bitmap.fill(-5, 1, 7, 9, {9, 9, 9});
  EXPECT_EQ(std::count(bitmap.pixels.begin(), bitmap.pixels.end(), Rgb8{9, 9, 9}), 2 * 2);
  EXPECT_EQ(bitmap.at(1, 2), (Rgb8{9, 9, 9}));
  EXPECT_EQ(bitmap.at(2, 2), (Rgb8{0, 0, 0}));
}

TEST(Bitmap, TextCoversWhatItsWidthSays) {
  Bitmap bitmap(200, 30);
  draw_text(bitmap, 10, 5, "100 lx", {255, 255, 255}, 2);
  int first = 200, last = 0, ink = 0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (bitmap.at(x, y)[0] == 0) continue;
      ++ink;
      first = std::min(first, x);
      last = std::max(last, x);
    }
  }
  EXPECT_GT(ink, 100);
  EXPECT_GE(first, 10);
  EXPECT_LT(last, 10 + text_width("100 lx", 2));
  EXPECT_GT(last, 10 + text_width("100 l", 2) - 4);
}

}  // namespace
}  // namespace enfilade
