// EULUMDAT (Stockmar 1990): one value a line; intensities in candela per 1000 lm of the lamps.
#include "photometry/files/eulumdat_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "photometry/files/ies_reader.hpp"
#include "photometry/files/table_axes.hpp"

namespace enfilade {
namespace {

class EulumdatReader {
 public:
  EulumdatReader(const std::vector<std::string>& lines, PhotometricReport& report)
      : lines_(lines), report_(report) {}

  PhotometricFile read() {
    if (lines_.size() < 42)
      report_.fail("file", "has too few lines: is no EULUMDAT file", "get the file again");
    file_.format = "EULUMDAT";
    file_.manufacturer = text(0);
    file_.luminaire = text(8);
    symmetry_ = whole(2, "the symmetry", 0, 4);
    planes_ = whole(3, "the number of C-planes", 1, 721);
    angles_ = whole(5, "the number of angles", 2, 1441);
    read_opening();
    const double light_output = number(22, "the light output ratio");
    factor_ = number(23, "the conversion factor");
    if (factor_ == 0.0) report_.warn("has a conversion factor of 0: taken as 1");
    if (factor_ < 0.0) report_.fail(24, "has a conversion factor below 0", "write 1");
    if (factor_ == 0.0) factor_ = 1.0;
    read_lamps();
    IntensityTable table = read_table();
    put_in_order(table, report_);
    scale(table, light_output);
    if (decimal_commas_) report_.warn("has decimal commas: read so");
    return std::move(file_);
  }

 private:
  std::string text(std::size_t line) const { return lines_[line].substr(0, 200); }

  std::optional<double> number_at(std::size_t line) {
    if (line >= lines_.size()) return std::nullopt;
    std::string word = lines_[line].substr(0, lines_[line].find(' '));
    if (const std::size_t comma = word.find(','); comma != std::string::npos) {
      word[comma] = '.';
      decimal_commas_ = true;
    }
    double value = 0.0;
    if (!number_of(word, value)) return std::nullopt;
    return value;
  }
  double number(std::size_t line, const std::string& what) {
    if (lines_.size() > line && lines_[line].empty()) return 0.0;
    const auto value = number_at(line);
    if (!value) {
      report_.fail(line + 1,
                   "has \"" + (line < lines_.size() ? lines_[line].substr(0, 24) : "") +
                       "\" where " + what + " is wanted",
                   "write a number");
    }
    return *value;
  }
  std::size_t whole(std::size_t line, const char* what, int least, int most) {
    const double value = number(line, what);
    if (value < least || value > most || value != std::floor(value)) {
      report_.fail(line + 1, fmt::format("has {:g} where {} is wanted", value, what),
                   fmt::format("write a whole number from {} to {}", least, most));
    }
    return static_cast<std::size_t>(value);
  }

  /// Sizes in millimetres: the length along C90, the width along C0; a width of 0 is a circle.
  void read_opening() {
    double length = number(15, "the opening's length"), width = number(16, "the opening's width");
    double height = 0.0;
    for (std::size_t line = 17; line < 21; ++line)
      height = std::max(height, number(line, "the height of the opening"));
    if (length < 0.0 || width < 0.0) {
      report_.warn("has an opening of a size below zero: its sign is passed over");
      length = std::abs(length);
      width = std::abs(width);
    }
    const double mm = 1e-3;
    if (length == 0.0 && width == 0.0) return;
    if (width == 0.0) {
      const auto shape = height > 0.0 ? OpeningShape::cylinder : OpeningShape::disc;
      file_.opening = {shape, mm * Vec3(length, length, height)};
    } else {
      const auto shape = height > 0.0 ? OpeningShape::box : OpeningShape::rectangle;
      file_.opening = {shape, mm * Vec3(width, length, height)};
    }
  }

  /// Six lines for each set of lamps; sets are alternatives, and the first is taken. Some programs
  /// write line by line for all sets.
  void read_lamps() {
    const std::size_t sets = whole(25, "the number of sets of lamps", 0, 20);
    const std::size_t first = 26;
    next_ = first + 6 * sets;
    if (sets == 0 || lines_.size() < next_)
      report_.fail(26, "has no lamps, without which its intensities mean nothing",
                   "write one set of lamps with its flux");
    double unused = 0.0;
    const bool interleaved = sets > 1 && number_of(lines_[first + 1], unused) &&
                             !number_of(lines_[first + sets], unused);
    const auto at = [&](std::size_t item) { return first + (interleaved ? item * sets : item); };
    const double count = number(at(0), "the number of lamps");
    file_.lamp = text(at(1));
    flux_ = number(at(2), "the flux of the lamps");
    file_.power_w = std::max(0.0, number(at(5), "the watts of the lamps"));
    if (!(flux_ > 0.0)) {
      report_.fail(at(2) + 1, "has lamps without flux, so that its intensities mean nothing",
                   "write the flux of all lamps of the set, lm");
    }
    if (count >= 0.0) file_.lamps_flux_lm = flux_;
    if (sets > 1) report_.warn("has several sets of lamps: the first is taken");
  }

  /// How many planes have intensities, by the symmetry.
  std::size_t measured_planes() const {
    switch (symmetry_) {
      case 1:
        return 1;
      case 2:
      case 3:
        return planes_ / 2 + 1;
      case 4:
        return planes_ / 4 + 1;
      default:
        return planes_;
    }
  }

  /// How the numbers behind the lamps are laid out: planes listed, planes with intensities.
  struct Layout {
    std::size_t listed = 0, measured = 0;
    Comma comma = Comma::separates;
    bool exact = true;
  };
  static constexpr std::size_t ratios = 10;
  std::size_t numbers_of(const Layout& l) const {
    return ratios + l.listed + angles_ + l.measured * angles_;
  }

