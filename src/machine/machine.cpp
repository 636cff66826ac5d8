// What all machines have in common: work charged in parts, and the seconds of each phase.
#include "machine/machine.hpp"

#include <algorithm>

namespace enfilade {
namespace {

/// Operations between two calls of `listen`: a fraction of a second today, half a minute in 1998.
constexpr std::uint64_t operations_a_part = 512;
/// Parts of one gather: each is an event of the simulation, which takes real time.
constexpr std::uint64_t most_parts = 256;
/// A ray or a shaft query takes as long as about so many form factors.
constexpr std::uint64_t form_factors_a_ray = 8;

std::uint64_t parts_of(const WorkCount& work) {
  const std::uint64_t operations = work.rays + work.shafts + work.form_factors / form_factors_a_ray;
  return 1 + std::min(most_parts - 1, operations / operations_a_part);
}

/// The k-th of n parts, counted from 0; all together are the whole.
WorkCount part(const WorkCount& work, std::uint64_t k, std::uint64_t n) {
  const auto share = [k, n](std::uint64_t count) { return count * (k + 1) / n - count * k / n; };
  return {share(work.rays),          share(work.form_factors),   share(work.kernels),
          share(work.links_refined), share(work.links_gathered), share(work.patches),
          share(work.push_pulls),    share(work.shafts)};
}

}  // namespace

void Machine::compute_in_parts(const WorkCount& work, const std::function<void()>& listen) {
  const std::uint64_t parts = time_passes_by_itself() ? 1 : parts_of(work);
  for (std::uint64_t k = 0; k < parts; ++k) {
    compute(part(work, k, parts));
    listen();
  }
}

void Machine::wait_for_message(const std::function<bool()>& poll, const std::function<bool()>&) {
  for (int turn = 0; !poll(); ++turn) pause(turn);
}

void Machine::describe(RunRecord&, double) const {}

Phase Machine::enter(Phase phase) {
  const double now = now_s();
  seconds_[static_cast<std::size_t>(phase_)] += now - since_s_;
  if (profile_) profile_->add(phase_, since_s_, now);
  since_s_ = now;
  const Phase before = phase_;
  phase_ = phase;
  return before;
}

void Machine::trace() {
  enter(phase_);
  profile_.emplace();
}

std::optional<PhaseProfile> Machine::profile() const {
  auto result = profile_;
  if (result) result->add(phase_, since_s_, now_s());
  return result;
}

std::array<double, phase_count> Machine::seconds() const {
  auto result = seconds_;
  result[static_cast<std::size_t>(phase_)] += now_s() - since_s_;
  return result;
}

TimeUse Machine::time_use() const {
  const auto s = seconds();
  const auto of = [&](Phase phase) { return s[static_cast<std::size_t>(phase)]; };
  return {of(Phase::compute), of(Phase::io) + of(Phase::commit),
          of(Phase::steal) + of(Phase::wait) + of(Phase::token)};
}

}  // namespace enfilade
