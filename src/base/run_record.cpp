#include "base/run_record.hpp"

namespace enfilade {

void RunRecord::set(const std::string& key, Value value) {
  for (auto& [k, v] : entries_) {
    if (k == key) {
      v = std::move(value);
      return;
    }
  }
  entries_.emplace_back(key, std::move(value));
}

const RunRecord::Value* RunRecord::find(const std::string& key) const {
  for (const auto& [k, v] : entries_) {
    if (k == key) return &v;
  }
  return nullptr;
}

double RunRecord::number(const std::string& key, double otherwise) const {
  const Value* value = find(key);
  if (value == nullptr) return otherwise;
  if (const auto* d = std::get_if<double>(value)) return *d;
  if (const auto* i = std::get_if<std::int64_t>(value)) return static_cast<double>(*i);
  return otherwise;
}

}  // namespace enfilade