  /// The usual layout where it fits exactly, else another one that does, else the usual one with
  /// more numbers behind it.
  std::optional<Layout> layout_of(std::size_t separate, std::size_t decimal) const {
    const Layout usual{planes_, measured_planes()};
    for (const std::size_t listed : {planes_, measured_planes()}) {
      for (const std::size_t measured : {measured_planes(), planes_}) {
        for (const Comma comma : {Comma::separates, Comma::decimal}) {
          const Layout layout{listed, measured, comma};
          if (numbers_of(layout) == (comma == Comma::separates ? separate : decimal)) return layout;
        }
      }
    }
    if (separate < numbers_of(usual)) return std::nullopt;
    return Layout{usual.listed, usual.measured, Comma::separates, false};
  }

  std::vector<double> rest(Layout& layout) {
    const NumberList separate = numbers_from(lines_, next_, Comma::separates);
    const NumberList decimal = numbers_from(lines_, next_, Comma::decimal);
    const auto found = layout_of(separate.numbers.size(), decimal.numbers.size());
    if (!found) fail_of_numbers(separate);
    layout = *found;
    if (!layout.exact) report_.warn("has numbers behind its intensities: passed over");
    if (layout.listed != planes_ || layout.measured != measured_planes())
      report_.warn("lists its planes otherwise than its symmetry asks: read so");
    const NumberList& list = layout.comma == Comma::decimal ? decimal : separate;
    if (list.odd_line > 0) report_.warn("has text behind its numbers: passed over");
    decimal_commas_ |=
        layout.comma == Comma::decimal && decimal.numbers.size() != separate.numbers.size();
    std::vector<double> values;
    for (std::size_t i = ratios; i < numbers_of(layout); ++i)
      values.push_back(list.numbers[i].value);
    return values;
  }

  [[noreturn]] void fail_of_numbers(const NumberList& list) const {
    if (list.odd_line > 0) {
      report_.fail(list.odd_line, "has \"" + list.odd_word + "\" among the numbers",
                   "write a number, or remove it");
    }
    report_.fail("end",
                 fmt::format("holds {} numbers behind the lamps, and needs {}", list.numbers.size(),
                             numbers_of({planes_, measured_planes()})),
                 "get the file again, or correct its numbers of planes and angles");
  }

  IntensityTable read_table() {
    Layout layout;
    const std::vector<double> values = rest(layout);
    const std::size_t listed = layout.listed, measured = layout.measured;
    IntensityTable table;
    const auto plane = [&](std::size_t i) { return values[i % listed]; };
    const std::size_t first = symmetry_ == 3 && measured < planes_ ? 3 * planes_ / 4 : 0;
    for (std::size_t i = 0; i < measured; ++i) {
      // C90-C270 symmetry lists the planes from 270 over 0 to 90; their mirror images, 180 less
      // the angle, run from 270 down to 90.
      double angle = plane(listed == measured && measured < planes_ ? i : i + first);
      if (first > 0) angle = 180.0 - (angle > 180.0 ? angle - 360.0 : angle);
      table.planes.push_back(symmetry_ == 1 && measured == 1 ? 0.0 : angle);
    }
    table.angles.assign(values.begin() + static_cast<std::ptrdiff_t>(listed),
                        values.begin() + static_cast<std::ptrdiff_t>(listed + angles_));
    table.candela.assign(values.begin() + static_cast<std::ptrdiff_t>(listed + angles_),
                         values.end());
    if (first > 0) {  // put in the ascending order without a warning: it is the format's own
      IntensityTable turned = table;
      for (std::size_t p = 0; p < measured; ++p) {
        turned.planes[p] = table.planes[measured - 1 - p];
        for (std::size_t a = 0; a < angles_; ++a)
          turned.candela[p * angles_ + a] = table.at(measured - 1 - p, a);
      }
      table = std::move(turned);
    }
    return table;
  }

  /// From candela per 1000 lm to candela; compares the flux with the file's own.
  void scale(IntensityTable& table, double light_output) {
    for (double& cd : table.candela) cd *= factor_;
    const double per_klm = distribution_of(table, report_)->flux();
    double share = 100.0 * per_klm / 1000.0;
    double factor = flux_ / 1000.0;
    constexpr double alike = 0.03, few_percent = 0.03;
    const double absolute = 100.0 * per_klm / flux_;
    const bool off =
        light_output > 0.0 && std::abs(share - light_output) > few_percent * light_output;
    if (off && std::abs(absolute - light_output) <= alike * light_output) {
      report_.warn(
          fmt::format("has intensities in candela, not per 1000 lm (their flux is the "
                      "stated {:g} % of the lamps'): read so",
                      light_output));
      factor = 1.0;
    } else if (off) {
      report_.warn(
          fmt::format("states a light output ratio of {:g} %, and its intensities give "
                      "{:.1f} %: the intensities are taken",
                      light_output, share));
    } else if (light_output <= 0.0 && share > 105.0) {
      report_.warn(fmt::format("gives {:.1f} % of its lamps' flux: check its lamps", share));
    }
    for (double& cd : table.candela) cd *= factor;
    file_.distribution = distribution_of(std::move(table), report_);
  }

  const std::vector<std::string>& lines_;
  PhotometricReport& report_;
  PhotometricFile file_;
  std::size_t symmetry_ = 0, planes_ = 1, angles_ = 2, next_ = 0;
  double factor_ = 1.0, flux_ = 0.0;
  bool decimal_commas_ = false;
};

}  // namespace

PhotometricFile read_eulumdat(const std::vector<std::string>& lines, PhotometricReport& report) {
  return EulumdatReader(lines, report).read();
}

}  // namespace enfilade
