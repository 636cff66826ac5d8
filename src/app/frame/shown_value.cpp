#include "app/frame/shown_value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/frame/text_table.hpp"

namespace enfilade {

std::string shown_number(const std::string& key, double x) {
  if (!std::isfinite(x)) return "not known";
  if (key.ends_with("_s")) return format_duration(x);
  if (key.starts_with("bytes_") || key.ends_with("_bytes")) return format_bytes(x);
  if (key.starts_with("estimated_") || key == "target_error" || key == "flux_balance" ||
      key == "escaping_share")
    return fmt::format("{:.2g}%", 100.0 * x);
  return fmt::format("{:.4g}", x);
}

std::string shown_value(const std::string& key, const RunRecord::Value& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) {
    return key.ends_with("_bytes") || key.starts_with("bytes_")
               ? format_bytes(static_cast<double>(*n))
               : (*n < 0 ? "-" : "") + with_thousands(static_cast<std::uint64_t>(std::abs(*n)));
  }
  if (const auto* x = std::get_if<double>(&value)) return shown_number(key, *x);
  if (const auto* yes = std::get_if<bool>(&value)) return *yes ? "yes" : "no";
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  std::string list;
  for (const double x : std::get<std::vector<double>>(value)) {
    list += (list.empty() ? "" : ", ") + shown_number(key, x);
  }
  return list;
}

}  // namespace enfilade
