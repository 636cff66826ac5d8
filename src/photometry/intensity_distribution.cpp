#include "photometry/intensity_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace enfilade {
namespace {

using std::numbers::pi;
constexpr double radians = pi / 180.0;

/// The integral of (a + b t) sin t from t0 to t1.
double sine_integral(double a, double b, double t0, double t1) {
  const auto antiderivative = [&](double t) {
    return -(a + b * t) * std::cos(t) + b * std::sin(t);
  };
  return antiderivative(t1) - antiderivative(t0);
}

void check(const IntensityTable& table) {
  const auto fail = [](const char* what) { throw std::invalid_argument(what); };
  if (table.planes.empty() || table.angles.size() < 2) fail("needs a plane and two angles");
  if (table.candela.size() != table.planes.size() * table.angles.size())
    fail("has not one intensity for each plane and angle");
  const auto ascends = [](const std::vector<double>& list) {
    return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
  };
  if (!ascends(table.planes) || !ascends(table.angles)) fail("has angles that do not ascend");
  const bool c = table.type == PhotometryType::c;
  if (table.angles.front() < (c ? 0.0 : -180.0) || table.angles.back() > 180.0 ||
      table.planes.front() < (c ? 0.0 : -180.0) || table.planes.back() > (c ? 360.02 : 180.0))
    fail("has angles out of range");
  for (const double cd : table.candela)
    if (!(cd >= 0.0) || cd > 1e15) fail("has an intensity that is negative or too large");
}

}  // namespace

IntensityDistribution::IntensityDistribution(IntensityTable table) : type_(table.type) {
  check(table);
  std::string fault;
  const IntensityTable whole = expanded(table, fault);
  if (!fault.empty()) throw std::invalid_argument(fault);
  given_ = std::move(table);
  if (whole.planes.size() > 1)
    for (const double plane : whole.planes) planes_.push_back(plane * radians);
  // Types A and B measure from the axis's plane, the polar angle from the axis.
  const double shift = type_ == PhotometryType::c ? 0.0 : 90.0;
  for (const double angle : whole.angles)
    angles_.push_back(std::clamp((angle + shift) * radians, 0.0, pi));
  candela_ = whole.candela;
  if (type_ != PhotometryType::c && (whole.angles.front() < -90.0 || whole.angles.back() > 90.0))
    throw std::invalid_argument("has angles beyond 90 degrees within a plane of type A or B");
  if (planes_.size() > 1 && std::abs(planes_.back() - planes_.front() - 2.0 * pi) < 1e-3)
    planes_.back() = planes_.front() + 2.0 * pi;
  index_angles();
  sum_up();
  if (!(flux_ > 0.0)) throw std::invalid_argument("gives no light: all its intensities are zero");
}

void IntensityDistribution::index_angles() {
  angle_at_degree_.resize(182);
  std::size_t k = 0;
  for (std::size_t degree = 0; degree < angle_at_degree_.size(); ++degree) {
    while (k + 1 < angles_.size() && angles_[k + 1] <= static_cast<double>(degree) * radians) ++k;
    angle_at_degree_[degree] = static_cast<std::uint32_t>(k);
  }
  const double steps = (angles_.back() - angles_.front()) / static_cast<double>(angles_.size() - 1);
  step_ = std::clamp(steps, 1.0 * radians, 15.0 * radians);
}

void IntensityDistribution::sum_up() {
  const std::size_t n = angles_.size(), count = std::max<std::size_t>(1, planes_.size());
  cumulative_.assign(count * n, 0.0);
  ring_most_.assign(n, 0.0);
  for (std::size_t p = 0; p < count; ++p) {
    for (std::size_t k = 0; k < n; ++k) {
      ring_most_[k] = std::max(ring_most_[k], candela_[p * n + k]);
      if (k > 0)
        cumulative_[p * n + k] = cumulative_[p * n + k - 1] + cumulative_in(p, k - 1, angles_[k]);
    }
  }
  peak_ = *std::max_element(ring_most_.begin(), ring_most_.end());
  const std::size_t wedges = planes_.size() > 1 ? planes_.size() - 1 : 1;
  for (std::size_t w = 0; w < wedges; ++w) {
    const double width = planes_.size() > 1 ? planes_[w + 1] - planes_[w] : 2.0 * pi;
    const std::size_t other = planes_.size() > 1 ? w + 1 : w;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      const auto part = [&](std::size_t p) {
        return cumulative_[p * n + k + 1] - cumulative_[p * n + k];
      };
      flux_ += 0.5 * width * (part(w) + part(other));
      cell_flux_.push_back(flux_);
    }
  }
  mean_ = flux_ / (4.0 * pi);
}

