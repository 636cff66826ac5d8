#include "base/warnings.hpp"

#include <map>

namespace enfilade {

void Warnings::add(std::string where, std::string what) {
  all_.push_back({std::move(where), std::move(what)});
}

std::vector<std::string> Warnings::summary(std::size_t places) const {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const std::string*>> by_kind;
  for (const Warning& w : all_) {
    auto& list = by_kind[w.what];
    if (list.empty()) order.push_back(w.what);
    list.push_back(&w.where);
  }
  std::vector<std::string> lines;
  for (const std::string& what : order) {
    const auto& list = by_kind[what];
    std::string line;
    for (std::size_t i = 0; i < list.size() && i < places; ++i) {
      line += (i == 0 ? "" : ", ") + *list[i];
    }
    if (list.size() > places) line += " and " + std::to_string(list.size() - places) + " more";
    lines.push_back(line + ": " + what);
  }
  return lines;
}

}  // namespace enfilade
