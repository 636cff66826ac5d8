#include "view_factors/view_factors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/run_on_threads.hpp"
#include "view_factors/row_source.hpp"

namespace enfilade {
namespace {

/// A row that lacks less than this is closed.
constexpr double closed_within = 1e-3;
constexpr int most_scalings = 2000;
constexpr double scaled_within = 1e-9;
/// Of a row's error: what an entry that seems exact may be wrong by, so that weights stay finite.
constexpr double least_error = 1e-12;

int rays_of(double area_m2, double group_m2, int rays) {
  return std::max(16, static_cast<int>(std::lround(rays * area_m2 / std::max(group_m2, 1e-300))));
}

/// Scales closed rows and columns alike until the rows sum to their areas.
void close_rows(const ViewFactors& f, std::vector<double>& exchange_m2) {
  const std::size_t n = f.size();
  std::vector<double> scale(n, 1.0);
  for (int round = 0; round < most_scalings; ++round) {
    double worst = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!f.closed[i]) continue;
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) sum += exchange_m2[i * n + j] * scale[j];
      sum *= scale[i];
      if (!(sum > 0.0)) continue;
      worst = std::max(worst, std::abs(sum / f.area_m2[i] - 1.0));
      scale[i] *= std::sqrt(f.area_m2[i] / sum);
    }
    if (worst < scaled_within) break;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) exchange_m2[i * n + j] *= scale[i] * scale[j];
  }
}

}  // namespace

void make_reciprocal(ViewFactors& f) {
  const std::size_t n = f.size();
  std::vector<double> exchange_m2(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double here = f.area_m2[i] * f.factor[i * n + j];
      const double there = f.area_m2[j] * f.factor[j * n + i];
      const double e = std::max(f.area_m2[i] * f.error[i * n + j], least_error * f.area_m2[i]);
      const double g = std::max(f.area_m2[j] * f.error[j * n + i], least_error * f.area_m2[j]);
      const double weight = g * g / (e * e + g * g);
      exchange_m2[i * n + j] = weight * here + (1.0 - weight) * there;
    }
  }
  close_rows(f, exchange_m2);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double factor = f.area_m2[i] > 0.0 ? exchange_m2[i * n + j] / f.area_m2[i] : 0.0;
      f.largest_closure = std::max(f.largest_closure, std::abs(factor - f.factor[i * n + j]));
      f.error[i * n + j] = std::hypot(f.error[i * n + j], factor - f.factor[i * n + j]);
      f.factor[i * n + j] = factor;
    }
  }
}

ViewFactors view_factors(const Scene& scene, std::span<const Cluster> clusters,
                         const Occluders& occluders, const ViewFactorGroups& groups,
                         const ViewFactorConfig& config, const Progress& progress) {
  const std::size_t n = groups.names.size();
  std::vector<ClusterState> states;
  states.reserve(clusters.size());
  for (const Cluster& cluster : clusters) states.emplace_back(cluster, scene, Basis::constant);
  ViewFactors f{groups.names,
                std::vector<double>(n, 0.0),
                std::vector<double>(n * n, 0.0),
                std::vector<double>(n * n, 0.0),
                std::vector<double>(n, 0.0),
                std::vector<bool>(n, false)};
  std::vector<std::vector<std::uint32_t>> polygons(n);
  for (std::uint32_t k = 0; k < groups.of_polygon.size(); ++k) {
    const std::uint32_t group = groups.of_polygon[k];
    if (group == ViewFactorGroups::none) continue;
    polygons[group].push_back(k);
    f.area_m2[group] += area_m2(occluders.polygon(k));
  }
  for_each_on_threads(n, "view factors", progress, [&](std::size_t i) {
    RowSource source(states, occluders, groups, config);
    RowSum sum(n);
    for (const std::uint32_t k : polygons[i]) {
      sum.add(config.rays > 0 ? source.by_rays(k, rays_of(area_m2(occluders.polygon(k)),
                                                          f.area_m2[i], config.rays))
                              : source.by_quadrature(k));
    }
    f.area_m2[i] = std::max(0.0, f.area_m2[i] - sum.covered_m2);
    for (std::size_t j = 0; j < n && f.area_m2[i] > 0.0; ++j) {
      f.factor[i * n + j] = sum.factor_m2[j] / f.area_m2[i];
      f.error[i * n + j] = sum.error_m2[j] / f.area_m2[i];
    }
  });
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = f.factor.begin() + static_cast<std::ptrdiff_t>(i * n);
    f.sum_before[i] = std::accumulate(row, row + static_cast<std::ptrdiff_t>(n), 0.0);
    f.closed[i] = std::abs(1.0 - f.sum_before[i]) < closed_within;
  }
  make_reciprocal(f);
  return f;
}

}  // namespace enfilade
