#include <fmt/format.h>

#include <iterator>

#include "base/safe_text.hpp"
#include "report/room_table/room_table.hpp"

namespace enfilade {
namespace {

/// A line of fields, with commas between them.
class Line {
 public:
  explicit Line(std::string& csv) : csv_(csv) {}
  ~Line() { csv_ += '\n'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void text(const std::string& words) { add(csv_field(words)); }
  void number(double x) { add(fmt::format("{:.6g}", x)); }
  void count(std::size_t n) { add(std::to_string(n)); }
  void value(const std::optional<Estimate>& e) { e ? number(e->value) : add(""); }
  void error(const std::optional<Estimate>& e) { e ? number(e->error) : add(""); }
  void both(const std::optional<Estimate>& e) {
    value(e);
    error(e);
  }

 private:
  void add(const std::string& field) {
    if (!first_) csv_ += ',';
    first_ = false;
    csv_ += field;
  }
  std::string& csv_;
  bool first_ = true;
};

/// The highest rating of the places in a room.
std::optional<Estimate> worst_glare(const RoomTable& table, const RoomFigures& room) {
  std::optional<Estimate> worst;
  for (const GlareRating& rating : table.glare) {
    if (!rating.ugr || !lies_in(room, rating.place.p)) continue;
    if (!worst || rating.ugr->value > worst->value) worst = rating.ugr;
  }
  return worst;
}

}  // namespace

std::string room_at(std::span<const RoomFigures> rooms, const Vec3& p) {
  for (const RoomFigures& room : rooms) {
    if (lies_in(room, p)) return room.room.name;
  }
  return {};
}

std::optional<Estimate> daylight_factor(const RoomTable& table, const std::optional<Estimate>& e) {
  if (!e || !(table.outside > 0.0)) return std::nullopt;
  // The maintenance factor multiplies light inside, and is no part of this ratio.
  const double percent = 100.0 / (table.maintenance_factor * table.outside);
  return Estimate{percent * e->value, percent * e->error};
}

std::string rooms_csv(const RoomTable& table) {
  std::string csv =
      "room,long_name,storey,area_m2,height_m,points,points_in_furniture,points_without_floor,"
      "spacing_m,wall_zone_m,plane_m,unit,mean,minimum,maximum,u0,error,minimum_error,"
      "maximum_error,u0_error,walls,walls_error,ceiling,ceiling_error,cylindrical,"
      "cylindrical_error,daylight_factor_mean,daylight_factor_mean_error,daylight_factor_minimum,"
      "daylight_factor_minimum_error,daylight_factor_median,daylight_factor_median_error,required,"
      "verdict,ugr,maintenance_factor,weights\n";
  for (const RoomFigures& f : table.rooms) {
    Line line(csv);
    line.text(f.room.name);
    line.text(f.room.long_name);
    line.text(f.room.storey);
    line.number(f.room.area_m2);
    line.number(f.room.height_m());
    line.count(f.values.size());
    line.count(f.in_furniture);
    line.count(f.without_floor);
    line.number(f.grid.spacing_m);
    line.number(f.grid.wall_zone_m);
    line.number(f.plane_m);
    line.text(table.unit);
    for (const auto* figure : {&f.mean, &f.minimum, &f.maximum, &f.u0}) line.value(*figure);
    for (const auto* figure : {&f.mean, &f.minimum, &f.maximum, &f.u0}) line.error(*figure);
    for (const auto* figure : {&f.walls, &f.ceiling, &f.cylindrical}) line.both(*figure);
    for (const auto* figure : {&f.mean, &f.minimum, &f.median})
      line.both(daylight_factor(table, *figure));
    f.room.required > 0.0 ? line.number(f.room.required) : line.text("");
    line.text(name_of(verdict_of(f)));
    line.value(worst_glare(table, f));
    line.number(table.maintenance_factor);
    line.text(table.weights);
  }
  return csv;
}

std::string glare_csv(const RoomTable& table) {
  std::string csv = "place,x,y,z,dx,dy,dz,room,ugr,ugr_error,background_cd_m2,sources,largest_sr\n";
  for (const GlareRating& rating : table.glare) {
    Line line(csv);
    line.text(rating.place.name);
    for (int axis = 0; axis < 3; ++axis) line.number(rating.place.p[axis]);
    for (int axis = 0; axis < 3; ++axis) line.number(rating.place.direction[axis]);
    line.text(room_at(table.rooms, rating.place.p));
    line.both(rating.ugr);
    line.number(rating.background_cd_m2);
    line.count(rating.sources);
    line.number(rating.largest_sr);
  }
  return csv;
}

}  // namespace enfilade
