#include "report/page/rank_timeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

struct Look {
  const char* name;
  const char* tip;
  Rgb8 colour;
};
/// In the order of Phase; P. Tol's bright scheme, which colour-blind readers can distinguish.
constexpr std::array<Look, phase_count> looks = {{
    {"compute", "gathering light", {68, 119, 170}},
    {"I/O", "reading and writing clusters", {238, 102, 119}},
    {"commit", "moving files to the common directory", {204, 187, 68}},
    {"steal", "asking others for work", {34, 136, 51}},
    {"wait", "waiting", {187, 187, 187}},
    {"token", "waiting for the token and its decision", {170, 51, 119}},
}};

constexpr double left_px = 150.0, top_px = 50.0, plot_px = 900.0;
constexpr std::size_t most_rows = 64, most_cells = 24000;

using Bin = PhaseProfile::Bin;

double seconds(const Bin& bin) {
  double sum = 0.0;
  for (const double s : bin) sum += s;
  return sum;
}

/// Bins of all ranks from the first one in which any did anything.
struct Columns {
  double bin_s = 0.0;
  std::size_t count = 0;
  std::vector<std::vector<Bin>> rows;
};

Columns columns_of(const std::vector<RankProfile>& ranks, std::size_t most) {
  std::size_t first = ~std::size_t{0}, end = 0;
  for (const RankProfile& rank : ranks) {
    const auto& bins = rank.profile.bins();
    for (std::size_t i = 0; i < bins.size(); ++i) {
      if (seconds(bins[i]) <= 0.0) continue;
      first = std::min(first, i);
      end = std::max(end, i + 1);
    }
  }
  Columns columns;
  if (first >= end) return columns;
  const std::size_t group = std::max<std::size_t>(1, (end - first + most - 1) / most);
  columns.bin_s = ranks.front().profile.bin_s() * static_cast<double>(group);
  columns.count = (end - first + group - 1) / group;
  for (const RankProfile& rank : ranks) {
    auto& row = columns.rows.emplace_back(columns.count, Bin{});
    const auto& bins = rank.profile.bins();
    for (std::size_t i = first; i < std::min(end, bins.size()); ++i) {
      for (std::size_t p = 0; p < phase_count; ++p) row[(i - first) / group][p] += bins[i][p];
    }
  }
  return columns;
}

Path rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// "2 h", "40 min", "0.5 s": in the unit that fits the run's length.
std::string time_label(double time_s, double length_s) {
  if (length_s >= 4 * 3600.0) return fmt::format("{:g} h", time_s / 3600.0);
  if (length_s >= 4 * 60.0) return fmt::format("{:g} min", time_s / 60.0);
  return fmt::format("{:g} s", time_s);
}

double tick_step(double length_s) {
  const double unit = length_s >= 4 * 3600.0 ? 3600.0 : length_s >= 4 * 60.0 ? 60.0 : 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(length_s / unit / 8.0)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (length_s / unit / (step * decade) <= 10.0) return step * decade * unit;
  }
  return 10.0 * decade * unit;
}

void add_axis(Drawing& drawing, double length_s, double bottom_px) {
  Shape ticks{"tick", {}, {}, Rgb8{120, 120, 120}, 1.0, false, ""};
  for (double t = 0.0; t <= length_s * (1.0 + 1e-9); t += tick_step(length_s)) {
    const double x = left_px + plot_px * t / length_s;
    ticks.paths.push_back({{x, bottom_px}, {x, bottom_px + 5.0}});
    drawing.words.push_back(
        {{x, bottom_px + 20.0}, time_label(t, length_s), 12.0, {0, 0, 0}, true});
  }
  drawing.sheet.push_back(std::move(ticks));
}

void add_legend(Drawing& drawing) {
  double x = left_px;
  for (const Look& look : looks) {
    drawing.sheet.push_back(
        {"legend", {rectangle(x, 18.0, x + 14.0, 32.0)}, look.colour, {}, 1.0, true, look.tip});
    drawing.words.push_back({{x + 20.0, 30.0}, look.name, 13.0, {0, 0, 0}, false});
    x += 110.0;
  }
}

}  // namespace

