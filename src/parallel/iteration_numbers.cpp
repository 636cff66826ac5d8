// Plans and sums as plain numbers, for the token, the verdict and the manifest.
#include <array>

#include "base/error.hpp"
#include "parallel/iteration_plan.hpp"

namespace enfilade {
namespace {

double number(std::uint64_t count) { return static_cast<double>(count); }
std::uint64_t count(double number) { return static_cast<std::uint64_t>(number); }

/// Hands out numbers one by one.
class Numbers {
 public:
  explicit Numbers(std::span<const double> numbers) : numbers_(numbers) {}
  double next() {
    if (numbers_.empty())
      throw RunError(
          "the record of an iteration is damaged, or of another version of enfilade; solve again "
          "without --resume");
    const double value = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return value;
  }
  std::uint64_t next_count() { return count(next()); }
  std::span<const double> rest() const { return numbers_; }

 private:
  std::span<const double> numbers_;
};

void add_bands(Spectrum& sum, const Spectrum& part) {
  if (sum.size() < part.size()) sum.resize(part.size(), 0.0);
  for (std::size_t b = 0; b < part.size(); ++b) sum[b] += part[b];
}

/// All of them have as many bands, or none.
template <class Sums>
auto spectra_of(Sums& s) {
  return std::array{&s.arriving_power, &s.returning_power, &s.absorbed_power, &s.escaping_power,
                    &s.beamed_power,   &s.doubtful_power,  &s.residual.light, &s.residual.surplus,
                    &s.residual.off,   &s.residual.noise};
}

}  // namespace

void add(IterationSums& sums, const IterationSums& part) {
  sums.max_change = std::max(sums.max_change, part.max_change);
  sums.change_power += part.change_power;
  sums.received_power += part.received_power;
  sums.link_error_power += part.link_error_power;
  sums.link_doubt_power += part.link_doubt_power;
  sums.patches += part.patches;
  sums.links += part.links;
  sums.steals += part.steals;
  sums.steal_requests += part.steal_requests;
  add_bands(sums.arriving_power, part.arriving_power);
  add_bands(sums.returning_power, part.returning_power);
  add_bands(sums.absorbed_power, part.absorbed_power);
  add_bands(sums.escaping_power, part.escaping_power);
  add_bands(sums.beamed_power, part.beamed_power);
  add_bands(sums.doubtful_power, part.doubtful_power);
  add(sums.residual, part.residual);
  sums.work += part.work;
}

Token to_token(const IterationSums& s) {
  Token token;
  token.maxima = {s.max_change};
  token.sums = {s.change_power,
                s.received_power,
                s.link_error_power,
                s.link_doubt_power,
                number(s.patches),
                number(s.links),
                number(s.steals),
                number(s.steal_requests),
                number(s.work.rays),
                number(s.work.form_factors),
                number(s.work.kernels),
                number(s.work.links_refined),
                number(s.work.links_gathered),
                number(s.work.patches),
                number(s.work.push_pulls),
                number(s.work.shafts)};
  for (const Spectrum* bands : spectra_of(s)) {
    token.sums.insert(token.sums.end(), bands->begin(), bands->end());
  }
  return token;
}

IterationSums sums_from(const Token& token) {
  IterationSums s;
  Numbers maxima(token.maxima), sums(token.sums);
  s.max_change = maxima.next();
  s.change_power = sums.next();
  s.received_power = sums.next();
  s.link_error_power = sums.next();
  s.link_doubt_power = sums.next();
  s.patches = sums.next_count();
  s.links = sums.next_count();
  s.steals = sums.next_count();
  s.steal_requests = sums.next_count();
  s.work.rays = sums.next_count();
  s.work.form_factors = sums.next_count();
  s.work.kernels = sums.next_count();
  s.work.links_refined = sums.next_count();
  s.work.links_gathered = sums.next_count();
  s.work.patches = sums.next_count();
  s.work.push_pulls = sums.next_count();
  s.work.shafts = sums.next_count();
  const auto spectra = spectra_of(s);
  const std::size_t bands = sums.rest().size() / spectra.size();
  for (Spectrum* spectrum : spectra) {
    for (std::size_t b = 0; b < bands; ++b) spectrum->push_back(sums.next());
  }
  return s;
}

std::vector<double> to_numbers(const IterationPlan& plan) {
  std::vector<double> numbers = {static_cast<double>(plan.iteration),
                                 plan.link_tolerance,
                                 plan.refine ? 1.0 : 0.0,
                                 plan.close_rows ? 1.0 : 0.0,
                                 plan.sample ? 1.0 : 0.0,
                                 static_cast<double>(plan.sample_rays),
                                 plan.received_power,
                                 plan.finished ? 1.0 : 0.0,
                                 plan.converged ? 1.0 : 0.0,
                                 static_cast<double>(plan.mend.size())};
  numbers.insert(numbers.end(), plan.mend.begin(), plan.mend.end());
  return numbers;
}

namespace {

IterationPlan next_plan_of(Numbers& n) {
  IterationPlan plan;
  plan.iteration = static_cast<int>(n.next());
  plan.link_tolerance = n.next();
  plan.refine = n.next() != 0.0;
  plan.close_rows = n.next() != 0.0;
  plan.sample = n.next() != 0.0;
  plan.sample_rays = static_cast<int>(n.next());
  plan.received_power = n.next();
  plan.finished = n.next() != 0.0;
  plan.converged = n.next() != 0.0;
  for (std::uint64_t bands = n.next_count(); bands > 0; --bands) plan.mend.push_back(n.next());
  return plan;
}

}  // namespace

IterationPlan plan_from(std::span<const double> numbers) {
  Numbers n(numbers);
  return next_plan_of(n);
}

std::vector<double> to_numbers(const IterationSummary& summary) {
  std::vector<double> numbers = to_numbers(summary.plan);
  numbers.push_back(summary.corrected ? 1.0 : 0.0);
  numbers.push_back(summary.missing_power);
  numbers.push_back(summary.error.discretisation);
  numbers.push_back(summary.error.visibility);
  numbers.push_back(summary.error.iteration);
  numbers.push_back(summary.error.patches);
  numbers.push_back(summary.error.iteration_bound);
  numbers.push_back(summary.time_s);
  const Token token = to_token(summary.sums);
  numbers.insert(numbers.end(), token.maxima.begin(), token.maxima.end());
  numbers.insert(numbers.end(), token.sums.begin(), token.sums.end());
  return numbers;
}

IterationSummary summary_from(std::span<const double> numbers) {
  IterationSummary summary;
  Numbers n(numbers);
  summary.plan = next_plan_of(n);
  summary.corrected = n.next() != 0.0;
  summary.missing_power = n.next();
  summary.error.discretisation = n.next();
  summary.error.visibility = n.next();
  summary.error.iteration = n.next();
  summary.error.patches = n.next();
  summary.error.iteration_bound = n.next();
  summary.time_s = n.next();
  Token token;
  token.maxima = {n.next()};
  token.sums.assign(n.rest().begin(), n.rest().end());
  summary.sums = sums_from(token);
  return summary;
}

}  // namespace enfilade
