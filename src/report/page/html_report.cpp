#include "report/page/html_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "report/drawing/base64.hpp"
#include "report/drawing/charts.hpp"
#include "report/page/html_style.hpp"

namespace enfilade {

namespace {

/// 12942 -> "12 942" with thin spaces.
std::string grouped(std::int64_t n) {
  std::string digits = std::to_string(n < 0 ? -n : n), text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += "&#8239;";
    text += digits[i];
  }
  return (n < 0 ? "-" : "") + text;
}

std::string shown_number(double d) {
  if (!std::isfinite(d)) return "&ndash;";
  if (d == std::floor(d) && std::abs(d) < 1e15) return grouped(static_cast<std::int64_t>(d));
  return fmt::format("{:.4g}", d);
}

std::string shown(const RunRecord::Value* value) {
  if (value == nullptr) return "&ndash;";
  if (const auto* d = std::get_if<double>(value)) return shown_number(*d);
  if (const auto* n = std::get_if<std::int64_t>(value)) return grouped(*n);
  if (const auto* b = std::get_if<bool>(value)) return *b ? "yes" : "no";
  if (const auto* s = std::get_if<std::string>(value)) return escaped(*s);
  std::string list;
  for (double d : std::get<std::vector<double>>(*value))
    list += (list.empty() ? "" : ", ") + shown_number(d);
  return list;
}

/// "peak_rss_bytes" -> "peak rss bytes".
std::string words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return escaped(key);
}

std::string figure(const Figure& f, const char* kind) {
  return fmt::format(
      R"(<figure class="{}"><img alt="{}" src="data:image/png;base64,{}"><figcaption>{}</figcaption></figure>)",
      kind, escaped(f.caption), base64(f.png), escaped(f.caption));
}

std::string tiles(const RunRecord& stats) {
  struct Tile {
    const char *key, *label;
    double scale;
    const char* format;
  };
  constexpr Tile known[] = {{"simulated_s", "simulated seconds", 1.0, "{:.4g}"},
                            {"wall_s", "wall seconds", 1.0, "{:.4g}"},
                            {"ranks", "ranks", 1.0, "{:.0f}"},
                            {"estimated_error", "estimated error", 100.0, "{:.2g}&#8239;%"},
                            {"iterations", "iterations", 1.0, "{:.0f}"},
                            {"surfaces", "surfaces", 1.0, ""},
                            {"clusters", "clusters", 1.0, ""},
                            {"patches", "patches", 1.0, ""},
                            {"links", "links", 1.0, ""},
                            {"rays", "rays", 1.0, ""},
                            {"peak_rss_bytes", "MB at most a rank", 1e-6, "{:.0f}"}};
  std::string html = R"(<div class="tiles">)";
  for (const Tile& tile : known) {
    const double value = tile.scale * stats.number(tile.key, std::nan(""));
    if (!std::isfinite(value)) continue;
    const std::string text =
        *tile.format != 0 ? fmt::format(fmt::runtime(tile.format), value) : shown_number(value);
    html += fmt::format(R"(<div class="tile"><b>{}</b><span>{}</span></div>)", text, tile.label);
  }
  return html + "</div>";
}

/// The named column of the history over its iteration number.
Series column(const RunPage& run, const std::string& key, const std::string& name,
              const std::string& colour) {
  Series series{name, colour, {}};
  for (std::size_t i = 0; i < run.history.size(); ++i) {
    const double iteration = run.history[i].number("iteration", static_cast<double>(i + 1));
    series.points.emplace_back(iteration, run.history[i].number(key, std::nan("")));
  }
  return series;
}

std::string convergence(const RunPage& run) {
  const std::pair<const char*, const char*> errors[] = {
      {"estimated_error", "estimated error, relative"},
      {"residual", "residual, relative"},
      {"relative_change", "change, relative"},
      {"max_change", "largest change of radiosity"}};
  std::vector<Series> series;
  for (const auto& [key, name] : errors) {
    // In the scene's unit, so alone on its axis.
    if (std::string_view(key) == "max_change" && !series.empty()) continue;
    Series s = column(run, key, name, rank_colour(static_cast<int>(series.size())));
    const bool any =
        std::any_of(s.points.begin(), s.points.end(), [](const auto& p) { return p.second > 0.0; });
    if (any) series.push_back(std::move(s));
  }
  const std::string errors_chart = line_chart(series, "iteration", "error and change");
  const std::string size_chart = line_chart({column(run, "links", "links", rank_colour(1)),
                                             column(run, "patches", "patches", rank_colour(2))},
                                            "iteration", "number");
  if (errors_chart.empty() && size_chart.empty()) return "";
  std::string html = "<h3>Convergence</h3><div class=\"grid2\">";
  for (const std::string& chart : {errors_chart, size_chart}) {
    if (!chart.empty()) html += "<div class=\"card\">" + chart + "</div>";
  }
  return html + "</div>";
}