Drawing rank_timeline(const std::vector<RankProfile>& ranks) {
  const std::size_t group = (ranks.size() + most_rows - 1) / most_rows;
  const std::size_t rows = group == 0 ? 0 : (ranks.size() + group - 1) / group;
  Drawing drawing;
  drawing.title = "What the ranks did over time";
  if (rows == 0) return drawing;
  const std::size_t most_columns = std::clamp<std::size_t>(most_cells / rows, 200, 600);
  const Columns columns = columns_of(ranks, most_columns);
  const double pitch_px = std::clamp(400.0 / static_cast<double>(rows), 8.0, 40.0);
  const double bottom_px = top_px + pitch_px * static_cast<double>(rows);
  drawing.width_px = static_cast<int>(left_px + plot_px + 30.0);
  drawing.height_px = static_cast<int>(bottom_px + 40.0);
  if (columns.count == 0) return drawing;

  std::array<Shape, phase_count> areas;
  const double step_px = plot_px / static_cast<double>(columns.count);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t end = std::min(ranks.size(), (r + 1) * group);
    const double floor_px = top_px + pitch_px * static_cast<double>(r + 1) - 1.0;
    for (std::size_t c = 0; c < columns.count; ++c) {
      const double x = left_px + step_px * static_cast<double>(c);
      double y = floor_px;
      for (std::size_t p = 0; p < phase_count; ++p) {
        double sum = 0.0;
        for (std::size_t k = r * group; k < end; ++k) sum += columns.rows[k][c][p];
        const double share = sum / columns.bin_s / static_cast<double>(end - r * group);
        if (share < 1e-3) continue;
        const double next = y - share * (pitch_px - 2.0);
        areas[p].paths.push_back(rectangle(x, next, x + step_px, y));
        y = next;
      }
    }
    const std::string name = group == 1 ? fmt::format("{} {}", r, ranks[r].host)
                                        : fmt::format("{}-{}", r * group, end - 1);
    if (rows <= 32 || r % 4 == 0) {
      drawing.words.push_back(
          {{8.0, floor_px - pitch_px / 2.0 + 5.0}, name, 12.0, {0, 0, 0}, false});
    }
  }
  for (std::size_t p = 0; p < phase_count; ++p) {
    areas[p].kind = "phase";
    areas[p].fill = looks[p].colour;
    areas[p].tip = looks[p].tip;
    if (!areas[p].paths.empty()) drawing.sheet.push_back(std::move(areas[p]));
  }
  add_axis(drawing, columns.bin_s * static_cast<double>(columns.count), bottom_px);
  add_legend(drawing);
  return drawing;
}

std::string paje_trace(const std::vector<RankProfile>& ranks) {
  std::string text =
      "%EventDef PajeDefineContainerType 0\n% Alias string\n% Type string\n% Name string\n"
      "%EndEventDef\n"
      "%EventDef PajeDefineStateType 1\n% Alias string\n% Type string\n% Name string\n"
      "%EndEventDef\n"
      "%EventDef PajeDefineEntityValue 2\n% Alias string\n% Type string\n% Name string\n"
      "% Color color\n%EndEventDef\n"
      "%EventDef PajeCreateContainer 3\n% Time date\n% Alias string\n% Type string\n"
      "% Container string\n% Name string\n%EndEventDef\n"
      "%EventDef PajeDestroyContainer 4\n% Time date\n% Type string\n% Name string\n"
      "%EndEventDef\n"
      "%EventDef PajeSetState 5\n% Time date\n% Type string\n% Container string\n"
      "% Value string\n%EndEventDef\n"
      "0 RANK 0 \"rank\"\n1 PHASE RANK \"phase\"\n";
  for (std::size_t p = 0; p < phase_count; ++p) {
    const Rgb8 c = looks[p].colour;
    text += fmt::format("2 phase{} PHASE \"{}\" \"{:.3f} {:.3f} {:.3f}\"\n", p, looks[p].name,
                        c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
  }
  const Columns columns = columns_of(ranks, PhaseProfile::most_bins);
  for (std::size_t r = 0; r < columns.rows.size(); ++r) {
    text += fmt::format("3 0 rank{0} RANK 0 \"rank {0} on {1}\"\n", r, ranks[r].host);
  }
  for (std::size_t c = 0; c < columns.count; ++c) {
    for (std::size_t r = 0; r < columns.rows.size(); ++r) {
      const auto dominant = [&](std::size_t column) {
        const Bin& bin = columns.rows[r][column];
        return std::max_element(bin.begin(), bin.end()) - bin.begin();
      };
      if (c > 0 && dominant(c) == dominant(c - 1)) continue;
      text += fmt::format("5 {:.9g} PHASE rank{} phase{}\n", columns.bin_s * static_cast<double>(c),
                          r, dominant(c));
    }
  }
  for (std::size_t r = 0; r < columns.rows.size(); ++r) {
    text += fmt::format("4 {:.9g} RANK rank{}\n",
                        columns.bin_s * static_cast<double>(columns.count), r);
  }
  return text;
}

}  // namespace enfilade
