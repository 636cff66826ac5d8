#include "import/radiance/radiance_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "import/radiance/radiance_xform.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// Values over one or two axes; the last axis runs fastest.
struct DataTable {
  std::vector<std::vector<double>> axes;
  std::vector<double> values;
};

class DataReader {
 public:
  DataReader(const std::string& path, const std::string& bytes) : text_(path, bytes) {}

  DataTable read() {
    const std::size_t axes = count("the number of axes");
    if (axes < 1 || axes > 2) fail("has more than two axes");
    DataTable table;
    std::size_t values = 1;
    for (std::size_t a = 0; a < axes; ++a) {
      const double begin = number(), end = number();
      const std::size_t points = count("the number of points");
      if (points < 2) fail("has an axis of fewer than two points");
      std::vector<double>& axis = table.axes.emplace_back();
      for (std::size_t i = 0; i < points; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(points - 1);
        axis.push_back(begin == end ? number() : begin + share * (end - begin));
      }
      values *= points;
    }
    for (std::size_t i = 0; i < values; ++i) table.values.push_back(std::max(0.0, number()));
    return table;
  }

 private:
  [[noreturn]] void fail(const std::string& what) {
    text_.place().fail("the data " + what, "make it anew with ies2rad");
  }
  double number() {
    const std::string word = text_.word("a number");
    return radiance_number(word, text_.place());
  }
  std::size_t count(const char* of) {
    const double value = number();
    if (value < 0.0 || value > 1e6 || value != std::floor(value))
      fail(std::string("has no whole number where ") + of + " is wanted");
    return static_cast<std::size_t>(value);
  }
  RadianceText text_;
};

/// The integral of an intensity over the directions up to `last` degrees from the axis, which is a
/// line through the values at the given angles.
double integral(const std::vector<double>& degrees, const std::vector<double>& values,
                double last) {
  const auto value_at = [&](double angle) {
    const auto above = std::upper_bound(degrees.begin(), degrees.end(), angle);
    if (above == degrees.begin() || (above == degrees.end() && angle > degrees.back())) return 0.0;
    const auto i = std::min(static_cast<std::size_t>(above - degrees.begin()), degrees.size() - 1);
    const double width = degrees[i] - degrees[i - 1];
    const double share = width > 0.0 ? (angle - degrees[i - 1]) / width : 0.0;
    return (1.0 - share) * values[i - 1] + share * values[i];
  };
  constexpr int steps = 3600;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double angle = last * (i + 0.5) / steps;
    sum += value_at(angle) * std::sin(angle * pi / 180.0);
  }
  return 2.0 * pi * sum * (last / steps) * pi / 180.0;
}

/// The mean over the second angle, and then the integral over the first.
double flux_of(const DataTable& table, bool theta_first, double last) {
  if (table.axes.size() == 1) return integral(table.axes[0], table.values, last);
  const std::vector<double>&theta = table.axes[theta_first ? 0 : 1],
        &phi = table.axes[theta_first ? 1 : 0];
  std::vector<double> mean(theta.size(), 0.0);
  const double range = phi.back() - phi.front();
  for (std::size_t t = 0; t < theta.size() && range > 0.0; ++t) {
    for (std::size_t p = 0; p + 1 < phi.size(); ++p) {
      const auto value = [&](std::size_t i) {
        return table.values[theta_first ? t * phi.size() + i : i * theta.size() + t];
      };
      mean[t] += 0.5 * (value(p) + value(p + 1)) * (phi[p + 1] - phi[p]) / range;
    }
  }
  return integral(theta, mean, last);
}

/// The data as a table of type C; null where its angles are not those of such a table.
std::shared_ptr<const IntensityDistribution> distribution_of(const DataTable& data,
                                                             bool theta_first) {
  IntensityTable table;
  table.planes = {0.0};
  if (data.axes.size() > 1) table.planes = data.axes[theta_first ? 1 : 0];
  table.angles = data.axes[theta_first || data.axes.size() == 1 ? 0 : 1];
  for (std::size_t p = 0; p < table.planes.size(); ++p) {
    for (std::size_t a = 0; a < table.angles.size(); ++a) {
      table.candela.push_back(
          data.values[theta_first ? a * table.planes.size() + p : p * table.angles.size() + a]);
    }
  }
  try {
    return std::make_shared<const IntensityDistribution>(std::move(table));
  } catch (const std::invalid_argument&) {
    return nullptr;
  }
}

/// The area (m2) that a source shows in a direction; of a flat one per area of its own.
double shown_area(const RadianceDistribution& d, const Vec3& w) {
  const Vec3 c = glm::abs(w);
  if (d.source == RadianceSource::box)
    return c.x * d.size.y * d.size.z + c.y * d.size.x * d.size.z + c.z * d.size.x * d.size.y;
  return d.size.x * d.size.z * std::hypot(w.x, w.y) + 0.25 * pi * d.size.x * d.size.x * c.z;
}

/// Where the words of a pattern tell of angles that are neither a plane's nor the one from the aim,
/// as of photometry of types A and B, the data are no table of type C.
bool is_type_c(const std::vector<std::string>& words, std::size_t first, std::size_t axes) {
  for (std::size_t i = first; i < first + axes && i < words.size(); ++i) {
    if (words[i] != "src_theta" && words[i] != "src_phi" && words[i] != "src_phi2" &&
        words[i] != "src_phi4")
      return false;
  }
  return true;
}

/// The turn by the words behind the angles ("-rx 90").
glm::dmat3 turn_of(const RadiancePrimitive& pattern, std::size_t first) {
  const std::vector<std::string> words(
      pattern.words.begin() + static_cast<std::ptrdiff_t>(std::min(first, pattern.words.size())),
      pattern.words.end());
  return words.empty() ? glm::dmat3(1.0)
                       : parse_radiance_xform(words, pattern.place).copies[0].linear;
}

}  // namespace

