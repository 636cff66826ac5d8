#include "machine/background_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/error.hpp"

namespace enfilade {

BackgroundLoad::BackgroundLoad(const std::string& text, const std::string& file,
                               const std::string& where) {
  const InputError bad(file, where, "'" + text + "' is no load",
                       "give a share from 0 up to below 1, or '0 0.1, 3600 0.5, repeat 86400'");
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  const auto number = [&](std::string word) {
    if (!word.empty() && word.back() == ',') word.pop_back();
    std::size_t used = 0;
    double value = -1.0;
    try {
      value = std::stod(word, &used);
    } catch (const std::exception&) {
      throw bad;
    }
    if (used != word.size() || !(value >= 0.0) || !std::isfinite(value)) throw bad;
    return value;
  };
  if (words.size() == 1) words.insert(words.begin(), "0");
  if (words.empty() || words.size() % 2 != 0) throw bad;
  steps_.clear();
  for (std::size_t i = 0; i < words.size(); i += 2) {
    if (words[i] == "repeat") {
      repeat_s_ = number(words[i + 1]);
      if (i + 2 != words.size() || steps_.empty() || repeat_s_ <= steps_.back().from_s) throw bad;
      continue;
    }
    const Step step{number(words[i]), number(words[i + 1])};
    const bool in_order = steps_.empty() ? step.from_s == 0.0 : step.from_s > steps_.back().from_s;
    if (!in_order || step.share >= 1.0) throw bad;
    steps_.push_back(step);
  }
}

double BackgroundLoad::free_of_round_s() const {
  double free_s = 0.0;
  for (std::size_t i = 0; i < steps_.size(); ++i)
    free_s += (end_of_step_s(i) - steps_[i].from_s) * (1.0 - steps_[i].share);
  return free_s;
}

double BackgroundLoad::end_of_step_s(std::size_t i) const {
  if (i + 1 < steps_.size()) return steps_[i + 1].from_s;
  return repeat_s_ > 0.0 ? repeat_s_ : std::numeric_limits<double>::infinity();
}

double BackgroundLoad::end_s(double start_s, double seconds) const {
  // Times count from the start of a round: late in a run, a short round would vanish beside the
  // whole time. Whole rounds are passed at once, however many they are.
  double at_s = repeat_s_ > 0.0 ? std::fmod(start_s, repeat_s_) : start_s, passed_s = 0.0;
  std::size_t i = 0;
  while (i + 1 < steps_.size() && steps_[i + 1].from_s <= at_s) ++i;
  for (;;) {
    const double free = 1.0 - steps_[i].share, until_s = end_of_step_s(i);
    if (at_s + seconds / free <= until_s) return start_s + passed_s + seconds / free;
    seconds -= (until_s - at_s) * free;
    passed_s += until_s - at_s;
    at_s = until_s;
    if (++i < steps_.size()) continue;
    at_s = 0.0;
    i = 0;
    const double rounds = std::floor(seconds / free_of_round_s());
    seconds = std::max(0.0, seconds - rounds * free_of_round_s());
    passed_s += rounds * repeat_s_;
  }
}

}  // namespace enfilade
