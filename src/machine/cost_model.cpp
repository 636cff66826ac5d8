#include "machine/cost_model.hpp"

#include <cmath>
#include <functional>
#include <map>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using Json = nlohmann::json;
using Setter = std::function<void(double)>;

/// The largest figure allowed: a double of this size still is a whole number of bytes.
constexpr double largest_figure = 1e18;

void read_group(const Json& document, const std::string& path, const std::string& group,
                const std::map<std::string, Setter>& setters) {
  const auto found = document.find(group);
  if (found == document.end() || !found->is_object()) {
    throw InputError(path, group, "missing", "give it as in platforms/cost_model.json");
  }
  for (const auto& [key, value] : found->items()) {
    if (key == "comment") continue;
    const std::string where = group + "." + key;
    const auto setter = setters.find(key);
    if (setter == setters.end()) {
      throw InputError(path, where, "not a cost that is known",
                       "see platforms/README.md for the keys");
    }
    if (!value.is_number() || value.get<double>() < 0.0 || value.get<double>() > largest_figure) {
      throw InputError(path, where, "not a number from 0 to 1e18",
                       "give the cost as such a number");
    }
    setter->second(value.get<double>());
  }
  for (const auto& [key, setter] : setters) {
    if (!found->contains(key)) {
      throw InputError(path, group + "." + key, "missing",
                       "give it as in platforms/cost_model.json");
    }
  }
}

Setter into(double& target) {
  return [&target](double v) { target = v; };
}
Setter into(std::uint64_t& target) {
  return [&target](double v) { target = static_cast<std::uint64_t>(std::llround(v)); };
}

}  // namespace

std::string cost_model_text(const std::string& path) {
  std::string text = read_text(path);
  cost_model_from(text, path);
  return text;
}

CostModel cost_model_from(const std::string& text, const std::string& path) {
  const Json document = parse_json(text, path);
  if (!document.is_object() || document.value("format", Json()) != "enfilade-cost-model" ||
      document.value("version", Json()) != 1) {
    throw InputError(path, "format", "not an enfilade-cost-model of version 1",
                     "start from platforms/cost_model.json");
  }
  CostModel m;
  read_group(document, path, "flops",
             {{"ray", into(m.flops.ray)},
              {"form_factor", into(m.flops.form_factor)},
              {"kernel", into(m.flops.kernel)},
              {"link_refined", into(m.flops.link_refined)},
              {"link_gathered", into(m.flops.link_gathered)},
              {"patch", into(m.flops.patch)},
              {"push_pull", into(m.flops.push_pull)},
              {"shaft", into(m.flops.shaft)},
              {"byte_read", into(m.flops.byte_read)},
              {"byte_written", into(m.flops.byte_written)}});
  read_group(document, path, "disk",
             {{"seek_s", into(m.disk.seek_s)},
              {"request_s", into(m.disk.request_s)},
              {"request_bytes", into(m.disk.request_bytes)}});
  read_group(document, path, "records",
             {{"surface_bytes", into(m.records.surface_bytes)},
              {"patch_bytes", into(m.records.patch_bytes)},
              {"link_bytes", into(m.records.link_bytes)}});
  if (m.disk.request_bytes == 0) {
    throw InputError(path, "disk.request_bytes", "is 0",
                     "give the longest transfer of one request");
  }
  return m;
}

double price_flops(const CostModel& model, const WorkCount& work) {
  const auto n = [](std::uint64_t count) { return static_cast<double>(count); };
  const FlopCosts& f = model.flops;
  return f.ray * n(work.rays) + f.form_factor * n(work.form_factors) + f.kernel * n(work.kernels) +
         f.link_refined * n(work.links_refined) + f.link_gathered * n(work.links_gathered) +
         f.patch * n(work.patches) + f.push_pull * n(work.push_pulls) + f.shaft * n(work.shafts);
}

std::uint64_t price_record(const CostModel& model, const RecordCount& count) {
  const RecordSizes& r = model.records;
  if (r.surface_bytes == 0 && r.patch_bytes == 0 && r.link_bytes == 0) return count.bytes;
  return r.surface_bytes * count.surfaces + r.patch_bytes * count.patches +
         r.link_bytes * count.links;
}

std::uint64_t parse_bytes(const std::string& text, const std::string& file,
                          const std::string& where) {
  const InputError bad(file, where, "'" + text + "' is not a number of bytes",
                       "give digits, perhaps with K, M or G after them");
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    throw bad;
  }
  std::string suffix = text.substr(used);
  if (!suffix.empty() && (suffix.back() == 'B' || suffix.back() == 'b')) suffix.pop_back();
  if (!suffix.empty() && suffix.back() == 'i') suffix.pop_back();
  static const std::map<std::string, double> scale = {{"", 1.0},     {"K", 0x1p10}, {"k", 0x1p10},
                                                      {"M", 0x1p20}, {"m", 0x1p20}, {"G", 0x1p30},
                                                      {"g", 0x1p30}};
  const auto found = scale.find(suffix);
  if (found == scale.end() || !(value >= 0.0) || value * found->second > 0x1p62) throw bad;
  return static_cast<std::uint64_t>(value * found->second);
}

}  // namespace enfilade
