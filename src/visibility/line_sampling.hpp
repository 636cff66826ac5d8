// Random lines of a line space: rays along them show which planes may stop all of it.
#pragma once

#include <optional>

#include "base/random.hpp"
#include "visibility/line_space.hpp"

namespace enfilade {

/// From point a of one side's part to point b of the other side's.
struct SampledLine {
  const LineSpacePart* from = nullptr;
  const LineSpacePart* to = nullptr;
  Vec3 a{0.0}, b{0.0};
};

/// Returns a random line that passes all windows; none where a few tries find none.
std::optional<SampledLine> draw_line(const LineSpace& lines, Random& random);
/// Returns a random line between the sides that need not pass the windows; none where the two
/// points drawn do not face each other.
std::optional<SampledLine> draw_any_line(const LineSpace& lines, Random& random);

}  // namespace enfilade
