#include "app/solve/solve_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/frame/shown_value.hpp"
#include "app/frame/text_table.hpp"

namespace enfilade {

namespace {

bool gave_up(const RunRecord& record) {
  const auto* converged = record.find("converged");
  return converged != nullptr && *converged == RunRecord::Value(false);
}

struct Row {
  const char* key;
  const char* label;
};

constexpr Row summary_rows[] = {
    {"surfaces", "surfaces"},
    {"clusters", "clusters"},
    {"patches", "patches"},
    {"links", "links"},
    {"rays", "visibility rays"},
    {"ranks", "ranks"},
    {"steals", "clusters stolen"},
    {"messages", "messages"},
    {"iterations", "iterations"},
    {"estimated_error", "estimated error"},
    {"estimated_patch_error", "of what is read off patches"},
    {"estimated_discretisation_error", "of that by patches and links"},
    {"estimated_visibility_error", "by visibility"},
    {"estimated_iteration_error", "by iterations not made"},
    {"target_error", "asked error"},
    {"flux_balance", "light not absorbed"},
    {"escaping_share", "of that seen to leave"},
    {"chosen_bands", "bands"},
    {"chosen_basis", "basis"},
    {"chosen_cells", "cells"},
    {"chosen_memory", "memory"},
    {"chosen_patches", "light read off patches"},
    {"chosen_visibility", "visibility"},
    {"peak_rss_bytes", "memory, largest rank"},
    {"prepare_s", "time to prepare"},
    {"solve_s", "time to solve"},
    {"simulated_s", "simulated time"},
};

}  // namespace

IterationObserver SolveProgress::observer() {
  return [this](const IterationSummary& summary) {
    const double error = summary.error.total();
    // Nothing is estimated before the light is everywhere.
    const std::string estimate =
        error > 0.0 ? fmt::format(" estimated error {:.2g}%,", 100.0 * error) : "";
    report_progress(progress_,
                    fmt::format("solve: iteration {},{}", summary.plan.iteration, estimate),
                    error > 0.0 ? fraction(error) : 0.0);
  };
}

double SolveProgress::fraction(double error) {
  if (first_error_ == 0.0) first_error_ = error;
  if (error <= target_error_) return 1.0;
  if (!(first_error_ > target_error_)) return 0.0;
  return std::clamp(std::log(first_error_ / error) / std::log(first_error_ / target_error_), 0.0,
                    1.0);
}

Warnings shortfall_of(const std::string& run_directory, const RunRecord& record,
                      int max_iterations) {
  Warnings warnings;
  if (!gave_up(record)) return warnings;
  const auto percent = [&](const char* key) { return shown_number(key, record.number(key, 1.0)); };
  const double iterations = record.number("iterations", 0.0);
  warnings.add(run_directory,
               fmt::format("not converged after {} iterations: estimated error {} ({} read off "
                           "patches), asked {}; {}",
                           iterations, percent("estimated_error"), percent("estimated_patch_error"),
                           percent("target_error"),
                           iterations < max_iterations
                               ? "finer links bring little more, ask for a larger --target-error"
                               : "go on with --resume and a larger --max-iterations"));
  return warnings;
}

Warnings correction_failures(const std::string& run_directory,
                             const std::vector<IterationSummary>& history) {
  const auto failures =
      std::count_if(history.begin(), history.end(),
                    [](const IterationSummary& s) { return s.correction_failed; });
  Warnings warnings;
  if (failures > 0) {
    warnings.add(run_directory,
                 fmt::format("the coarse correction could not be solved after {} of {} iterations, "
                             "and was left out there; the estimated error accounts for it",
                             failures, history.size()));
  }
  return warnings;
}

std::string solve_summary(const std::string& run_directory, const RunRecord& record) {
  const bool reached = record.number("estimated_error", 1.0) <= record.number("target_error", 0.0);
  const bool replayed = record.find("replayed") != nullptr;
  const char* state = replayed          ? ": replayed"
                      : gave_up(record) ? ": gave up before it converged"
                      : reached         ? ": solved"
                                        : ": converged above the asked error";
  TextTable table(run_directory + state);
  for (const Row& row : summary_rows) {
    if (const auto* value = record.find(row.key))
      table.add(row.label, shown_value(row.key, *value));
  }
  table.add("look at", run_directory + (replayed ? "/stats.json" : "/report.html"));
  return table.text();
}

void describe_shares(RunRecord& record, const ShareIndex& shares) {
  record.set("shares", shares.names.size());
  record.set("share_iterations", shares.iterations);
  record.set("share_difference", RunRecord::Value(shares.difference));
  record.set("shares_s", RunRecord::Value(shares.solve_s));
}

std::string shares_summary(const std::string& run_directory, const ShareIndex& shares) {
  constexpr std::size_t most_names = 12;
  std::string names;
  for (std::size_t i = 0; i < std::min(most_names, shares.names.size()); ++i)
    names += (i > 0 ? ", " : "") + shares.names[i];
  if (shares.names.size() > most_names) names += ", ...";
  TextTable table(run_directory + "/shares: the light of each luminaire or switch");
  table.add("shares", fmt::format("{}: {}", shares.names.size(), names));
  table.add("iterations", fmt::format("{}", shares.iterations));
  table.add("sum less the whole",
            fmt::format("{:.2g}% before the rest was shared out", 100.0 * shares.difference));
  table.add("time", fmt::format("{:.3g} s", shares.solve_s));
  table.add("look at", "enfilade probe " + run_directory + " --shares --points ...");
  return table.text();
}

Warnings shares_shortfall(const std::string& run_directory, const ShareIndex& shares) {
  Warnings warnings;
  if (!shares.converged) {
    warnings.add(run_directory + "/shares",
                 fmt::format("not converged after {} iterations: their sum is {:.2g}% off the "
                             "whole light, and was made the whole",
                             shares.iterations, 100.0 * shares.difference));
  }
  return warnings;
}

}  // namespace enfilade