LightFrame RadianceDistribution::frame(const glm::dmat3& linear) const {
  const glm::dmat3 all = linear * turn;
  return LightFrame::of(all * Vec3(0.0, 0.0, -1.0), all * Vec3(0.0, 1.0, 0.0)).value();
}

RadianceFaceLight RadianceDistribution::face_light(const glm::dmat3& linear, const Vec3& normal,
                                                   Vec3& up) const {
  constexpr double aligned = 1.0 - 1e-9;
  const LightFrame source_frame = frame(linear);
  const double scale = std::cbrt(std::abs(glm::determinant(linear)));
  RadianceFaceLight light;
  if (source == RadianceSource::flat && glm::dot(source_frame.aim, normal) > aligned) {
    up = source_frame.up;
    if (data->table().angles.front() >= 90.0) return light;
    light.distribution = std::make_shared<const IntensityDistribution>(data->front_half());
    light.exitance = factor * light.distribution->flux();
    return light;
  }
  // The part of the source's light that this face sends, by its share of the area that is shown.
  const LightFrame own = LightFrame::of(normal);
  up = own.up;
  IntensityTable table;
  for (int c = 0; c <= 72; ++c) table.planes.push_back(5.0 * c);
  for (int g = 0; g <= 45; ++g) table.angles.push_back(2.0 * g);
  bool any = false;
  for (const double plane : table.planes) {
    for (const double angle : table.angles) {
      const double c = plane * pi / 180.0, g = angle * pi / 180.0;
      const Vec3 w = own.to_world(
          {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), std::max(0.0, std::cos(g))});
      const Vec3 local = source_frame.to_local(w);
      double share = 1.0;  // per area of the face
      if (source != RadianceSource::flat) {
        const double shown = scale * scale * shown_area(*this, local);
        share = shown > 0.0 ? std::max(0.0, std::cos(g)) / shown : 0.0;
      }
      table.candela.push_back(data->intensity(local) * share);
      any |= table.candela.back() > 0.0;
    }
  }
  if (!any) return light;
  // The source's data are its whole intensity, which grows with its size.
  const double area_scale = source == RadianceSource::flat ? 1.0 : scale * scale;
  light.distribution = std::make_shared<const IntensityDistribution>(std::move(table));
  light.exitance = factor * area_scale * light.distribution->flux();
  return light;
}

RadianceDistribution radiance_spot(const Vec3& direction, double half_angle) {
  constexpr int steps = 60;
  IntensityTable table;
  table.planes = {0.0};
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::min(half_angle, 0.5 * pi) * i / steps;
    table.angles.push_back(angle * 180.0 / pi);
    table.candela.push_back(std::max(0.0, std::cos(angle)));
  }
  RadianceDistribution spot;
  spot.exitance = pi * std::pow(std::sin(std::min(half_angle, 0.5 * pi)), 2.0);
  spot.data = std::make_shared<const IntensityDistribution>(std::move(table));
  const LightFrame frame = LightFrame::of(direction);
  spot.turn = glm::dmat3(frame.right, frame.up, -frame.aim);
  return spot;
}

std::optional<RadianceDistribution> radiance_distribution(const RadiancePrimitive& pattern,
                                                          ModelFiles& files) {
  const std::vector<std::string>& words = pattern.words;
  const std::vector<double>& a = pattern.numbers;
  if (pattern.type != "brightdata" || words.size() < 4 || a.empty()) return {};
  RadianceDistribution result;
  double area = 1.0;  // of the source, where the data are the intensity of the whole of it
  if (words[0] == "boxcorr" && a.size() >= 4) {
    result.source = RadianceSource::box;
    result.size = {a[1], a[2], a[3]};
    area = 2.0 * (a[1] * a[2] + a[2] * a[3] + a[3] * a[1]);
  } else if (words[0] == "cylcorr" && a.size() >= 3) {
    result.source = RadianceSource::cylinder;
    result.size = {a[1], a[1], a[2]};
    area = pi * a[1] * (a[2] + 0.5 * a[1]);
  } else if (words[0] == "corr") {
    result.source = RadianceSource::sphere;
    area = 4.0;  // of a sphere, whose shadow's area is in the first number
  } else if (words[0] != "flatcorr") {
    return {};
  }
  const auto is_theta = [&](std::size_t i) { return words[i].find("theta") != std::string::npos; };
  if (!is_theta(3) && !(words.size() > 4 && is_theta(4))) return {};
  const std::string path = ModelFiles::path_from(pattern.place.file, words[1]);
  const std::string& bytes =
      files.read_text(path, {pattern.place.file, "line " + std::to_string(pattern.place.line)});
  const DataTable table = DataReader(path, bytes).read();
  for (const std::vector<double>& axis : table.axes) {
    if (!std::is_sorted(axis.begin(), axis.end()) || axis.front() < -360.0 || axis.back() > 360.0)
      pattern.place.fail(pattern.label() + " has data whose angles do not rise",
                         "make them anew with ies2rad");
  }
  const bool flat = result.source == RadianceSource::flat;
  result.factor = std::max(0.0, a[0]);
  result.exitance =
      area > 0.0 ? a[0] * flux_of(table, is_theta(3), flat ? 90.0 : 180.0) / area : 0.0;
  if (is_type_c(words, 3, table.axes.size())) {
    result.data = distribution_of(table, is_theta(3));
    result.turn = turn_of(pattern, 3 + table.axes.size());
  }
  return result;
}

}  // namespace enfilade
