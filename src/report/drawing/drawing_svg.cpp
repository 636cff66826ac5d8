#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "report/drawing/charts.hpp"
#include "report/drawing/drawing.hpp"

namespace enfilade {

namespace {

/// To a tenth of a millimetre, or of a thousandth of a pixel.
double rounded(double v) { return std::round(v * 1e4) / 1e4 + 0.0; }

class SvgText {
 public:
  /// `scale`: pixels per drawing unit. Stroke widths are given in pixels and divided by it.
  void add(const Shape& shape, double scale) {
    add(R"(<path class="{}" fill="{}")", shape.kind, shape.fill ? css(*shape.fill) : "none");
    if (shape.stroke) {
      add(R"( stroke="{}" stroke-width="{}")", css(*shape.stroke), rounded(shape.width_px / scale));
    }
    text += " d=\"";
    for (const Path& path : shape.paths) {
      for (std::size_t i = 0; i < path.size(); ++i) {
        add("{}{} {}", i == 0 ? 'M' : 'L', rounded(path[i].x), rounded(path[i].y));
      }
      if (shape.closed) text += 'Z';
    }
    text += shape.tip.empty() ? "\"/>\n" : "\"><title>" + escaped(shape.tip) + "</title></path>\n";
  }
  void add(const Words& words) {
    add(R"(<text x="{}" y="{}" font-size="{}" fill="{}"{}>{}</text>)", rounded(words.at_px.x),
        rounded(words.at_px.y + (words.centred ? 0.36 * words.size_px : 0.0)),
        rounded(words.size_px), css(words.colour), words.centred ? " text-anchor=\"middle\"" : "",
        escaped(words.text));
    text += '\n';
  }
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
  }
  std::string text;
};

std::string write_svg(const Drawing& drawing, const char* name_space) {
  const MapFrame& f = drawing.frame;
  const Vec2 size = f.px_per_m * (f.hi_m - f.lo_m);
  const Vec2 origin = f.to_px(Vec2(0.0));
  SvgText svg;
  svg.add(R"(<svg {3}class="plan" role="img" )"
          R"(width="{0}" height="{1}" viewBox="0 0 {0} {1}" )"
          R"(font-family="DejaVu Sans, Verdana, Arial, sans-serif" stroke-linejoin="round">)"
          "\n<title>{2}</title>\n",
          drawing.width_px, drawing.height_px, escaped(drawing.title), name_space);
  svg.add(R"(<rect width="{}" height="{}" fill="#ffffff"/>)"
          "\n",
          drawing.width_px, drawing.height_px);
  // Cut off by a nested sheet, which needs no name that another drawing on a page could share.
  svg.add(R"(<svg x="{0}" y="{1}" width="{2}" height="{3}" viewBox="{0} {1} {2} {3}">)",
          rounded(f.corner_px.x), rounded(f.corner_px.y), rounded(size.x), rounded(size.y));
  svg.add(R"svg(<g transform="matrix({} 0 0 {} {} {})">)svg"
          "\n",
          f.px_per_m, -f.px_per_m, rounded(origin.x), rounded(origin.y));
  for (const Shape& shape : drawing.map) svg.add(shape, f.px_per_m);
  svg.text += "</g></svg>\n";
  for (const Shape& shape : drawing.sheet) svg.add(shape, 1.0);
  for (const Words& words : drawing.words) svg.add(words);
  return svg.text + "</svg>\n";
}
}  // namespace

std::string css(Rgb8 colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

std::string to_svg(const Drawing& drawing) {
  return write_svg(drawing, R"(xmlns="http://www.w3.org/2000/svg" )");
}

std::string to_inline_svg(const Drawing& drawing) { return write_svg(drawing, ""); }

}  // namespace enfilade
