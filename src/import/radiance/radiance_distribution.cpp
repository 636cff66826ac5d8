#include "import/radiance/radiance_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

constexpr double pi = std::numbers::pi;

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

}  // namespace

std::optional<double> radiance_distribution(const RadiancePrimitive& pattern, ModelFiles& files) {
  const std::vector<std::string>& words = pattern.words;
  const std::vector<double>& a = pattern.numbers;
  if (pattern.type != "brightdata" || words.size() < 4 || a.empty()) return {};
  const bool flat = words[0] == "flatcorr";
  double area = 1.0;  // of the source, where the data are the intensity of the whole of it
  if (words[0] == "boxcorr" && a.size() >= 4)
    area = 2.0 * (a[1] * a[2] + a[2] * a[3] + a[3] * a[1]);
  else if (words[0] == "cylcorr" && a.size() >= 3)
    area = pi * a[1] * (a[2] + 0.5 * a[1]);
  else if (words[0] == "corr")
    area = 4.0;  // of a sphere, whose shadow's area is in the first number
  else if (!flat)
    return {};
  const auto is_theta = [&](std::size_t i) { return words[i].find("theta") != std::string::npos; };
  if (!is_theta(3) && !(words.size() > 4 && is_theta(4))) return {};
  const std::string path = ModelFiles::path_from(pattern.place.file, words[1]);
  const std::string& bytes =
      files.read(path, {pattern.place.file, "line " + std::to_string(pattern.place.line)});
  const DataTable table = DataReader(path, bytes).read();
  for (const std::vector<double>& axis : table.axes) {
    if (!std::is_sorted(axis.begin(), axis.end()) || axis.front() < -360.0 || axis.back() > 360.0)
      pattern.place.fail(pattern.label() + " has data whose angles do not rise",
                         "make them anew with ies2rad");
  }
  return area > 0.0 ? a[0] * flux_of(table, is_theta(3), flat ? 90.0 : 180.0) / area : 0.0;
}

}  // namespace enfilade
