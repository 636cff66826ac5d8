#include "schemes/protocol/rank_profiles.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Width, host's name, bins.
std::vector<double> numbers_of(const PhaseProfile& profile, const std::string& host) {
  std::vector<double> numbers{profile.bin_s(), static_cast<double>(host.size())};
  numbers.insert(numbers.end(), host.begin(), host.end());
  for (const auto& bin : profile.bins()) numbers.insert(numbers.end(), bin.begin(), bin.end());
  return numbers;
}

RankProfile profile_from(const std::vector<double>& numbers) {
  RankProfile rank;
  const auto letters = static_cast<std::size_t>(numbers[1]);
  std::size_t at = 2;
  for (; at < 2 + letters; ++at) rank.host += static_cast<char>(numbers[at]);
  std::vector<PhaseProfile::Bin> bins;
  for (; at < numbers.size(); at += phase_count) {
    auto& bin = bins.emplace_back();
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(at), phase_count, bin.begin());
  }
  rank.profile = PhaseProfile(numbers[0], std::move(bins));
  return rank;
}

}  // namespace

std::vector<RankProfile> gather_profiles(Communicator& communicator, const Machine& machine) {
  const auto mine = machine.profile();
  ENFILADE_CHECK(mine.has_value(), "Machine::trace() was not called");
  std::vector<RankProfile> ranks;
  for (const auto& numbers : communicator.gather(numbers_of(*mine, machine.host()))) {
    ranks.push_back(profile_from(numbers));
  }
  double widest_s = 0.0;
  for (const RankProfile& rank : ranks) widest_s = std::max(widest_s, rank.profile.bin_s());
  for (RankProfile& rank : ranks) rank.profile.widen(widest_s);
  return ranks;
}

}  // namespace enfilade
