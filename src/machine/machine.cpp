// Where a rank's seconds went.
#include "machine/machine.hpp"

namespace enfilade {

Phase Machine::enter(Phase phase) {
  const double now = now_s();
  seconds_[static_cast<std::size_t>(phase_)] += now - since_s_;
  since_s_ = now;
  const Phase before = phase_;
  phase_ = phase;
  return before;
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
