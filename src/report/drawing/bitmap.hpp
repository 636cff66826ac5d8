// 8-bit pictures and PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace enfilade {

using Rgb8 = std::array<std::uint8_t, 3>;

/// sRGB, rows from the top.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<Rgb8> pixels;

  Bitmap() = default;
  Bitmap(int w, int h, Rgb8 fill = {0, 0, 0})
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
  Rgb8& at(int x, int y) {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const Rgb8& at(int x, int y) const { return const_cast<Bitmap*>(this)->at(x, y); }
  void fill(int x, int y, int w, int h, Rgb8 colour);
};

/// Returns the bytes of a PNG file; `text` goes into it as its "Description".
std::string encode_png(const Bitmap& bitmap, const std::string& text = {});

/// Draws one line of text with its upper left corner at (x, y), `scale` times 8 pixels high.
void draw_text(Bitmap& bitmap, int x, int y, const std::string& text, Rgb8 colour, int scale = 1);
/// Returns the width in pixels of what draw_text would draw.
int text_width(const std::string& text, int scale = 1);

}  // namespace enfilade
