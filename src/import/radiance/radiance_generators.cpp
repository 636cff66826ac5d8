#include "import/radiance/radiance_generators.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// The words of a generator, taken one by one.
class Arguments {
 public:
  Arguments(const char* program, const std::vector<std::string>& words, const RadiancePlace& place)
      : program_(program), words_(words), place_(place) {}

  bool more() const { return at_ < words_.size(); }
  const std::string& word(const char* wanted) {
    if (!more()) fail(std::string("breaks off before ") + wanted);
    return words_[at_++];
  }
  double number(const char* wanted) { return radiance_number(word(wanted), place_); }
  Vec3 point(const char* wanted) {
    const double x = number(wanted), y = number(wanted), z = number(wanted);
    return {x, y, z};
  }
  [[noreturn]] void fail(const std::string& what) const {
    place_.fail(
        std::string(program_) + " " + what,
        std::string("write its arguments as Radiance's manual of ") + program_ + " has them");
  }

 private:
  const char* program_;
  const std::vector<std::string>& words_;
  const RadiancePlace& place_;
  std::size_t at_ = 0;
};

void turn_around(std::vector<Polygon>& polygons) {
  for (Polygon& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
}

}  // namespace

RadianceGenerated radiance_box(const std::vector<std::string>& words, const RadiancePlace& place) {
  Arguments arguments("genbox", words, place);
  RadianceGenerated box{arguments.word("the modifier"), arguments.word("the name"), {}};
  const Vec3 size = arguments.point("the size");
  if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0)) arguments.fail("has a size of zero or less");
  bool inward = false;
  while (arguments.more()) {
    const std::string& option = arguments.word("an option");
    if (option == "-i")
      inward = true;
    else if (option == "-r" || option == "-b")
      arguments.number("the radius");
    else
      arguments.fail("has the option " + radiance_quoted(option) + ", which is not known");
  }
  const auto corners = Box{Vec3(0.0), size}.corners();
  for (const auto& face :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
        std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    Polygon& polygon = box.polygons.emplace_back();
    for (const int corner : face) polygon.push_back(corners[static_cast<std::size_t>(corner)]);
  }
  if (inward) turn_around(box.polygons);
  return box;
}

RadianceGenerated radiance_prism(const std::vector<std::string>& words,
                                 const RadiancePlace& place) {
  Arguments arguments("genprism", words, place);
  RadianceGenerated prism{arguments.word("the modifier"), arguments.word("the name"), {}};
  const double count = arguments.number("the number of corners");
  if (count < 3.0 || count > 1e6 || count != std::floor(count))
    arguments.fail("has no fitting number of corners: files of corners are not read");
  Polygon base;
  for (double i = 0.0; i < count; ++i) {
    const double x = arguments.number("a corner"), y = arguments.number("a corner");
    base.emplace_back(x, y, 0.0);
  }
  Vec3 along(0.0, 0.0, 1.0);
  bool ends = true, closes = true;
  while (arguments.more()) {
    const std::string& option = arguments.word("an option");
    if (option == "-l")
      along = arguments.point("the direction");
    else if (option == "-e")
      ends = false;
    else if (option == "-c")
      closes = false;
    else if (option == "-r")
      arguments.number("the radius");
    else
      arguments.fail("has the option " + radiance_quoted(option) + ", which is not known");
  }
  const std::size_t sides = base.size() - (closes ? 0 : 1);
  for (std::size_t i = 0; i < sides; ++i) {
    const Vec3 &a = base[i], &b = base[(i + 1) % base.size()];
    prism.polygons.push_back({a, b, b + along, a + along});
  }
  if (ends) {
    Polygon top = base;
    for (Vec3& p : top) p += along;
    prism.polygons.push_back(std::move(top));
    std::reverse(base.begin(), base.end());
    prism.polygons.push_back(base);
    std::reverse(base.begin(), base.end());
  }
  if (area_vector(base).z * along.z < 0.0) turn_around(prism.polygons);
  return prism;
}

}  // namespace enfilade