Vec3 IntensityDistribution::to_polar(const Vec3& v) const {
  switch (type_) {
    case PhotometryType::a:
      return {v.z, v.x, -v.y};
    case PhotometryType::b:
      return {v.z, v.y, -v.x};
    case PhotometryType::c:
      break;
  }
  return v;
}

Vec3 IntensityDistribution::from_polar(const Vec3& v) const {
  switch (type_) {
    case PhotometryType::a:
      return {v.y, -v.z, v.x};
    case PhotometryType::b:
      return {-v.z, v.y, v.x};
    case PhotometryType::c:
      break;
  }
  return v;
}

/// False outside the planes.
bool IntensityDistribution::find_plane(double azimuth, Between& between) const {
  const double first = planes_.front(), last = planes_.back();
  while (azimuth < first) azimuth += 2.0 * pi;
  while (azimuth >= first + 2.0 * pi) azimuth -= 2.0 * pi;
  if (azimuth > last) return false;
  const auto above = std::upper_bound(planes_.begin(), planes_.end(), azimuth);
  const auto i = static_cast<std::size_t>(above - planes_.begin());
  between.low = std::min(i, planes_.size() - 1) - 1;
  between.share =
      (azimuth - planes_[between.low]) / (planes_[between.low + 1] - planes_[between.low]);
  return true;
}

std::size_t IntensityDistribution::find_angle(double angle) const {
  const auto degree = static_cast<std::size_t>(std::clamp(angle / radians, 0.0, 180.0));
  std::size_t k = angle_at_degree_[degree];
  while (k + 2 < angles_.size() && angles_[k + 1] <= angle) ++k;
  return std::min(k, angles_.size() - 2);
}

double IntensityDistribution::value(std::size_t plane, std::size_t low, double angle) const {
  const double* at = candela_.data() + plane * angles_.size() + low;
  const double share = (angle - angles_[low]) / (angles_[low + 1] - angles_[low]);
  return at[0] + share * (at[1] - at[0]);
}

double IntensityDistribution::intensity(const Vec3& v) const {
  const Vec3 w = to_polar(v);
  const double ring = std::hypot(w.x, w.y);
  // Directions in a limiting plane (a horizontal one for a table to 90 degrees) belong to it.
  constexpr double rounding = 1e-9;
  double angle = std::atan2(ring, w.z);
  if (angle < angles_.front() - rounding || angle > angles_.back() + rounding) return 0.0;
  angle = std::clamp(angle, angles_.front(), angles_.back());
  const std::size_t low = find_angle(angle);
  if (planes_.empty()) return value(0, low, angle);
  Between between;
  if (!find_plane(std::atan2(w.y, w.x), between)) return 0.0;
  return (1.0 - between.share) * value(between.low, low, angle) +
         between.share * value(between.low + 1, low, angle);
}

/// The integral of one plane's intensity times the sine from entry `low` to `angle`.
double IntensityDistribution::cumulative_in(std::size_t plane, std::size_t low,
                                            double angle) const {
  const double* at = candela_.data() + plane * angles_.size() + low;
  const double b = (at[1] - at[0]) / (angles_[low + 1] - angles_[low]);
  return sine_integral(at[0] - b * angles_[low], b, angles_[low], angle);
}

IntensityDistribution::Cumulative IntensityDistribution::cumulative(double angle,
                                                                    double azimuth) const {
  Cumulative sum;
  Between between;
  if (!planes_.empty() && !find_plane(azimuth, between)) return sum;
  const std::size_t n = angles_.size();
  angle = std::clamp(angle, angles_.front(), angles_.back());
  const std::size_t low = find_angle(angle);
  const auto add = [&](std::size_t plane, double share) {
    sum.to += share * (cumulative_[plane * n + low] + cumulative_in(plane, low, angle));
    sum.whole += share * cumulative_[plane * n + n - 1];
  };
  add(between.low, 1.0 - between.share);
  if (!planes_.empty()) add(between.low + 1, between.share);
  return sum;
}

double IntensityDistribution::most_within(const ViewCone& cone) const {
  const Vec3 w = to_polar(cone.axis);
  const double angle = std::atan2(std::hypot(w.x, w.y), w.z);
  const double from = angle - cone.half_angle, to = angle + cone.half_angle;
  if (to < angles_.front() || from > angles_.back()) return 0.0;
  double most = 0.0;
  for (std::size_t k = find_angle(std::max(0.0, from)); k < angles_.size(); ++k) {
    most = std::max(most, ring_most_[k]);
    if (angles_[k] >= to) break;
  }
  return most;
}

