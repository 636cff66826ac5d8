// Drawings as pixels, by the exact-area rasteriser of stb_truetype.
#include <cmath>

#include "report/drawing/drawing.hpp"

namespace enfilade {
/// A corner of an outline, as stb_truetype reads it: pixels, not a font's whole units.
struct OutlineCorner {
  float x, y, cx, cy, cx1, cy1;
  unsigned char type, padding;
};
}  // namespace enfilade

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wpedantic"
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#define stbtt_vertex enfilade::OutlineCorner
#define stbtt_vertex_type float
#include <stb_truetype.h>
#pragma GCC diagnostic pop

namespace enfilade {

namespace {

/// Pixels of the sheet, upper left corner included.
struct Window {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

class Painter {
 public:
  explicit Painter(Bitmap& bitmap) : bitmap_(bitmap) {}

  /// Paths in pixels, all with the same orientation.
  void area(const std::vector<Path>& paths, Rgb8 colour, const Window& within) {
    std::vector<OutlineCorner> outline;
    Window w = within;
    fit(w, paths);
    if (w.empty()) return;
    for (const Path& path : paths) {
      for (std::size_t i = 0; i <= path.size(); ++i) {
        OutlineCorner v{};
        v.type = static_cast<unsigned char>(i == 0 ? STBTT_vmove : STBTT_vline);
        v.x = static_cast<float>(path[i % path.size()].x);
        v.y = static_cast<float>(path[i % path.size()].y);
        outline.push_back(v);
      }
    }
    blend(covered(outline, w), colour, w);
  }
  void lines(const std::vector<Path>& paths, bool closed, double width_px, Rgb8 colour,
             const Window& within) {
    std::vector<Path> strips;
    for (const Path& path : paths) {
      const std::size_t count = closed ? path.size() : path.size() - 1;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec2 a = path[i], b = path[(i + 1) % path.size()];
        const double length = glm::length(b - a);
        if (length < 1e-6) continue;
        // Half a width longer at both ends, which fills the corners.
        const Vec2 along = 0.5 * width_px / length * (b - a), across(-along.y, along.x);
        const double end = closed || path.size() > 2 ? 1.0 : 0.0;
        strips.push_back({a - end * along - across, b + end * along - across,
                          b + end * along + across, a - end * along + across});
      }
    }
    // All strips have the same orientation, so that their overlaps do not cancel.
    area(strips, colour, within);
  }

 private:
  static void fit(Window& w, const std::vector<Path>& paths) {
    Box box;
    for (const Path& path : paths) {
      for (const Vec2& p : path) box.add(Vec3(p, 0.0));
    }
    if (box.empty()) {
      w.x1 = w.x0;
      return;
    }
    w.x0 = static_cast<int>(std::max<double>(w.x0, std::floor(box.lo.x)));
    w.y0 = static_cast<int>(std::max<double>(w.y0, std::floor(box.lo.y)));
    w.x1 = static_cast<int>(std::min<double>(w.x1, std::ceil(box.hi.x)));
    w.y1 = static_cast<int>(std::min<double>(w.y1, std::ceil(box.hi.y)));
  }
  static std::vector<unsigned char> covered(std::vector<OutlineCorner>& outline, const Window& w) {
    std::vector<unsigned char> share(static_cast<std::size_t>(w.x1 - w.x0) *
                                     static_cast<std::size_t>(w.y1 - w.y0));
    stbtt__bitmap target{w.x1 - w.x0, w.y1 - w.y0, w.x1 - w.x0, share.data()};
    stbtt_Rasterize(&target, 0.25f, outline.data(), static_cast<int>(outline.size()), 1.0f, 1.0f,
                    0.0f, 0.0f, w.x0, w.y0, 0, nullptr);
    return share;
  }
  void blend(const std::vector<unsigned char>& share, Rgb8 colour, const Window& w) {
    std::size_t i = 0;
    for (int y = w.y0; y < w.y1; ++y) {
      for (int x = w.x0; x < w.x1; ++x, ++i) {
        Rgb8& pixel = bitmap_.at(x, y);
        for (std::size_t c = 0; c < 3; ++c) {
          pixel[c] = static_cast<std::uint8_t>(
              (pixel[c] * (255 - share[i]) + colour[c] * share[i] + 127) / 255);
        }
      }
    }
  }

  Bitmap& bitmap_;
};

void paint(Painter& painter, const Shape& shape, const std::vector<Path>& px,
           const Window& window) {
  if (shape.fill) painter.area(px, *shape.fill, window);
  if (shape.stroke) painter.lines(px, shape.closed, shape.width_px, *shape.stroke, window);
}

/// stb_easy_font's capitals are 7 pixels high at scale 1.
int scale_of(double size_px) { return std::max(1, static_cast<int>(std::lround(size_px / 10.5))); }

void write(Bitmap& bitmap, const Words& words) {
  const int scale = scale_of(words.size_px);
  const auto x = static_cast<int>(std::lround(words.at_px.x));
  const auto y = static_cast<int>(std::lround(words.at_px.y));
  if (words.centred) {
    draw_text(bitmap, x - text_width(words.text, scale) / 2, y - 7 * scale / 2, words.text,
              words.colour, scale);
  } else {
    draw_text(bitmap, x, y - 7 * scale, words.text, words.colour, scale);
  }
}

}  // namespace

double width_px(const Words& words) {
  return std::max<double>(text_width(words.text, scale_of(words.size_px)),
                          0.62 * words.size_px * static_cast<double>(words.text.size()));
}

Bitmap to_bitmap(const Drawing& drawing) {
  Bitmap bitmap(drawing.width_px, drawing.height_px, {255, 255, 255});
  Painter painter(bitmap);
  const MapFrame& f = drawing.frame;
  const Vec2 end = f.corner_px + f.px_per_m * (f.hi_m - f.lo_m);
  const Window sheet{0, 0, drawing.width_px, drawing.height_px};
  const Window map{static_cast<int>(std::lround(f.corner_px.x)),
                   static_cast<int>(std::lround(f.corner_px.y)),
                   std::min(sheet.x1, static_cast<int>(std::lround(end.x))),
                   std::min(sheet.y1, static_cast<int>(std::lround(end.y)))};
  for (const Shape& shape : drawing.map) {
    std::vector<Path> px = shape.paths;
    for (Path& path : px) {
      for (Vec2& p : path) p = f.to_px(p);
    }
    paint(painter, shape, px, map);
  }
  for (const Shape& shape : drawing.sheet) paint(painter, shape, shape.paths, sheet);
  for (const Words& words : drawing.words) write(bitmap, words);
  return bitmap;
}

}  // namespace enfilade
