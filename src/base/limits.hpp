// The limits of every number that comes from outside: files, options, models. Within them nothing
// that is computed overflows, underflows, or loses the digits that it needs.
#pragma once

#include <cstddef>
#include <string>

#include "base/geometry.hpp"

namespace enfilade::limits {

/// Farther out, lengths and areas lose their digits.
inline constexpr double farthest_m = 1e9;
/// A scene of less extent is no building in any unit: its areas, squared, would underflow.
inline constexpr double smallest_extent_m = 1e-6;
/// Of one extent of a luminaire's opening; 0 stands for none.
inline constexpr double largest_opening_m = 1e4, smallest_opening_m = 1e-6;
/// Light, per band, in the scene's unit: products of it with areas and errors stay finite.
inline constexpr double most_light = 1e30, least_light = 1e-30;
inline constexpr std::size_t most_bands = 1024;
/// Of what is listed in one file: surfaces, lights, probes, points, cameras.
inline constexpr std::size_t most_items = 100'000'000;
/// Corners of one polygon.
inline constexpr std::size_t most_corners = 4'000;

/// What is wrong with a number, and what to do; both are empty where nothing is.
struct Fault {
  std::string what, hint;
  explicit operator bool() const { return !what.empty(); }
};

/// Of a place, metres.
Fault fault_of_place(const Vec3& p);
/// Of the extents of a luminaire's opening, metres.
Fault fault_of_opening(const Vec3& size);
/// Of light in one band: 0, or from least_light to most_light.
Fault fault_of_light(double light);
/// Of a count of `things` ("surfaces").
Fault fault_of_count(std::size_t count, std::size_t most, const std::string& things);
/// Of a direction of any length above 0.
Fault fault_of_direction(const Vec3& v);
/// Returns the direction as a unit vector; its length may be any that a double has.
Vec3 unit(const Vec3& v);

}  // namespace enfilade::limits
