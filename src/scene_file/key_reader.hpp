// Values taken out of parsed JSON; an error names the key of the value.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Reads numbers, points and spectra of one file. A `where` is the key of the value, as in
/// `probes[2].n`.
class KeyReader {
 public:
  explicit KeyReader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& where, const std::string& what,
                         const std::string& hint) const {
    throw InputError(file_, where, what, hint);
  }

  double finite(const nlohmann::json& value, const std::string& where) const {
    if (!value.is_number())
      fail(where, "is " + shown_value(value) + ", not a finite number", "write a number");
    return value.get<double>();
  }
  Vec3 point(const nlohmann::json& value, const std::string& where) const;
  /// Returns a place in metres, within the limits (base/limits.hpp).
  Vec3 place(const nlohmann::json& value, const std::string& where, double scale) const;
  /// Returns a direction of any length as a unit vector.
  Vec3 direction(const nlohmann::json& value, const std::string& where) const;
  /// Returns one number or a list of them, each checked to lie in [low, high).
  Spectrum spectrum(const nlohmann::json& value, const std::string& where, double high) const;
  std::string text(const nlohmann::json& value, const std::string& where) const;
  bool flag(const nlohmann::json& value, const std::string& where) const;
  /// Returns the list, which is within the limits.
  const nlohmann::json& list(const nlohmann::json& value, const std::string& where) const;
  /// Returns the value under `key`, which must be there.
  const nlohmann::json& need(const nlohmann::json& object, const char* key,
                             const std::string& where) const;

  /// Returns metres per unit of length for "m", "mm", "cm", "ft", "in".
  double metres_per_unit(const nlohmann::json& document) const;
  /// Returns the list under "probes"; points scaled, normals of unit length. Extra keys go to
  /// `unknown` if given.
  std::vector<Probe> probes(const nlohmann::json& document, double scale,
                            std::set<std::string>* unknown) const;

  const std::string& file() const { return file_; }

 private:
  static std::string shown_value(const nlohmann::json& value);
  std::string file_;
};

}  // namespace enfilade
