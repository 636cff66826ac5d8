#include "report/room_table/room_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "report/pictures/false_colour.hpp"
#include "report/room_table/isolines.hpp"

namespace enfilade {
namespace {

constexpr int width_px = 480, margin_px = 14;
/// Each cell of the grid is drawn as so many by so many squares.
constexpr int field_refinement = 3;
constexpr std::size_t most_lines = 6;
constexpr Rgb8 ink{25, 28, 33}, soft{120, 126, 134}, floor_colour{246, 245, 242};
/// Colours are rounded to so many steps, so that neighbours become one shape.
constexpr double colour_steps = 40.0;
constexpr double most_decades = 1e4;

GridField field_of(const RoomFigures& room) {
  GridField field{room.grid.columns, room.grid.rows, {}};
  field.values.assign(
      static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows),
      std::numeric_limits<double>::quiet_NaN());
  for (const GridValue& point : room.values)
    field.values[static_cast<std::size_t>(point.cell)] = point.value;
  return field;
}

/// Columns and rows, from the middle of the first cell on, to metres.
class GridMap {
 public:
  explicit GridMap(const CalculationGrid& grid) : grid_(grid) {}
  Vec2 at(const Vec2& p) const {
    return grid_.area.at((p.x + 0.5) / grid_.columns * grid_.area.length_m,
                         (p.y + 0.5) / grid_.rows * grid_.area.width_m);
  }

 private:
  const CalculationGrid& grid_;
};

/// Runs of equal colour along each row of squares, by colour.
void add_colours(const GridField& field, const RoomPlan& plan, const GridMap& map,
                 const LightScale& scale, Drawing& drawing) {
  std::map<Rgb8, Shape> shapes;
  constexpr double step = 1.0 / field_refinement;
  for (int row = 0; row < field.rows * field_refinement; ++row) {
    const double y = (row + 0.5) * step - 0.5;
    std::optional<Rgb8> open;
    double from = 0.0;
    const auto close = [&](double to) {
      if (!open) return;
      Shape& shape = shapes[*open];
      shape.fill = *open;
      Path& path = shape.paths.emplace_back();
      for (const Vec2& corner : {Vec2(from, y - 0.5 * step), Vec2(to, y - 0.5 * step),
                                 Vec2(to, y + 0.5 * step), Vec2(from, y + 0.5 * step)})
        path.push_back(map.at(corner));
      open.reset();
    };
    for (int column = 0; column < field.columns * field_refinement; ++column) {
      const double x = (column + 0.5) * step - 0.5;
      const double value = field.between(x, y);
      std::optional<Rgb8> colour;
      if (std::isfinite(value) && plan.contains(map.at({x, y}))) colour = scale.colour(value);
      if (colour == open) continue;
      close(x - 0.5 * step);
      open = colour;
      from = x - 0.5 * step;
    }
    close(field.columns - 0.5);
  }
  for (auto& [colour, shape] : shapes) {
    shape.kind = "light";
    shape.stroke = colour;  // no hairlines between neighbours
    shape.width_px = 0.4;
    drawing.map.push_back(std::move(shape));
  }
}

void add_lines(const GridField& field, const RoomFigures& room, const GridMap& map,
               Drawing& drawing) {
  for (const double level : scale_levels(room.minimum->value, room.maximum->value, most_lines)) {
    Shape shape;
    shape.kind = "isolux";
    shape.stroke = ink;
    shape.width_px = 1.0;
    shape.closed = false;
    for (const auto& line : isolines(field, level)) {
      Path& path = shape.paths.emplace_back();
      for (const Vec2& p : line) path.push_back(map.at(p));
    }
    if (shape.paths.empty()) continue;
    const auto longest =
        std::ranges::max_element(shape.paths, {}, [](const Path& path) { return path.size(); });
    drawing.words.push_back({drawing.frame.to_px((*longest)[longest->size() / 2]),
                             fmt::format("{:g}", level), 11.0, ink, true});
    drawing.map.push_back(std::move(shape));
  }
}

Drawing sheet_of(const RoomFigures& room, const std::string& unit) {
  Drawing drawing;
  drawing.title = fmt::format("{}: {} at {:.2f} m", room.room.name, unit, room.plane_m);
  Vec2 lo(std::numeric_limits<double>::infinity()), hi = -lo;
  for (const auto& ring : room.room.plan.rings()) {
    for (const Vec2& p : ring) lo = glm::min(lo, p), hi = glm::max(hi, p);
  }
  if (!(hi.x > lo.x && hi.y > lo.y)) return drawing;
  const Vec2 size = hi - lo;
  // At most as high as wide.
  drawing.frame.px_per_m = (width_px - 2 * margin_px) / std::max(size.x, size.y);
  const double margin_m = margin_px / drawing.frame.px_per_m;
  drawing.frame.lo_m = lo - Vec2(margin_m);
  drawing.frame.hi_m = hi + Vec2(margin_m);
  const auto pixels = [&](double side_m) {
    return static_cast<int>(std::ceil((side_m + 2.0 * margin_m) * drawing.frame.px_per_m));
  };
  drawing.width_px = pixels(size.x);
  drawing.height_px = pixels(size.y);
  return drawing;
}

}  // namespace

Rgb8 LightScale::colour(double value) const {
  if (!(highest > lowest) || !(value > 0.0)) return scale_colour(0.0);
  const double t = std::log(std::max(value, lowest) / lowest) / std::log(highest / lowest);
  return scale_colour(std::round(t * colour_steps) / colour_steps);
}

LightScale scale_of(std::span<const RoomFigures> rooms) {
  LightScale scale{std::numeric_limits<double>::infinity(), 0.0};
  for (const RoomFigures& room : rooms) {
    if (!room.maximum) continue;
    scale.highest = std::max(scale.highest, room.maximum->value);
    if (room.minimum->value > 0.0) scale.lowest = std::min(scale.lowest, room.minimum->value);
  }
  scale.lowest = std::clamp(scale.lowest, scale.highest / most_decades, scale.highest);
  return scale;
}

Drawing room_drawing(const RoomFigures& room, const LightScale& scale, const std::string& unit) {
  Drawing drawing = sheet_of(room, unit);
  if (drawing.width_px == 0) return drawing;
  Shape ground;
  ground.kind = "room";
  ground.paths = room.room.plan.rings();
  ground.fill = floor_colour;
  drawing.map.push_back(ground);
  if (room.minimum) {
    const GridField field = field_of(room);
    const GridMap map(room.grid);
    add_colours(field, room.room.plan, map, scale, drawing);
    if (field.columns > 1 && field.rows > 1) add_lines(field, room, map, drawing);
  }
  ground.fill.reset();
  ground.stroke = soft;
  ground.width_px = 2.0;
  drawing.map.push_back(ground);
  return drawing;
}

}  // namespace enfilade
