// The figures of a gather, and of all gathers of an iteration. One list names them all
// (for_each_figure): by it they are summed over clusters and ranks, sent, stored and printed.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/work_count.hpp"
#include "gather/error_samples.hpp"
#include "gather/row_sums.hpp"

namespace enfilade {

/// A power is area times irradiance (or radiosity): the scene's unit times m2. Powers that are one
/// number are those of the worst band.
struct IterationFigures {
  double max_change = 0.0;  ///< max |B(k) - B(k-1)| over patches and bands: the paper's T (§3.3.4)
  double change_power = 0.0;      ///< sum of area |B(k) - B(k-1)|
  double received_power = 0.0;    ///< sum of area * irradiance
  double link_error_power = 0.0;  ///< sum of the links' estimated errors, each times importance
  double visibility_uncertainty_power = 0.0;  ///< the part of that due to visibility uncertainty
  std::uint64_t patches = 0, links = 0;       ///< their number after the gather
  /// Shooting clusters that a receiver has links with, itself left out, summed over receivers.
  std::uint64_t linked_clusters = 0;
  std::uint64_t steals = 0, steal_requests = 0;
  WorkCount work;
  RowSums rows;  ///< before their closure (row_closure.hpp), zero where no rows were closed
  // Per band:
  Spectrum arriving_power;   ///< sum of area * irradiance
  Spectrum returning_power;  ///< the reflected (not emitted) part of arriving_power
  Spectrum absorbed_power;   ///< sum of area (1 - reflectance) irradiance
  /// Sum of area * radiosity * (1 - enclosed share): the part of a patch's light that goes into the
  /// open, onto a back side or onto an unlit front side.
  Spectrum escaping_power;
  Spectrum direct_power;          ///< power that came straight from point lights
  Spectrum uncertain_power;       ///< power that a flux correction of 1 would add
  ErrorSampleSums error_samples;  ///< empty or zero where nothing was sampled
};

/// How the parts of a figure become that of the whole.
enum class Fold { sum, maximum };
/// The value of a figure in stats.json: none, that of the last iteration, or the sum over all.
enum class InStats { no, last, total };

struct FigureName {
  const char* name;  ///< in history.json and stats.json
  Fold fold = Fold::sum;
  InStats in_stats = InStats::no;
};

/// The figures of for_each_figure() that are one number.
template <class Visit>
void for_each_number(Visit visit) {
  using enum InStats;
  visit(
      FigureName{"max_change", Fold::maximum}, [](auto& f) -> auto& { return f.max_change; });
  visit(
      FigureName{"change_power"}, [](auto& f) -> auto& { return f.change_power; });
  visit(
      FigureName{"received_power"}, [](auto& f) -> auto& { return f.received_power; });
  visit(
      FigureName{"link_error_power"}, [](auto& f) -> auto& { return f.link_error_power; });
  visit(
      FigureName{"visibility_uncertainty_power"},
      [](auto& f) -> auto& { return f.visibility_uncertainty_power; });
  visit(
      FigureName{"patches", Fold::sum, last}, [](auto& f) -> auto& { return f.patches; });
  visit(
      FigureName{"links", Fold::sum, last}, [](auto& f) -> auto& { return f.links; });
  visit(
      FigureName{"linked_clusters"}, [](auto& f) -> auto& { return f.linked_clusters; });
  visit(
      FigureName{"steals", Fold::sum, total}, [](auto& f) -> auto& { return f.steals; });
  visit(
      FigureName{"steal_requests", Fold::sum, total},
      [](auto& f) -> auto& { return f.steal_requests; });
  visit(
      FigureName{"rays", Fold::sum, total}, [](auto& f) -> auto& { return f.work.rays; });
  visit(
      FigureName{"form_factors", Fold::sum, total},
      [](auto& f) -> auto& { return f.work.form_factors; });
  visit(
      FigureName{"kernels", Fold::sum, total}, [](auto& f) -> auto& { return f.work.kernels; });
  visit(
      FigureName{"links_refined"}, [](auto& f) -> auto& { return f.work.links_refined; });
  visit(
      FigureName{"links_gathered"}, [](auto& f) -> auto& { return f.work.links_gathered; });
  visit(
      FigureName{"patches_made"}, [](auto& f) -> auto& { return f.work.patches; });
  visit(
      FigureName{"push_pulls"}, [](auto& f) -> auto& { return f.work.push_pulls; });
  visit(
      FigureName{"shafts", Fold::sum, total}, [](auto& f) -> auto& { return f.work.shafts; });
  visit(
      FigureName{"row_deficit_m2"}, [](auto& f) -> auto& { return f.rows.deficit_m2; });
  visit(
      FigureName{"row_closed_m2"}, [](auto& f) -> auto& { return f.rows.closed_m2; });
  visit(
      FigureName{"row_ratio_m2"}, [](auto& f) -> auto& { return f.rows.ratio_m2; });
}

/// The figures of for_each_figure() that are a Spectrum.
template <class Visit>
void for_each_spectrum(Visit visit) {
  visit(
      FigureName{"arriving_power"}, [](auto& f) -> auto& { return f.arriving_power; });
  visit(
      FigureName{"returning_power"}, [](auto& f) -> auto& { return f.returning_power; });
  visit(
      FigureName{"absorbed_power"}, [](auto& f) -> auto& { return f.absorbed_power; });
  visit(
      FigureName{"escaping_power"}, [](auto& f) -> auto& { return f.escaping_power; });
  visit(
      FigureName{"direct_power"}, [](auto& f) -> auto& { return f.direct_power; });
  visit(
      FigureName{"uncertain_power"}, [](auto& f) -> auto& { return f.uncertain_power; });
  visit(
      FigureName{"error_samples_light"}, [](auto& f) -> auto& { return f.error_samples.light; });
  visit(
      FigureName{"error_samples_surplus"},
      [](auto& f) -> auto& { return f.error_samples.surplus; });
  visit(
      FigureName{"error_samples_off"}, [](auto& f) -> auto& { return f.error_samples.off; });
  visit(
      FigureName{"error_samples_noise"}, [](auto& f) -> auto& { return f.error_samples.noise; });
  visit(
      FigureName{"error_samples_surplus_variance"},
      [](auto& f) -> auto& { return f.error_samples.surplus_variance; });
}

/// The figures that are a list of RowSums::cells numbers, or empty.
template <class Visit>
void for_each_histogram(Visit visit) {
  visit(
      FigureName{"row_area_by_ratio"}, [](auto& f) -> auto& { return f.rows.area_by_ratio; });
}

/// Calls visit(FigureName, access) for each figure; access(figures) is a reference to it: a double,
/// a count, or a list of numbers: a Spectrum or a histogram. All spectra have the same number of
/// bands. Messages, the manifest and recordings keep this order: a change to the list needs a new
/// manifest_version (run/manifest.cpp) and a new mark of recordings
/// (schemes/protocol/gather_cost.cpp).
template <class Visit>
void for_each_figure(Visit visit) {
  for_each_number(visit);
  for_each_spectrum(visit);
  for_each_histogram(visit);
}

/// True where access() of for_each_figure() returns a list, not one number.
template <class Access>
inline constexpr bool is_list =
    std::is_same_v<std::remove_cvref_t<std::invoke_result_t<Access, IterationFigures&>>,
                   std::vector<double>>;

/// Adds one part (a cluster's, a rank's) to another, each figure by its Fold.
void add(IterationFigures& figures, const IterationFigures& part);

/// Figures as plain numbers, by their Fold, each in the list's order; the bands of a Spectrum stand
/// one after the other, and so do the cells of a histogram.
struct FoldedNumbers {
  std::vector<double> maxima, sums;
};
FoldedNumbers to_numbers(const IterationFigures& figures);
/// Returns the figures that `to_numbers` encoded. Throws RunError where there are too few numbers.
IterationFigures figures_from(std::span<const double> maxima, std::span<const double> sums);

/// Returns power over received power: 0 where there is none, 1 where nothing is received
/// and the power is not 0.
inline double share_of_received(double power, double received) {
  if (power == 0.0) return 0.0;
  return received > 0.0 ? power / received : 1.0;
}

}  // namespace enfilade
