// Where a rank's seconds went.
#include "machine/machine.hpp"

namespace enfilade {

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
