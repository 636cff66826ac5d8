#include "photometry/luminous_opening.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

using Face = std::vector<Vec3>;

/// A polygon with semi-axes a and b about the middle, and the ellipse's area.
Face ellipse(const Vec3& a, const Vec3& b) {
  constexpr int sides = 24;
  constexpr double step = 2.0 * std::numbers::pi / sides;
  const double scale = std::sqrt(step / std::sin(step));
  Face face;
  for (int i = 0; i < sides; ++i)
    face.push_back(scale * (std::cos((i + 0.5) * step) * a + std::sin((i + 0.5) * step) * b));
  return face;
}

Face rectangle(const Vec3& middle, const Vec3& a, const Vec3& b) {
  return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
}

std::vector<Face> box(const Vec3& half) {
  const Vec3 x(half.x, 0, 0), y(0, half.y, 0), z(0, 0, half.z);
  return {rectangle(z, x, y),  rectangle(-z, y, x), rectangle(x, y, z),
          rectangle(-x, z, y), rectangle(y, z, x),  rectangle(-y, x, z)};
}

/// A line, and a plate seen from its edge, are this share of their length wide.
constexpr double least_share = 1e-2;

Vec3 widened(Vec3 size, std::initializer_list<int> axes) {
  const double least = least_share * std::max({size.x, size.y, size.z});
  for (const int axis : axes) size[axis] = std::max(size[axis], least);
  return size;
}

}  // namespace

const char* name_of(OpeningShape shape) {
  switch (shape) {
    case OpeningShape::point:
      return "point";
    case OpeningShape::rectangle:
      return "rectangle";
    case OpeningShape::disc:
      return "disc";
    case OpeningShape::box:
      return "box";
    case OpeningShape::cylinder:
      return "cylinder";
    case OpeningShape::cylinder_right:
      return "cylinder_right";
    case OpeningShape::cylinder_up:
      return "cylinder_up";
    case OpeningShape::ellipsoid:
      return "ellipsoid";
    case OpeningShape::upright_disc:
      return "upright_disc";
  }
  return "point";
}

std::vector<std::vector<Vec3>> LuminousOpening::faces() const {
  const Vec3 h = 0.5 * size;
  // A square of a circle's area; a box whose surface has a sphere's second moments.
  const double square = 0.5 * std::sqrt(std::numbers::pi), ball = std::sqrt(0.6);
  switch (shape) {
    case OpeningShape::point:
      break;
    case OpeningShape::rectangle: {
      const Vec3 w = 0.5 * widened(size, {0, 1});
      return {rectangle(Vec3(0.0), {w.x, 0, 0}, {0, w.y, 0})};
    }
    case OpeningShape::disc:
      return {ellipse({h.x, 0, 0}, {0, h.y, 0})};
    case OpeningShape::upright_disc:
      return {ellipse({0, h.y, 0}, {0, 0, h.z})};
    case OpeningShape::box:
      return box(0.5 * widened(size, {0, 1, 2}));
    case OpeningShape::cylinder:
      return box(h * Vec3(square, square, 1.0));
    case OpeningShape::cylinder_right:
      return box(h * Vec3(1.0, square, square));
    case OpeningShape::cylinder_up:
      return box(h * Vec3(square, 1.0, square));
    case OpeningShape::ellipsoid:
      return box(h * ball);
  }
  return {};
}

std::string described(const LuminousOpening& opening) {
  const Vec3& s = opening.size;
  std::string shape = name_of(opening.shape);
  switch (opening.shape) {
    case OpeningShape::point:
      return "point";
    case OpeningShape::rectangle:
      return fmt::format("{:.3f} x {:.3f} m {}", s.x, s.y, shape);
    case OpeningShape::disc:
      if (s.x == s.y) return fmt::format("{:.3f} m disc", s.x);
      return fmt::format("{:.3f} x {:.3f} m ellipse", s.x, s.y);
    default:
      break;
  }
  for (char& c : shape) c = c == '_' ? ' ' : c;
  if (opening.shape == OpeningShape::ellipsoid && s.x == s.y && s.y == s.z)
    return fmt::format("{:.3f} m sphere", s.x);
  return fmt::format("{:.3f} x {:.3f} x {:.3f} m {}", s.x, s.y, s.z, shape);
}

LuminousOpening opening_by_lm63(int year, double width, double length, double height, bool& known) {
  const auto sign = [](double x) { return x < 0.0 ? '-' : x > 0.0 ? '+' : '0'; };
  const std::string code{sign(length), sign(width), sign(height)};
  const Vec3 size(std::abs(length), std::abs(width), std::abs(height));
  const double w = size.y, h = size.z;
  known = true;
  if (code == "000") return {};
  if (code == "++0") return {OpeningShape::rectangle, size};
  if (code == "+++" || code == "0++" || code == "+0+") return {OpeningShape::box, size};
  if (code == "0-0") return {OpeningShape::disc, {w, w, 0.0}};
  if (year >= 2002) {
    if (code == "--0") return {OpeningShape::disc, size};
    if (code == "--+") return {OpeningShape::cylinder, size};
    if (code == "---") return {OpeningShape::ellipsoid, size};
    if (code == "+--") return {OpeningShape::cylinder_right, size};
    if (code == "-+-") return {OpeningShape::cylinder_up, size};
    if (code == "0--" || code == "-0-")
      return {OpeningShape::upright_disc, {0.0, std::max(size.x, size.y), h}};
  } else if (year == 1995) {
    if (code == "0--") return {OpeningShape::ellipsoid, {w, w, h}};
    if (code == "0-+") return {OpeningShape::cylinder, {w, w, h}};
    if (code == "+0-") return {OpeningShape::cylinder_right, {size.x, h, h}};
    if (code == "0+-") return {OpeningShape::cylinder_up, {h, w, h}};
    if (code == "-+0" || code == "+-0") return {OpeningShape::disc, size};
    if (code == "-++" || code == "+-+") return {OpeningShape::cylinder, size};
    if (code == "-+-" || code == "+--") return {OpeningShape::ellipsoid, size};
  } else {
    if (code == "0-+") return {OpeningShape::cylinder, {w, w, h}};
    if (code == "+-0") return {OpeningShape::disc, size};
    if (code == "+-+") return {OpeningShape::ellipsoid, size};
  }
  known = code == "+00" || code == "0+0" || code == "00+";
  const bool curved = code.find('-') != std::string::npos;
  if (curved && h == 0.0) {
    const double d = std::max(size.x, size.y);
    return {OpeningShape::disc, {size.x > 0.0 ? size.x : d, size.y > 0.0 ? size.y : d, 0.0}};
  }
  if (curved) {
    const double d = std::max({size.x, size.y, h});
    return {OpeningShape::ellipsoid, {size.x > 0 ? size.x : d, size.y > 0 ? size.y : d, h}};
  }
  return {h > 0.0 ? OpeningShape::box : OpeningShape::rectangle, size};
}

}  // namespace enfilade
