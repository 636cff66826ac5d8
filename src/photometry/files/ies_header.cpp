#include "photometry/files/ies_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace enfilade {
namespace {

constexpr std::size_t header_numbers = 13;
constexpr double most_angles = 20'000.0;

std::string upper(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

int year_of(const std::string& first_line) {
  const std::string line = upper(first_line);
  if (line.rfind("IES", 0) != 0) return 1986;
  for (const int year : {1986, 1991, 1995, 2002, 2019})
    if (line.find(std::to_string(year)) != std::string::npos) return year;
  return line.find("91") != std::string::npos ? 1991 : 2002;
}

void read_keyword(const std::string& line, IesText& text) {
  const std::size_t end = line.find(']');
  if (line.empty() || line[0] != '[' || end == std::string::npos) return;
  const std::string key = upper(line.substr(1, end - 1));
  const std::size_t begin = line.find_first_not_of(' ', end + 1);
  std::string* to = key == "MANUFAC"                        ? &text.manufacturer
                    : key == "LUMINAIRE" || key == "LUMCAT" ? &text.luminaire
                    : key == "LAMP" || key == "LAMPCAT"     ? &text.lamp
                                                            : nullptr;
  if (to == nullptr || begin == std::string::npos) return;
  if (to->empty() || key == "LUMINAIRE" || key == "LAMP") *to = line.substr(begin, 200);
}

/// The line after which the numbers begin; without a TILT line the first from which ten numbers
/// follow.
std::optional<std::size_t> find_tilt(const std::vector<std::string>& lines, std::string& value) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line = upper(lines[i]);
    if (line.rfind("TILT", 0) != 0) continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    const std::size_t begin = lines[i].find_first_not_of(' ', equals + 1);
    value = begin == std::string::npos ? "" : lines[i].substr(begin);
    return i;
  }
  return std::nullopt;
}

struct NumberReader {
  const NumberList& list;
  PhotometricReport& report;
  std::size_t next = 0;

  double take(const char* what) {
    if (next < list.numbers.size()) return list.numbers[next++].value;
    if (list.odd_line > 0) {
      report.fail(list.odd_line, "has \"" + list.odd_word + "\" where " + what + " is wanted",
                  "write a number");
    }
    report.fail("end", std::string("the file ends before ") + what, "get the file again");
  }
};

/// Lamp geometry, number of pairs, angles, factors.
LampTilt read_tilt(NumberReader& reader) {
  LampTilt tilt;
  reader.take("the lamp's position in the luminaire");
  const double pairs = reader.take("the number of tilt angles");
  if (!(pairs >= 1.0 && pairs <= 1000.0) || pairs != std::floor(pairs))
    reader.report.fail("TILT", "has no sensible number of angles", "write 1 to 1000");
  for (int i = 0; i < static_cast<int>(pairs); ++i)
    tilt.degrees.push_back(reader.take("a tilt angle"));
  for (int i = 0; i < static_cast<int>(pairs); ++i)
    tilt.factors.push_back(reader.take("a tilt factor"));
  for (std::size_t i = 0; i < tilt.factors.size(); ++i) {
    if (!(tilt.factors[i] >= 0.0) || tilt.factors[i] > 10.0 ||
        (i > 0 && tilt.degrees[i] <= tilt.degrees[i - 1])) {
      reader.report.fail("TILT", "has factors or angles that are out of order",
                         "write angles that grow and factors from 0");
    }
  }
  return tilt;
}

LampTilt tilt_of_file(const std::string& name, const SideFile& beside, PhotometricReport& report) {
  const auto bytes = beside ? beside(name) : std::nullopt;
  if (!bytes) {
    report.warn("names the tilt file \"" + name.substr(0, 60) +
                "\", which is not beside it: taken as TILT=NONE");
    return {};
  }
  const auto lines = lines_of(photometric_text(*bytes, report));
  const NumberList list = numbers_from(lines, 0, Comma::separates);
  NumberReader reader{list, report};
  return read_tilt(reader);
}

/// How many vertical and horizontal angles there are.
struct Counts {
  std::size_t vertical = 0, horizontal = 0;
  std::size_t numbers() const { return vertical + horizontal + vertical * horizontal; }
};

bool ascend(std::span<const PlacedNumber> numbers) {
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i].value < numbers[i - 1].value) return false;
  return true;
}

/// The counts by the order of the numbers: vertical angles ascend, horizontal ones begin anew.
std::optional<Counts> counts_by_order(std::span<const PlacedNumber> rest) {
  std::size_t vertical = 1;
  while (vertical < rest.size() && rest[vertical].value > rest[vertical - 1].value) ++vertical;
  if (vertical < 2) return std::nullopt;
  for (std::size_t horizontal = 1; vertical + horizontal < rest.size(); ++horizontal) {
    if (horizontal > 1 &&
        rest[vertical + horizontal - 1].value <= rest[vertical + horizontal - 2].value)
      break;
    const Counts counts{vertical, horizontal};
    if (counts.numbers() == rest.size()) return counts;
  }
  return std::nullopt;
}

