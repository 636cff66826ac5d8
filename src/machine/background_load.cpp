#include "machine/background_load.hpp"

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

double BackgroundLoad::end_s(double start_s, double seconds) const {
  double round_s = repeat_s_ > 0.0 ? repeat_s_ * std::floor(start_s / repeat_s_) : 0.0;
  std::size_t i = 0;
  while (i + 1 < steps_.size() && round_s + steps_[i + 1].from_s <= start_s) ++i;
  for (double at_s = start_s;;) {
    const bool last = i + 1 == steps_.size();
    double until_s = std::numeric_limits<double>::infinity();
    if (!last) until_s = round_s + steps_[i + 1].from_s;
    if (last && repeat_s_ > 0.0) until_s = round_s + repeat_s_;
    const double free = 1.0 - steps_[i].share;
    if (at_s + seconds / free <= until_s) return at_s + seconds / free;
    seconds -= (until_s - at_s) * free;
    at_s = until_s;
    i = last ? 0 : i + 1;
    if (last) round_s += repeat_s_;
  }
}

}  // namespace enfilade
