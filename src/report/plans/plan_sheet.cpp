#include "report/plans/plan_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace enfilade {

namespace {

constexpr double margin_px = 24.0, words_px = 16.0, line_px = 27.0, map_px = 1150.0;
constexpr double most_height_px = 1000.0, least_height_px = 120.0, swatch_px = 30.0;

Path rectangle(double x, double y, double w, double h) {
  return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
}

MapFrame frame_of(const Box& ground) {
  const Vec2 extent = glm::max(Vec2(ground.extent()), Vec2(1e-3));
  const Vec2 margin(0.03 * std::max(extent.x, extent.y));
  MapFrame frame;
  frame.lo_m = Vec2(ground.lo) - margin;
  frame.hi_m = Vec2(ground.lo) + extent + margin;
  const Vec2 size = frame.hi_m - frame.lo_m;
  frame.px_per_m = std::min(map_px / size.x, most_height_px / size.y);
  // A long and narrow house keeps room for its words.
  const double missing = least_height_px / frame.px_per_m - size.y;
  if (missing > 0.0) frame.lo_m.y -= 0.5 * missing, frame.hi_m.y += 0.5 * missing;
  return frame;
}

/// The legend's lines, one below the other.
class Legend {
 public:
  Legend(Drawing& drawing, Vec2 at_px) : drawing_(drawing), at_(at_px) {}
  void area(Rgb8 colour, const std::string& meaning) {
    Shape shape{
        "key", {rectangle(at_.x, at_.y, swatch_px, 17.0)}, colour, plan_ink::soft, 1.0, true, ""};
    add(std::move(shape), meaning);
  }
  void lines(Rgb8 colour, double width, std::vector<Path> paths, const std::string& meaning) {
    for (Path& path : paths) {
      for (Vec2& p : path) p = at_ + p;
    }
    add({"key", std::move(paths), std::nullopt, colour, width, false, ""}, meaning);
  }
  double bottom() const { return at_.y; }
  double right() const { return right_; }

 private:
  void add(Shape shape, const std::string& meaning) {
    drawing_.sheet.push_back(std::move(shape));
    const Words words{at_ + Vec2(swatch_px + 10.0, 14.0), meaning, words_px, plan_ink::black,
                      false};
    right_ = std::max(right_, words.at_px.x + width_px(words));
    drawing_.words.push_back(words);
    at_.y += line_px;
  }
  Drawing& drawing_;
  Vec2 at_;
  double right_ = 0.0;
};

/// Slanting lines within a swatch.
std::vector<Path> hatched_swatch() {
  std::vector<Path> lines{rectangle(0, 0, swatch_px, 17.0)};
  lines[0].push_back(lines[0][0]);
  for (double x = 0.0; x < swatch_px - 6.0; x += 6.0) lines.push_back({{x, 17.0}, {x + 10.0, 0.0}});
  return lines;
}

void fill_legend(Legend& legend, const PlanSubject& subject, const PlanContents& contents) {
  const std::vector<Path> straight{{{0.0, 8.5}, {swatch_px, 8.5}}};
  const std::vector<Path> dashed{
      {{0.0, 8.5}, {8.0, 8.5}}, {{12.0, 8.5}, {20.0, 8.5}}, {{24.0, 8.5}, {swatch_px, 8.5}}};
  if (subject.name == "cells")
    legend.area(subject.cells.empty() ? plan_ink::seen : Rgb8{141, 211, 199},
                "room, with its cell's number");
  for (const PlanKey& key : subject.keys) {
    if (key.line)
      legend.lines(key.colour, 3.0, straight, key.meaning);
    else
      legend.area(key.colour, key.meaning);
  }
  if (subject.name == "cells") {
    legend.lines(plan_ink::black, 1.6, straight, "surfaces that are cut");
    if (contents.furniture)
      legend.lines(plan_ink::soft, 1.0, {rectangle(4, 1, 22, 15), {{4, 16}, {4, 1}}},
                   "clusters that end below the cut");
  }
  if (contents.doorways) legend.lines(plan_ink::doorway, 4.0, straight, "portal, room to room");
  if (contents.to_outside)
    legend.lines(plan_ink::to_outside, 4.0, straight, "portal to the outside");
  if (contents.into_solids)
    legend.lines(plan_ink::into_solid, 2.5, straight, "portal into a cupboard, a wall");
  if (contents.beyond) legend.lines(plan_ink::soft, 3.0, dashed, "portal above or below the cut");
  if (contents.level)
    legend.lines(plan_ink::soft, 1.2, hatched_swatch(), "portal in floor or ceiling");
}

/// The longest of 1, 2, 5, 10, ... metres that is no longer than 220 pixels.
double scale_length_m(double px_per_m) {
  const double most_m = 220.0 / px_per_m;
  const double decade = std::pow(10.0, std::floor(std::log10(most_m)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= most_m) return step * decade;
  }
  return decade;
}

void add_scale_bar(Drawing& drawing, Vec2 at_px) {
  const double length_m = scale_length_m(drawing.frame.px_per_m);
  const double part_px = 0.25 * length_m * drawing.frame.px_per_m;
  for (int i = 0; i < 4; ++i) {
    const Rgb8 fill = i % 2 == 0 ? plan_ink::black : Rgb8{255, 255, 255};
    drawing.sheet.push_back({"scale",
                             {rectangle(at_px.x + i * part_px, at_px.y, part_px, 8.0)},
                             fill,
                             plan_ink::black,
                             1.0,
                             true,
                             ""});
  }
  const auto write = [&](double x, const std::string& text) {
    drawing.words.push_back({{at_px.x + x, at_px.y + 22.0}, text, words_px, plan_ink::black, true});
  };
  write(0.0, "0");
  write(4.0 * part_px, fmt::format("{:g} m", length_m));
}

}  // namespace

Drawing plan_sheet(const Box& ground, const std::string& title, const PlanSubject& subject,
                   const PlanContents& contents) {
  Drawing drawing;
  drawing.title = title;
  drawing.frame = frame_of(ground);
  drawing.frame.corner_px = {margin_px, 92.0};
  drawing.words.push_back({{margin_px, 44.0}, title, 26.0, plan_ink::black, false});
  drawing.words.push_back({{margin_px, 74.0}, subject.subtitle, words_px, plan_ink::soft, false});
  const MapFrame& f = drawing.frame;
  const Vec2 end = f.corner_px + f.px_per_m * (f.hi_m - f.lo_m);
  Path edge = rectangle(f.corner_px.x, f.corner_px.y, end.x - f.corner_px.x, end.y - f.corner_px.y);
  drawing.sheet.push_back({"frame", {edge}, std::nullopt, plan_ink::faint, 1.0, true, ""});
  add_scale_bar(drawing, {margin_px + 8.0, end.y + 18.0});
  Legend legend(drawing, {end.x + margin_px, f.corner_px.y});
  fill_legend(legend, subject, contents);
  double right = legend.right();
  for (const Words& words : {drawing.words[0], drawing.words[1]})
    right = std::max(right, words.at_px.x + width_px(words));
  drawing.width_px = static_cast<int>(std::ceil(right + margin_px));
  drawing.height_px =
      static_cast<int>(std::ceil(std::max(end.y + 56.0, legend.bottom() + margin_px)));
  return drawing;
}

}  // namespace enfilade
