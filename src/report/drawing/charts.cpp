#include "report/drawing/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/safe_text.hpp"

namespace enfilade {

namespace {

constexpr double width = 640, height = 280, left = 64, right = 16, top = 12, bottom = 44;

struct Frame {
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;  ///< y in decades
  double x(double v) const { return left + (v - x0) / (x1 - x0) * (width - left - right); }
  double y(double v) const {
    return top + (y1 - std::log10(v)) / (y1 - y0) * (height - top - bottom);
  }
};

bool drawable(const std::pair<double, double>& p) {
  return std::isfinite(p.first) && std::isfinite(p.second) && p.second > 0.0;
}

Frame frame_of(const std::vector<Series>& series) {
  Frame f;
  for (const Series& s : series) {
    for (const auto& p : s.points) {
      if (!drawable(p)) continue;
      f.x0 = std::min(f.x0, p.first);
      f.x1 = std::max(f.x1, p.first);
      f.y0 = std::min(f.y0, std::log10(p.second));
      f.y1 = std::max(f.y1, std::log10(p.second));
    }
  }
  if (f.x1 == f.x0) f.x1 = f.x0 + 1.0;
  f.y0 = std::floor(f.y0);
  f.y1 = std::max(std::ceil(f.y1), f.y0 + 1.0);
  return f;
}

/// 1, 2 or 5 times a power of ten, so that about `count` steps cover `span`.
double step_for(double span, double count) {
  const double decade = std::pow(10.0, std::floor(std::log10(span / count)));
  for (double s : {1.0, 2.0, 5.0, 10.0}) {
    if (span / (s * decade) <= count) return s * decade;
  }
  return 10.0 * decade;
}

void draw_axes(const Frame& f, const std::string& x_label, const std::string& y_label,
               std::string& svg) {
  const auto out = std::back_inserter(svg);
  const double skip = std::ceil((f.y1 - f.y0) / 8.0);
  for (double decade = f.y0; decade <= f.y1 + 0.5; decade += skip) {
    const double y = f.y(std::pow(10.0, decade));
    fmt::format_to(out, R"(<line class="grid" x1="{}" x2="{}" y1="{:.1f}" y2="{:.1f}"/>)", left,
                   width - right, y, y);
    fmt::format_to(out, R"(<text class="tick" x="{}" y="{:.1f}" text-anchor="end">{:g}</text>)",
                   left - 8, y + 4, std::pow(10.0, decade));
  }
  const double step = std::max(1.0, step_for(f.x1 - f.x0, 10.0));
  for (double x = std::ceil(f.x0 / step) * step; x <= f.x1 + 1e-9; x += step) {
    fmt::format_to(out, R"(<text class="tick" x="{:.1f}" y="{}" text-anchor="middle">{:g}</text>)",
                   f.x(x), height - bottom + 18, x);
  }
  fmt::format_to(out, R"(<text class="tick" x="{}" y="{}" text-anchor="middle">{}</text>)",
                 (left + width - right) / 2, height - 6, escaped(x_label));
  fmt::format_to(
      out,
      R"svg(<text class="tick" transform="translate(14 {}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      (top + height - bottom) / 2, escaped(y_label));
}

void draw_series(const Frame& f, const Series& s, std::string& svg) {
  const auto out = std::back_inserter(svg);
  std::string path;
  for (const auto& p : s.points) {
    if (!drawable(p)) continue;
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", path.empty() ? "M" : "L",
                   f.x(p.first), f.y(p.second));
  }
  fmt::format_to(out, R"(<path fill="none" stroke="{}" stroke-width="2" d="{}"/>)", s.colour, path);
  for (const auto& p : s.points) {
    if (!drawable(p)) continue;
    fmt::format_to(
        out,
        R"(<circle r="3" fill="{}" cx="{:.1f}" cy="{:.1f}"><title>{} at {:g}: {:.4g}</title></circle>)",
        s.colour, f.x(p.first), f.y(p.second), escaped(s.name), p.first, p.second);
  }
}

std::string legend(const std::vector<std::pair<std::string, std::string>>& entries) {
  std::string html = R"(<div class="legend">)";
  for (const auto& [name, colour] : entries) {
    html += fmt::format(R"(<span><i style="background:{}"></i>{}</span>)", colour, escaped(name));
  }
  return html + "</div>";
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : file_text(text)) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string line_chart(const std::vector<Series>& series, const std::string& x_label,
                       const std::string& y_label) {
  const bool any = std::any_of(series.begin(), series.end(), [](const Series& s) {
    return std::any_of(s.points.begin(), s.points.end(), drawable);
  });
  if (!any) return "";
  const Frame f = frame_of(series);
  std::string svg =
      fmt::format(R"(<svg class="chart" role="img" aria-label="{} over {}" viewBox="0 0 {} {}">)",
                  escaped(y_label), escaped(x_label), width, height);
  draw_axes(f, x_label, y_label, svg);
  std::vector<std::pair<std::string, std::string>> names;
  for (const Series& s : series) {
    draw_series(f, s, svg);
    names.emplace_back(s.name, s.colour);
  }
  return legend(names) + svg + "</svg>";
}

std::string stacked_bars(const std::vector<std::string>& labels, const std::vector<Layer>& layers,
                         const std::string& unit) {
  if (labels.empty() || layers.empty()) return "";
  const double row = std::clamp(320.0 / static_cast<double>(labels.size()), 6.0, 28.0);
  const double high = row * static_cast<double>(labels.size()) + 26.0;
  double longest = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    double sum = 0.0;
    for (const Layer& l : layers) sum += std::max(0.0, i < l.values.size() ? l.values[i] : 0.0);
    longest = std::max(longest, sum);
  }
  if (!(longest > 0.0)) return "";
  const double scale = (width - left - right) / longest;
  std::string svg = fmt::format(
      R"(<svg class="chart" role="img" aria-label="time by rank" viewBox="0 0 {} {:.0f}">)", width,
      high);
  const auto out = std::back_inserter(svg);
  const double step = step_for(longest, 8.0);
  for (double x = 0.0; x <= longest * (1 + 1e-9); x += step) {
    fmt::format_to(out, R"(<line class="grid" x1="{0:.1f}" x2="{0:.1f}" y1="0" y2="{1:.1f}"/>)",
                   left + x * scale, high - 22);
    fmt::format_to(
        out, R"(<text class="tick" x="{:.1f}" y="{:.1f}" text-anchor="middle">{:g} {}</text>)",
        left + x * scale, high - 6, x, escaped(unit));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double y = row * static_cast<double>(i);
    if (row >= 10.0) {
      fmt::format_to(out, R"(<text class="tick" x="{}" y="{:.1f}" text-anchor="end">{}</text>)",
                     left - 8, y + row / 2 + 4, escaped(labels[i]));
    }
    double x = left;
    for (const Layer& l : layers) {
      const double value = std::max(0.0, i < l.values.size() ? l.values[i] : 0.0);
      fmt::format_to(
          out,
          R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"><title>{}: {} {:.4g} {}</title></rect>)",
          x, y + 0.1 * row, value * scale, 0.8 * row, l.colour, escaped(labels[i]), escaped(l.name),
          value, escaped(unit));
      x += value * scale;
    }
  }
  std::vector<std::pair<std::string, std::string>> names;
  for (const Layer& l : layers) names.emplace_back(l.name, l.colour);
  return legend(names) + svg + "</svg>";
}

}  // namespace enfilade
