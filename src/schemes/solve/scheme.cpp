#include "schemes/solve/scheme.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"

namespace enfilade {
namespace {
constexpr std::array names = {"spmd", "master-slave", "replicated"};
}

std::span<const char* const> scheme_names() { return names; }

const char* name_of(Scheme scheme) { return names.at(static_cast<std::size_t>(scheme)); }

Scheme scheme_of(const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<Scheme>(found - names.begin());
  throw InputError("--scheme", "'" + name + "'", "no scheme has this name",
                   "use spmd, master-slave or replicated");
}

}  // namespace enfilade
