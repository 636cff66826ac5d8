#include "import/radiance_xform.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace enfilade {
namespace {

const char* const remedy =
    "expand the file with Radiance's own xform first (xform -e model.rad > expanded.rad)";

class XformReader {
 public:
  XformReader(const std::string& command, const RadiancePlace& place)
      : command_(command), words_(command), place_(place) {}

  RadianceXform read() {
    // What a shell would read in a special way may mean anything.
    std::string word;
    if (command_.find_first_of("|&;<>()$`*?[]{}~\\\"'#") != std::string::npos ||
        !(words_ >> word) || word != "xform") {
      place_.fail("the command " + radiance_quoted("!" + command_) + " is not carried out", remedy);
    }
    while (words_ >> word) {
      if (word[0] == '-' && xform_.files.empty())
        read_option(word);
      else
        xform_.files.push_back(word);
    }
    if (xform_.files.empty()) place_.fail("xform names no file", "write the file that it takes in");
    return std::move(xform_);
  }

 private:
  std::string next(const std::string& option) {
    std::string word;
    if (!(words_ >> word))
      place_.fail("xform breaks off after " + option, "write what belongs to the option");
    return word;
  }

  double number(const std::string& option) { return radiance_number(next(option), place_); }

  void add(const glm::dmat3& linear, const Vec3& shift = Vec3(0.0)) {
    xform_.transform = xform_.transform.then({linear, shift});
  }

  void read_option(const std::string& option) {
    const int axis = option.size() == 3 ? option[2] - 'x' : -1;
    const bool has_axis = axis >= 0 && axis <= 2;
    if (option == "-n") {
      xform_.prefix = next(option);
    } else if (option == "-t") {
      const double x = number(option), y = number(option), z = number(option);
      add(glm::dmat3(1.0), {x, y, z});
    } else if (option == "-s") {
      const double factor = number(option);
      if (factor <= 0.0) place_.fail("xform has a scale that is not above zero", "correct it");
      add(glm::dmat3(factor));
    } else if (has_axis && option[1] == 'm') {
      glm::dmat3 mirror(1.0);
      mirror[axis][axis] = -1.0;
      add(mirror);
    } else if (has_axis && option[1] == 'r') {
      add(rotation(axis, number(option)));
    } else {
      place_.fail("xform's option " + radiance_quoted(option) + " is not carried out", remedy);
    }
  }

  // Counter-clockwise seen against the axis.
  static glm::dmat3 rotation(int axis, double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    glm::dmat3 turn(1.0);
    turn[a][a] = turn[b][b] = std::cos(angle);
    turn[a][b] = std::sin(angle);  // glm's first index is the column
    turn[b][a] = -std::sin(angle);
    return turn;
  }

  std::string command_;
  std::istringstream words_;
  const RadiancePlace& place_;
  RadianceXform xform_;
};

}  // namespace

RadianceTransform RadianceTransform::then(const RadianceTransform& next) const {
  return {next.linear * linear, next.linear * shift + next.shift};
}

Polygon RadianceTransform::image_of(Polygon polygon) const {
  for (Vec3& p : polygon) p = linear * p + shift;
  if (glm::determinant(linear) < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

RadianceXform parse_radiance_xform(const std::string& command, const RadiancePlace& place) {
  return XformReader(command, place).read();
}

}  // namespace enfilade
