#include "photometry/intensity_table.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// Angles in files are rounded to a hundredth of a degree at worst.
constexpr double same_angle = 0.011;

bool near(double a, double b) { return std::abs(a - b) <= same_angle; }

/// Adds the planes mirrored about angle `about`; the plane at `about` stays one.
IntensityTable mirrored(const IntensityTable& half, double about) {
  IntensityTable whole = half;
  const std::size_t n = half.angles.size();
  whole.planes.clear();
  whole.candela.clear();
  const auto take = [&](std::size_t plane, double angle) {
    whole.planes.push_back(angle);
    const auto from = half.candela.begin() + static_cast<std::ptrdiff_t>(plane * n);
    whole.candela.insert(whole.candela.end(), from, from + static_cast<std::ptrdiff_t>(n));
  };
  const std::size_t count = half.planes.size();
  const bool upward = about > half.planes.front() + same_angle;
  if (!upward) {
    for (std::size_t p = count; p-- > 0;)
      if (!near(half.planes[p], about)) take(p, 2.0 * about - half.planes[p]);
  }
  for (std::size_t p = 0; p < count; ++p) take(p, half.planes[p]);
  if (upward) {
    for (std::size_t p = count; p-- > 0;)
      if (!near(half.planes[p], about)) take(p, 2.0 * about - half.planes[p]);
  }
  return whole;
}

/// Mirrors the angles within each plane about 0.
IntensityTable with_negative_angles(const IntensityTable& half) {
  IntensityTable whole = half;
  const std::size_t n = half.angles.size();
  whole.angles.clear();
  whole.candela.clear();
  for (std::size_t i = n; i-- > 1;) whole.angles.push_back(-half.angles[i]);
  whole.angles.insert(whole.angles.end(), half.angles.begin(), half.angles.end());
  for (std::size_t p = 0; p < half.planes.size(); ++p) {
    for (std::size_t i = n; i-- > 1;) whole.candela.push_back(half.at(p, i));
    for (std::size_t i = 0; i < n; ++i) whole.candela.push_back(half.at(p, i));
  }
  return whole;
}

/// Planes from 90 or 180 mirrored to below, as angles within a circle that begins at 0.
IntensityTable from_zero(IntensityTable table) {
  const std::size_t n = table.angles.size();
  if (table.planes.front() >= -same_angle && table.planes.back() <= 360.0 + same_angle)
    return table;
  IntensityTable turned = table;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t p = 0; p + 1 < table.planes.size(); ++p)
    order.emplace_back(std::fmod(table.planes[p] + 720.0, 360.0), p);
  std::sort(order.begin(), order.end());
  turned.planes.clear();
  turned.candela.clear();
  for (const auto& [angle, p] : order) {
    turned.planes.push_back(angle);
    for (std::size_t i = 0; i < n; ++i) turned.candela.push_back(table.at(p, i));
  }
  turned.planes.push_back(turned.planes.front() + 360.0);
  for (std::size_t i = 0; i < n; ++i) turned.candela.push_back(turned.candela[i]);
  return turned;
}

IntensityTable expanded_c(IntensityTable table, std::string& fault) {
  if (table.planes.size() == 1) return table;
  const double first = table.planes.front(), last = table.planes.back();
  const double step = last - table.planes[table.planes.size() - 2];
  if (near(last - first, 360.0)) {
    table.planes.back() = first + 360.0;
    return from_zero(table);
  }
  if (near(first, 0.0) && near(last, 90.0)) return mirrored(mirrored(table, 90.0), 180.0);
  if (near(first, 0.0) && near(last, 180.0)) return mirrored(table, 180.0);
  if (near(first, 90.0) && near(last, 270.0)) return from_zero(mirrored(table, 270.0));
  if (near(first, 0.0) && near(last + step, 360.0)) {
    const std::size_t n = table.angles.size();
    table.planes.push_back(360.0);
    for (std::size_t i = 0; i < n; ++i) table.candela.push_back(table.candela[i]);
    return table;
  }
  fault = "has planes from " + std::to_string(std::lround(first)) + " to " +
          std::to_string(std::lround(last)) + " degrees, which are no part of a symmetry";
  return table;
}

}  // namespace

std::string symmetry_of(const IntensityTable& table) {
  const double first = table.planes.front(), last = table.planes.back();
  if (table.type == PhotometryType::a) return near(first, 0.0) ? "bilateral" : "none";
  if (table.type == PhotometryType::b) return near(table.angles[0], 0.0) ? "bilateral" : "none";
  if (table.planes.size() == 1) return "rotational";
  if (near(first, 0.0) && near(last, 90.0)) return "quadrant";
  if (near(last - first, 180.0)) return "bilateral";
  return "none";
}

IntensityTable expanded(const IntensityTable& table, std::string& fault) {
  if (table.type == PhotometryType::c) return expanded_c(table, fault);
  if (table.planes.size() < 2 || table.angles.size() < 2) {
    fault = "has a single plane or angle of type A or B";
    return table;
  }
  // Horizontal angles from 0 stand for both sides; vertical ones stand for themselves.
  if (table.type == PhotometryType::a)
    return near(table.planes.front(), 0.0) ? mirrored(table, 0.0) : table;
  return near(table.angles.front(), 0.0) ? with_negative_angles(table) : table;
}

}  // namespace enfilade
