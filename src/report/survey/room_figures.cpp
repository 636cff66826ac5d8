#include "report/survey/room_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/run_on_threads.hpp"
#include "report/pictures/one_value.hpp"
#include "report/survey/room_faces.hpp"
#include "report/survey/standing_place.hpp"

namespace enfilade {
namespace {

/// Of a room's height: points lie at most this high, whatever height is asked for.
constexpr double most_plane_share = 0.5, most_cylindrical_share = 0.8;
/// Vertical directions at a point, and in a room at the least.
constexpr int directions_of_point = 4, directions_of_room = 64;
constexpr double golden = 0.6180339887498949;
constexpr double verdict_deviations = 2.0;

/// The light of one gather as one value.
struct Gathered {
  double value = 0.0, noise = 0.0, bias = 0.0;
};

/// Mean of gathers: noise is independent, the error of the reflected light is common to all.
class MeanOf {
 public:
  void add(const Gathered& light) {
    sum_ += light.value;
    noise2_ += light.noise * light.noise;
    bias_ += light.bias;
    ++count_;
  }
  std::optional<Estimate> estimate() const {
    if (count_ == 0) return std::nullopt;
    const auto n = static_cast<double>(count_);
    return Estimate{sum_ / n, std::hypot(std::sqrt(noise2_) / n, bias_ / n)};
  }

 private:
  double sum_ = 0.0, noise2_ = 0.0, bias_ = 0.0;
  std::size_t count_ = 0;
};

/// Returns the median (of an even number the mean of the middle two) and its error.
std::optional<Estimate> median_of(std::span<const GridValue> values) {
  if (values.empty()) return std::nullopt;
  std::vector<GridValue> sorted(values.begin(), values.end());
  std::ranges::sort(sorted, {}, &GridValue::value);
  const GridValue &low = sorted[(sorted.size() - 1) / 2], &high = sorted[sorted.size() / 2];
  return Estimate{0.5 * (low.value + high.value), 0.5 * (low.error + high.error)};
}

class Survey {
 public:
  Survey(const SurveyedScene& scene, const SurveyConfig& config) : scene_(scene), config_(config) {}

  std::vector<RoomFigures> run(std::vector<SurveyRoom> rooms, const Progress& progress) {
    figures_.resize(rooms.size());
    cylinders_.resize(rooms.size());
    for (std::size_t i = 0; i < rooms.size(); ++i) figures_[i].room = std::move(rooms[i]);
    for_each_on_threads(figures_.size(), "rooms: grids", progress,
                        [this](std::size_t i) { lay_out(figures_[i], cylinders_[i]); });
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < figures_.size(); ++i) add_tasks(i, tasks);
    for_each_on_threads(tasks.size(), "rooms: light", progress,
                        [&](std::size_t i) { tasks[i].light = gather(tasks[i].p, tasks[i].n); });
    std::size_t next = 0;
    for (std::size_t i = 0; i < figures_.size(); ++i) finish(i, tasks, next);
    return std::move(figures_);
  }

 private:
  struct Task {
    Vec3 p{0.0}, n{0.0};
    Gathered light{};
  };
  /// Heights above the floor, and points of the plan that lie in the open there.
  struct Cylinder {
    double height_m = 0.0;
    std::vector<Vec2> points;
    int directions = directions_of_point;
  };

  void lay_out(RoomFigures& room, Cylinder& cylinder) const {
    room.grid = calculation_grid(room.room.plan);
    room.plane_m = std::min(config_.plane_m, most_plane_share * room.room.height_m());
    cylinder.height_m =
        std::min(config_.cylindrical_m, most_cylindrical_share * room.room.height_m());
    for (std::size_t i = 0; i < room.grid.points.size(); ++i) {
      const Vec2& p = room.grid.points[i];
      switch (place(room.room, p, room.plane_m)) {
        case PointPlace::open:
          room.values.push_back({p, room.grid.cell[i]});
          break;
        case PointPlace::in_furniture:
          ++room.in_furniture;
          break;
        case PointPlace::without_floor:
          ++room.without_floor;
      }
      if (config_.cylindrical && place(room.room, p, cylinder.height_m) == PointPlace::open)
        cylinder.points.push_back(p);
    }
    const auto points = static_cast<int>(std::max<std::size_t>(cylinder.points.size(), 1));
    const int most = (directions_of_room + points - 1) / points;
    cylinder.directions = std::max(directions_of_point, (most + 3) / 4 * 4);
    const FaceLight faces = face_light(scene_.solved, room.room);
    room.walls = read_off(faces.walls);
    room.ceiling = read_off(faces.ceiling);
  }

  PointPlace place(const SurveyRoom& room, const Vec2& p, double height_m) const {
    return place_of(scene_.solved.occluders, room, Vec3(p, room.floor_m + height_m));
  }

  std::optional<Estimate> read_off(const std::optional<double>& light) const {
    if (!light) return std::nullopt;
    const double value = config_.maintenance_factor * *light;
    return Estimate{value, scene_.patch_error * value};
  }