/// Which of the numbers behind the header are which; none where they are too few.
std::optional<Counts> counts_of(std::span<const PlacedNumber> rest, const Counts& stated,
                                PhotometricReport& report) {
  const bool fits =
      stated.vertical >= 2 && stated.horizontal >= 1 && stated.numbers() <= rest.size();
  const bool ordered = fits && ascend(rest.first(stated.vertical)) &&
                       ascend(rest.subspan(stated.vertical, stated.horizontal));
  if (fits && stated.numbers() == rest.size()) return stated;
  if (const auto counts = counts_by_order(rest)) {
    report.warn(
        fmt::format("states {} vertical and {} horizontal angles, and holds {} and {}: "
                    "read so",
                    stated.vertical, stated.horizontal, counts->vertical, counts->horizontal));
    return counts;
  }
  if (!ordered) return std::nullopt;
  report.warn(fmt::format("holds {} numbers more than its angles ask for: passed over",
                          rest.size() - stated.numbers()));
  return stated;
}

Counts stated_counts(NumberReader& reader) {
  const double vertical = reader.take("the number of vertical angles");
  const double horizontal = reader.take("the number of horizontal angles");
  const auto count = [](double x) {
    return x >= 0.0 && x <= most_angles ? static_cast<std::size_t>(x + 0.5) : std::size_t{0};
  };
  return {count(vertical), count(horizontal)};
}

IesNumbers read_header(NumberReader& reader, Counts& stated) {
  IesNumbers n;
  n.lamps = reader.take("the number of lamps");
  n.lumens = reader.take("the lumens of a lamp");
  n.multiplier = reader.take("the candela multiplier");
  stated = stated_counts(reader);
  const auto whole = [](double x) {
    return std::abs(x) < 100.0 ? static_cast<int>(std::lround(x)) : 0;
  };
  n.type = whole(reader.take("the type of photometry"));
  n.units = whole(reader.take("the type of units"));
  n.width = reader.take("the opening's width");
  n.length = reader.take("the opening's length");
  n.height = reader.take("the opening's height");
  n.ballast_factor = reader.take("the ballast factor");
  n.third_factor = reader.take("the number behind the ballast factor");
  n.watts = reader.take("the input watts");
  return n;
}

/// None where the numbers do not fit; `said` are the warnings that go with the reading.
std::optional<IesNumbers> take_apart(const NumberList& list, std::size_t first,
                                     PhotometricReport& report) {
  NumberReader reader{list, report, first};
  Counts stated;
  if (list.numbers.size() < first + header_numbers + 3) return std::nullopt;
  IesNumbers n = read_header(reader, stated);
  const auto rest = std::span(list.numbers).subspan(first + header_numbers);
  const auto counts = counts_of(rest, stated, report);
  if (!counts) return std::nullopt;
  n.line = rest[0].line;
  const auto values = [&](std::size_t from, std::size_t count) {
    std::vector<double> taken;
    for (std::size_t i = from; i < from + count; ++i) taken.push_back(rest[i].value);
    return taken;
  };
  n.vertical = values(0, counts->vertical);
  n.horizontal = values(counts->vertical, counts->horizontal);
  n.candela = values(counts->vertical + counts->horizontal, counts->vertical * counts->horizontal);
  return n;
}

[[noreturn]] void fail_of_numbers(const NumberList& list, std::size_t first,
                                  PhotometricReport& report) {
  NumberReader reader{list, report, first};
  Counts stated;
  read_header(reader, stated);
  if (list.odd_line > 0) {
    report.fail(list.odd_line, "has \"" + list.odd_word + "\" among the numbers",
                "write a number, or remove it");
  }
  const std::size_t held = list.numbers.size() - first - header_numbers;
  report.fail(
      "end",
      fmt::format("holds {} numbers for {} vertical and {} horizontal angles, which need {}", held,
                  stated.vertical, stated.horizontal, stated.numbers()),
      "get the file again, or correct its numbers of angles");
}

}  // namespace

IesText read_ies_text(const std::vector<std::string>& lines, const SideFile& beside,
                      PhotometricReport& report) {
  IesText text;
  if (lines.empty()) report.fail("file", "is empty", "get the file again");
  text.year = year_of(lines[0]);
  std::string tilt;
  const auto tilt_line = find_tilt(lines, tilt);
  std::size_t first = tilt_line ? *tilt_line + 1 : 0;
  for (; !tilt_line && first < lines.size(); ++first) {
    const NumberList here = numbers_from(lines, first, Comma::separates);
    if (here.numbers.size() >= header_numbers + 3) break;
  }
  if (first >= lines.size())
    report.fail("file", "has no numbers behind a TILT line: is no LM-63 file",
                "get the file again");
  if (!tilt_line) report.warn("has no TILT line: taken as TILT=NONE");
  for (std::size_t i = 0; i < first; ++i) read_keyword(lines[i], text);
  const std::string kind = upper(tilt);
  const bool included = kind == "INCLUDE";
  if (tilt_line && !included && kind != "NONE" && !tilt.empty())
    text.tilt = tilt_of_file(tilt, beside, report);
  std::optional<IesNumbers> numbers;
  for (const Comma comma : {Comma::separates, Comma::decimal}) {
    const NumberList list = numbers_from(lines, first, comma);
    NumberReader reader{list, report};
    if (included && list.numbers.size() > 2) text.tilt = read_tilt(reader);
    numbers = take_apart(list, reader.next, report);
    if (!numbers) continue;
    if (comma == Comma::decimal) report.warn("has decimal commas: read so");
    if (list.odd_line > 0) {
      report.warn("has text behind its numbers (\"" + list.odd_word + "\", line " +
                  std::to_string(list.odd_line) + "): passed over");
    }
    text.numbers = std::move(*numbers);
    return text;
  }
  const NumberList list = numbers_from(lines, first, Comma::separates);
  NumberReader reader{list, report};
  if (included) read_tilt(reader);
  fail_of_numbers(list, reader.next, report);
}

}  // namespace enfilade
