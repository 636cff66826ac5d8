// Line drawings, made once and written as SVG or as pixels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/geometry.hpp"
#include "report/drawing/bitmap.hpp"

namespace enfilade {

using Path = std::vector<Vec2>;

/// Areas or lines with one style. Areas of one shape must not overlap unless they have the same
/// orientation.
struct Shape {
  std::string kind;  ///< CSS class in the SVG
  std::vector<Path> paths;
  std::optional<Rgb8> fill, stroke;
  double width_px = 1.0;  ///< of the stroke
  bool closed = true;     ///< false: lines
  std::string tip;        ///< shown where the mouse rests on it
};

/// One line of text; `at_px` is the left end of its base line, or the middle of the text.
struct Words {
  Vec2 at_px{0.0};
  std::string text;
  double size_px = 15.0;
  Rgb8 colour{0, 0, 0};
  bool centred = false;
};

/// The map from metres (y up) to the sheet's pixels (y down), and the part of it that is shown.
struct MapFrame {
  double px_per_m = 1.0;
  Vec2 lo_m{0.0}, hi_m{0.0};  ///< the map is clipped to this box
  Vec2 corner_px{0.0};        ///< upper left
  Vec2 to_px(const Vec2& p) const {
    return corner_px + px_per_m * Vec2(p.x - lo_m.x, hi_m.y - p.y);
  }
};

/// A sheet: a map in metres, then what stands around and over it in pixels.
struct Drawing {
  std::string title;
  int width_px = 0, height_px = 0;
  MapFrame frame;
  std::vector<Shape> map;    ///< metres, cut off at the frame
  std::vector<Shape> sheet;  ///< pixels
  std::vector<Words> words;  ///< pixels
};

/// Returns SVG 1.1 with the map's coordinates in metres and a <title> for each shape with a tip.
std::string to_svg(const Drawing& drawing);
/// Returns SVG as an element of an HTML page, which needs no name space.
std::string to_inline_svg(const Drawing& drawing);
/// Returns the drawing as pixels, anti-aliased, on white.
Bitmap to_bitmap(const Drawing& drawing);
/// Returns the width of words in pixels: the larger of their widths in SVG and in a bitmap.
double width_px(const Words& words);

/// "#rrggbb".
std::string css(Rgb8 colour);

}  // namespace enfilade