  void add_tasks(std::size_t room, std::vector<Task>& tasks) const {
    const double floor_m = figures_[room].room.floor_m;
    for (const GridValue& point : figures_[room].values)
      tasks.push_back({Vec3(point.p, floor_m + figures_[room].plane_m), Vec3(0, 0, 1)});
    const Cylinder& cylinder = cylinders_[room];
    for (std::size_t i = 0; i < cylinder.points.size(); ++i) {
      // Each point has its own turn, so that the room's mean does not depend on the directions.
      const double turn = std::fmod(static_cast<double>(i) * golden, 1.0);
      for (int k = 0; k < cylinder.directions; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + turn) / cylinder.directions;
        tasks.push_back({Vec3(cylinder.points[i], floor_m + cylinder.height_m),
                         Vec3(std::cos(angle), std::sin(angle), 0.0)});
      }
    }
  }

  Gathered gather(const Vec3& p, const Vec3& n) const {
    const PointIrradiance light = scene_.gather.at(p, n);
    const Scene& scene = scene_.solved.scene;
    const double factor = config_.maintenance_factor;
    // Bands share their rays: their errors are taken as one.
    const double error = factor * one_value(scene, light.error);
    const double noise = factor * one_value(scene, light.noise);
    return {factor * one_value(scene, light.irradiance), noise,
            std::sqrt(std::max(0.0, error * error - noise * noise))};
  }

  /// The mean over all directions is found from few: a source alone moves it, as it turns, by the
  /// harmonic of the clamped cosine that has their number. Its share of that of half as many
  /// directions, whose two means differ by twice of it, is ((D/2)^2 - 1) / (D^2 - 1).
  static std::optional<Estimate> cylindrical_light(const Cylinder& cylinder,
                                                   const std::vector<Task>& tasks,
                                                   std::size_t& next) {
    MeanOf mean;
    const double d = cylinder.directions;
    const double share = (0.25 * d * d - 1.0) / (d * d - 1.0);
    double square = 0.0;
    for (std::size_t i = 0; i < cylinder.points.size(); ++i) {
      double difference = 0.0;  // of the means over every other direction
      for (int k = 0; k < cylinder.directions; ++k) {
        const Gathered& light = tasks[next++].light;
        mean.add(light);
        difference += (k % 2 == 0 ? light.value : -light.value) / (0.5 * d);
      }
      square += 0.25 * share * share * difference * difference;
    }
    std::optional<Estimate> found = mean.estimate();
    if (found) {
      const auto points = static_cast<double>(cylinder.points.size());
      found->error = std::hypot(found->error, std::sqrt(square) / points);
    }
    return found;
  }

  /// Takes the room's tasks, from number `next` on.
  void finish(std::size_t number, const std::vector<Task>& tasks, std::size_t& next) {
    RoomFigures& room = figures_[number];
    MeanOf mean;
    std::optional<Gathered> lowest, highest;
    for (GridValue& point : room.values) {
      const Gathered& light = tasks[next++].light;
      point.value = light.value;
      point.error = std::hypot(light.noise, light.bias);
      mean.add(light);
      if (!lowest || light.value < lowest->value) lowest = light;
      if (!highest || light.value > highest->value) highest = light;
    }
    room.mean = mean.estimate();
    room.median = median_of(room.values);
    room.cylindrical = cylindrical_light(cylinders_[number], tasks, next);
    if (!lowest) return;
    room.minimum = Estimate{lowest->value, std::hypot(lowest->noise, lowest->bias)};
    room.maximum = Estimate{highest->value, std::hypot(highest->noise, highest->bias)};
    if (room.mean->value > 0.0) {
      const double u0 = room.minimum->value / room.mean->value;
      room.u0 =
          Estimate{u0, std::hypot(room.minimum->error, u0 * room.mean->error) / room.mean->value};
    }
  }

  const SurveyedScene& scene_;
  const SurveyConfig& config_;
  std::vector<RoomFigures> figures_;
  std::vector<Cylinder> cylinders_;
};

}  // namespace

bool lies_in(const RoomFigures& room, const Vec3& p) {
  return p.z >= room.room.floor_m && p.z <= room.room.ceiling_m && room.room.plan.contains(Vec2(p));
}

Verdict verdict_of(const RoomFigures& room) {
  if (!(room.room.required > 0.0) || !room.mean) return Verdict::none_asked;
  const double more = room.mean->value - room.room.required;
  if (std::abs(more) <= verdict_deviations * room.mean->error) return Verdict::within_error;
  return more > 0.0 ? Verdict::met : Verdict::not_met;
}

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::not_met:
      return "not met";
    case Verdict::within_error:
      return "within error";
    case Verdict::none_asked:
      break;
  }
  return "";
}

std::vector<RoomFigures> survey_rooms(const SurveyedScene& scene, std::vector<SurveyRoom> rooms,
                                      const SurveyConfig& config, const Progress& progress) {
  return Survey(scene, config).run(std::move(rooms), progress);
}

}  // namespace enfilade
