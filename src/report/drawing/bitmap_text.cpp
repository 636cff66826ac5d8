// Text in pictures, in the letters of stb_easy_font.
#include <cstring>

#include "report/drawing/bitmap.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

namespace enfilade {

namespace {

/// A corner as stb_easy_font writes it.
struct Corner {
  float x, y, z;
  unsigned char colour[4];
};
static_assert(sizeof(Corner) == 16);

}  // namespace

void draw_text(Bitmap& bitmap, int x, int y, const std::string& text, Rgb8 colour, int scale) {
  std::string line = text;
  std::vector<Corner> corners(line.size() * 80);  // a letter takes at most some 20 quads
  const int quads = stb_easy_font_print(0.0f, 0.0f, line.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  for (int q = 0; q < quads; ++q) {
    const Corner& low = corners[static_cast<std::size_t>(4 * q)];
    const Corner& high = corners[static_cast<std::size_t>(4 * q + 2)];
    const int x0 = static_cast<int>(low.x) * scale, y0 = static_cast<int>(low.y) * scale;
    bitmap.fill(x + x0, y + y0, static_cast<int>(high.x) * scale - x0,
                static_cast<int>(high.y) * scale - y0, colour);
  }
}

int text_width(const std::string& text, int scale) {
  std::string line = text;
  return stb_easy_font_width(line.data()) * scale;
}

}  // namespace enfilade