std::string time_by_rank(const RunRecord& stats) {
  const std::tuple<const char*, const char*, const char*> kinds[] = {
      {"compute_s", "computing", "var(--compute)"},
      {"io_s", "reading and writing", "var(--io)"},
      {"idle_s", "waiting", "var(--idle)"}};
  std::vector<Layer> layers;
  std::size_t ranks = 0;
  for (const auto& [key, name, colour] : kinds) {
    const RunRecord::Value* value = stats.find(key);
    const auto* list = value != nullptr ? std::get_if<std::vector<double>>(value) : nullptr;
    if (list == nullptr) continue;
    layers.push_back({name, colour, *list});
    ranks = std::max(ranks, list->size());
  }
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < ranks; ++i) labels.push_back("rank " + std::to_string(i));
  const std::string chart = stacked_bars(labels, layers, "s");
  if (chart.empty()) return "";
  return "<h3>Where the time went</h3><div class=\"card\">" + chart + "</div>";
}

std::string timeline(const RunPage& run) {
  if (run.timeline.empty()) return "";
  return "<h3>What the ranks did, when</h3><figure class=\"card\">" + run.timeline + "</figure>";
}

std::string plans(const RunPage& run) {
  std::string html;
  for (const FloorPlan& plan : run.plans) {
    html += "<figure class=\"card\">" + to_inline_svg(plan.drawing) + "</figure>";
  }
  return html.empty() ? "" : "<h3>Plans</h3><div class=\"stack\">" + html + "</div>";
}

std::string stats_table(const RunRecord& stats) {
  std::string html = "<h3>All figures of the run</h3><div class=\"columns\"><table>";
  for (const auto& [key, value] : stats.entries()) {
    const bool list = std::holds_alternative<std::vector<double>>(value);
    html += fmt::format("<tr><th>{}</th><td{}>{}</td></tr>", words(key), list ? "" : " class=\"n\"",
                        shown(&value));
  }
  return html + "</table></div>";
}

std::string warnings(const RunPage& run) {
  if (run.warnings.empty()) return "";
  std::string html = fmt::format("<details class=\"warnings\"><summary>{} warning{}</summary>",
                                 run.warnings.size(), run.warnings.size() == 1 ? "" : "s");
  for (const std::string& line : run.warnings)
    html += "<p class=\"warn\">" + escaped(line) + "</p>";
  return html + "</details>";
}

/// `number` tells the runs of the page apart.
std::string run_section(const RunPage& run, bool titled, std::size_t number) {
  std::string html = titled ? "<h2>" + escaped(run.name) + "</h2>" : "";
  if (!run.walk.empty())
    html += "<p><a href=\"" + escaped(run.walk) + "\">Walk through the building</a></p>";
  html += rooms_html(run.rooms, fmt::format("run-{}-room", number));
  html += tiles(run.stats);
  for (std::size_t i = 0; i < run.pictures.size(); ++i) {
    if (i == 1) html += "<div class=\"grid2\">";
    html += figure(run.pictures[i], i == 0 ? "hero" : "");
  }
  if (run.pictures.size() > 1) html += "</div>";
  html += plans(run) + convergence(run) + time_by_rank(run.stats) + timeline(run) +
          stats_table(run.stats) + warnings(run);
  if (!run.attribution.empty()) html += "<h3>The scene</h3>";
  for (const std::string& line : run.attribution)
    html += "<p class=\"soft\">" + escaped(line) + "</p>";
  return html;
}

/// One row a figure that any run has, one column a run.
std::string comparison(std::span<const RunPage> runs) {
  std::string html = "<h2>The runs side by side</h2><div class=\"scroll\"><table><tr><th></th>";
  for (const RunPage& run : runs) html += "<th class=\"n\">" + escaped(run.name) + "</th>";
  html += "</tr>";
  std::set<std::string> done;
  for (const RunPage& source : runs) {
    for (const auto& [key, value] : source.stats.entries()) {
      if (std::holds_alternative<std::vector<double>>(value) || !done.insert(key).second) continue;
      html += "<tr><th>" + words(key) + "</th>";
      for (const RunPage& run : runs)
        html += "<td class=\"n\">" + shown(run.stats.find(key)) + "</td>";
      html += "</tr>";
    }
  }
  html += "</table></div>";
  std::vector<Series> series;
  for (const RunPage& run : runs) {
    series.push_back(
        column(run, "estimated_error", run.name, rank_colour(static_cast<int>(series.size()))));
  }
  const std::string chart = line_chart(series, "iteration", "estimated error");
  return chart.empty()
             ? html
             : html + "<h3>Convergence of all</h3><div class=\"card\">" + chart + "</div>";
}

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>" +
         escaped(title) + " - Enfilade</title><style>" + report_style +
         "</style></head><body><main><h1>" + escaped(title) +
         "</h1><p class=\"soft\">Light in a building, by parallel hierarchical "
         "radiosity. Made by Enfilade.</p>" +
         body + "</main></body></html>\n";
}

std::string report_html(std::span<const RunPage> runs) {
  const std::string title = runs.size() == 1 ? runs[0].name : std::to_string(runs.size()) + " runs";
  std::string body = runs.size() > 1 ? comparison(runs) : "";
  for (std::size_t i = 0; i < runs.size(); ++i)
    body += run_section(runs[i], runs.size() > 1, i + 1);
  return html_page(title, body);
}

}  // namespace enfilade
