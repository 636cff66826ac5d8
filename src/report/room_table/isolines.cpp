#include "report/room_table/isolines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace enfilade {
namespace {

constexpr int line_refinement = 4;

bool is_known(const GridField& field, int column, int row) {
  return column >= 0 && row >= 0 && column < field.columns && row < field.rows &&
         std::isfinite(field.at(column, row));
}

/// Joins segments that share an end, which are equal to the bit, into lines.
std::vector<std::vector<Vec2>> joined(std::vector<std::array<Vec2, 2>> segments) {
  std::vector<std::vector<Vec2>> lines;
  while (!segments.empty()) {
    std::vector<Vec2> line{segments.back()[0], segments.back()[1]};
    segments.pop_back();
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t i = 0; i < segments.size() && !grows; ++i) {
        for (const std::size_t end : {0u, 1u}) {
          const bool behind = segments[i][end] == line.back();
          if (!behind && segments[i][end] != line.front()) continue;
          line.insert(behind ? line.end() : line.begin(), segments[i][1 - end]);
          segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(i));
          grows = true;
          break;
        }
      }
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// Adds the segments of one square with the corners (0, 0), (1, 0), (1, 1), (0, 1).
void add_segments(const std::array<Vec2, 4>& corners, const std::array<double, 4>& values,
                  double level, std::vector<std::array<Vec2, 2>>& segments) {
  std::vector<Vec2> crossings;
  for (std::size_t i = 0; i < 4; ++i) {
    // From the lower corner on, so that the neighbour gets the same point.
    std::size_t a = i, b = (i + 1) % 4;
    if (values[b] < values[a]) std::swap(a, b);
    if ((values[a] < level) == (values[b] < level)) continue;
    const double t = (level - values[a]) / (values[b] - values[a]);
    crossings.push_back(corners[a] + t * (corners[b] - corners[a]));
  }
  if (crossings.size() == 2) segments.push_back({crossings[0], crossings[1]});
  if (crossings.size() != 4) return;
  // A saddle: the value in the middle says which corners belong together.
  const double middle = 0.25 * (values[0] + values[1] + values[2] + values[3]);
  const bool first = (values[0] < level) == (middle < level);
  segments.push_back({crossings[0], crossings[first ? 1 : 3]});
  segments.push_back({crossings[2], crossings[first ? 3 : 1]});
}

}  // namespace

double GridField::between(double u, double v) const {
  const int i = std::clamp(static_cast<int>(std::floor(u)), 0, std::max(0, columns - 2));
  const int k = std::clamp(static_cast<int>(std::floor(v)), 0, std::max(0, rows - 2));
  const int i1 = std::min(i + 1, columns - 1), k1 = std::min(k + 1, rows - 1);
  const double x = std::clamp(u - i, 0.0, 1.0), y = std::clamp(v - k, 0.0, 1.0);
  if (is_known(*this, i, k) && is_known(*this, i1, k) && is_known(*this, i, k1) &&
      is_known(*this, i1, k1)) {
    return (1.0 - y) * ((1.0 - x) * at(i, k) + x * at(i1, k)) +
           y * ((1.0 - x) * at(i, k1) + x * at(i1, k1));
  }
  return at(x < 0.5 ? i : i1, y < 0.5 ? k : k1);
}

std::vector<double> scale_levels(double lowest, double highest, std::size_t most) {
  std::vector<double> levels;
  if (!(highest > 0.0) || !(highest > lowest)) return levels;
  // Four decades at most: below, all is dark.
  const double from = std::max(lowest, 1e-4 * highest);
  constexpr std::array<double, 6> steps{1.0, 1.5, 2.0, 3.0, 5.0, 7.5};
  for (double decade = std::pow(10.0, std::floor(std::log10(from))); decade <= highest;
       decade *= 10.0) {
    for (const double step : steps) {
      if (step * decade > from && step * decade < highest) levels.push_back(step * decade);
    }
  }
  if (levels.size() <= most) return levels;
  std::vector<double> thinned;
  const std::size_t every = (levels.size() + most - 1) / most;
  for (std::size_t i = 0; i < levels.size(); i += every) thinned.push_back(levels[i]);
  return thinned;
}

std::vector<std::vector<Vec2>> isolines(const GridField& field, double level) {
  std::vector<std::array<Vec2, 2>> segments;
  for (int row = 0; row + 1 < field.rows; ++row) {
    for (int column = 0; column + 1 < field.columns; ++column) {
      if (!is_known(field, column, row) || !is_known(field, column + 1, row) ||
          !is_known(field, column, row + 1) || !is_known(field, column + 1, row + 1))
        continue;
      for (int k = 0; k < line_refinement * line_refinement; ++k) {
        const double x = column + (k % line_refinement) / double(line_refinement);
        const double y = row + (k / line_refinement) / double(line_refinement);
        constexpr double step = 1.0 / line_refinement;
        const std::array<Vec2, 4> corners{Vec2(x, y), Vec2(x + step, y), Vec2(x + step, y + step),
                                          Vec2(x, y + step)};
        std::array<double, 4> values{};
        for (std::size_t c = 0; c < 4; ++c) values[c] = field.between(corners[c].x, corners[c].y);
        add_segments(corners, values, level, segments);
      }
    }
  }
  return joined(std::move(segments));
}

}  // namespace enfilade