bool IntensityDistribution::is_dark_behind() const {
  constexpr double right_angle = 0.5 * pi + 1e-9;
  if (type_ == PhotometryType::c) {
    // Between the last angle with light and the next one there is light, too.
    for (std::size_t k = 0; k < angles_.size(); ++k) {
      const double most = std::max(ring_most_[k], k > 0 ? ring_most_[k - 1] : 0.0);
      if (angles_[k] > right_angle && most > 0.0) return false;
    }
    return true;
  }
  return planes_.front() >= -right_angle && planes_.back() <= right_angle;
}

/// A cell of the table by its flux, then a direction within it, uniform in solid angle.
SampledDirection IntensityDistribution::sample(double r1, double r2) const {
  const double pick = r1 * flux_;
  const auto above = std::upper_bound(cell_flux_.begin(), cell_flux_.end(), pick);
  const auto cell =
      std::min(static_cast<std::size_t>(above - cell_flux_.begin()), cell_flux_.size() - 1);
  const double before = cell > 0 ? cell_flux_[cell - 1] : 0.0, of_cell = cell_flux_[cell] - before;
  const double share = of_cell > 0.0 ? std::clamp((pick - before) / of_cell, 0.0, 1.0) : 0.5;
  const std::size_t cells = angles_.size() - 1, wedge = cell / cells, k = cell % cells;
  const double first = planes_.empty() ? 0.0 : planes_[wedge];
  const double width = planes_.empty() ? 2.0 * pi : planes_[wedge + 1] - first;
  const double z0 = std::cos(angles_[k]), z1 = std::cos(angles_[k + 1]);
  const double z = z0 + share * (z1 - z0), azimuth = first + r2 * width;
  const double ring = std::sqrt(std::max(0.0, 1.0 - z * z));
  SampledDirection sampled;
  sampled.toward = from_polar({ring * std::cos(azimuth), ring * std::sin(azimuth), z});
  if (of_cell > 0.0) sampled.weight = intensity(sampled.toward) * width * (z0 - z1) / of_cell;
  return sampled;
}

IntensityDistribution IntensityDistribution::front_half() const {
  IntensityTable front = given_;
  std::string fault;
  if (type_ != PhotometryType::c) {
    const IntensityTable whole = expanded(front, fault);
    front = {type_, {}, whole.angles, {}};
    for (std::size_t p = 0; p < whole.planes.size(); ++p) {
      if (std::abs(whole.planes[p]) > 90.0) continue;
      front.planes.push_back(whole.planes[p]);
      for (std::size_t k = 0; k < whole.angles.size(); ++k) front.candela.push_back(whole.at(p, k));
    }
    return IntensityDistribution(std::move(front));
  }
  if (given_.angles.back() <= 90.0) return *this;
  front.angles.clear();
  front.candela.clear();
  for (const double angle : given_.angles)
    if (angle < 90.0) front.angles.push_back(angle);
  const std::size_t kept = front.angles.size();
  if (kept == 0) throw std::invalid_argument("gives no light to the front");
  front.angles.push_back(90.0);
  const double share =
      (90.0 - given_.angles[kept - 1]) / (given_.angles[kept] - given_.angles[kept - 1]);
  for (std::size_t p = 0; p < given_.planes.size(); ++p) {
    for (std::size_t k = 0; k < kept; ++k) front.candela.push_back(given_.at(p, k));
    front.candela.push_back((1.0 - share) * given_.at(p, kept - 1) + share * given_.at(p, kept));
  }
  return IntensityDistribution(std::move(front));
}

IntensityDistribution spot_distribution(double inner, double outer) {
  constexpr int steps = 96;
  IntensityTable table;
  table.planes = {0.0};
  const double from = std::cos(inner), to = std::cos(outer);
  const auto add = [&](double angle, double cd) {
    const double degrees = std::min(180.0, angle / radians);
    if (!table.angles.empty() && degrees <= table.angles.back()) return;
    table.angles.push_back(degrees);
    table.candela.push_back(cd);
  };
  add(0.0, 1.0);
  for (int i = 0; i <= steps; ++i) {
    const double angle = inner + (outer - inner) * i / steps;
    const double share = from > to ? (std::cos(angle) - to) / (from - to) : 1.0;
    add(angle, std::pow(std::clamp(share, 0.0, 1.0), 2.0));
  }
  return IntensityDistribution(std::move(table));
}

}  // namespace enfilade
