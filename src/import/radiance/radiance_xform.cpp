#include "import/radiance/radiance_xform.hpp"

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

class XformReader {
 public:
  XformReader(const std::vector<std::string>& words, const RadiancePlace& place)
      : words_(words), place_(place) {}

  RadianceXform read() {
    while (at_ < words_.size()) {
      const std::string& word = words_[at_++];
      if (word.size() > 1 && word[0] == '-' && xform_.files.empty())
        read_option(word);
      else
        xform_.files.push_back(word);
    }
    end_segment();
    return std::move(xform_);
  }

 private:
  const std::string& next(const std::string& option) {
    if (at_ == words_.size())
      place_.fail("xform breaks off after " + option, "write what belongs to the option");
    return words_[at_++];
  }

  double number(const std::string& option) { return radiance_number(next(option), place_); }

  void add(const glm::dmat3& linear, const Vec3& shift = Vec3(0.0)) {
    segment_ = segment_.then({linear, shift});
  }

  void read_option(const std::string& option) {
    const int axis = option.size() == 3 ? option[2] - 'x' : -1;
    const bool has_axis = axis >= 0 && axis <= 2;
    if (option == "-n") {
      xform_.prefix = next(option);
    } else if (option == "-m") {
      xform_.modifier = next(option);
    } else if (option == "-I") {
      xform_.inverts = !xform_.inverts;
    } else if (option == "-a" || option == "-i") {
      end_segment();
      is_array_ = option == "-a";
      count_ = count(option);
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
    } else if (option != "-e") {  // commands are expanded here anyway
      place_.fail("xform's option " + radiance_quoted(option) + " is not carried out",
                  "expand the file with Radiance's own xform first (xform -e model.rad > "
                  "expanded.rad)");
    }
  }

  std::size_t count(const std::string& option) {
    const double value = number(option);
    if (value < 0.0 || value != std::floor(value) ||
        value > static_cast<double>(most_radiance_copies)) {
      place_.fail("xform's " + option + " has no fitting count",
                  "write a whole number, up to " + std::to_string(most_radiance_copies));
    }
    return static_cast<std::size_t>(value);
  }

  // The steps since the last -a or -i, as often as it says.
  void end_segment() {
    RadianceXform repeated;
    repeated.copies.clear();
    RadianceTransform power;
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_array_) repeated.copies.push_back(power);
      power = power.then(segment_);
    }
    if (!is_array_) repeated.copies.push_back(power);
    xform_.copies = xform_.then(repeated, place_).copies;
    segment_ = {};
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

  const std::vector<std::string>& words_;
  const RadiancePlace& place_;
  std::size_t at_ = 0;
  RadianceXform xform_;
  RadianceTransform segment_;
  std::size_t count_ = 1;
  bool is_array_ = false;
};

}  // namespace

RadianceXform RadianceXform::then(const RadianceXform& next, const RadiancePlace& place) const {
  RadianceXform both = *this;
  if (copies.size() * next.copies.size() > most_radiance_copies) {
    place.fail("arrays make more than " + std::to_string(most_radiance_copies) + " copies",
               "make fewer");
  }
  both.copies.clear();
  for (const RadianceTransform& after : next.copies) {
    for (const RadianceTransform& before : copies) both.copies.push_back(before.then(after));
  }
  if (!next.prefix.empty()) both.prefix = next.prefix + (prefix.empty() ? "" : "." + prefix);
  if (!next.modifier.empty()) both.modifier = next.modifier;
  both.inverts = inverts != next.inverts;
  return both;
}

RadianceXform parse_radiance_xform(const std::vector<std::string>& words,
                                   const RadiancePlace& place) {
  return XformReader(words, place).read();
}

}  // namespace enfilade
