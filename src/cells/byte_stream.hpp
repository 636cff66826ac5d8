// Plain values to bytes and back, for the files that `prepare` leaves for the ranks.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/error.hpp"
#include "scene/polygon.hpp"

namespace enfilade {

class ByteWriter {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T)); }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  void put_polygon(const Polygon& polygon) {
    put(static_cast<std::uint32_t>(polygon.size()));
    for (const Vec3& p : polygon) put(p);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Throws RunError at the end of the bytes, so that a cut-off file is never half read.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  template <class T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value;
    std::memcpy(static_cast<void*>(&value), take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string get_text() { return std::string(take(get<std::uint64_t>())); }
  Polygon get_polygon() {
    Polygon polygon(count<Vec3>(get<std::uint32_t>()));
    for (Vec3& p : polygon) p = get<Vec3>();
    return polygon;
  }
  /// A count of things of at least this size each: refused before memory is asked for.
  template <class T>
  std::size_t count(std::uint64_t n) {
    if (n > bytes_.size() / sizeof(T)) fail();
    return static_cast<std::size_t>(n);
  }
  void expect(std::string_view mark) {
    if (take(mark.size()) != mark) throw RunError(what_ + ": not a file of this version");
  }
  void expect_end() {
    if (!bytes_.empty()) throw RunError(what_ + ": longer than it should be");
  }

 private:
  [[noreturn]] void fail() const { throw RunError(what_ + ": cut off"); }
  std::string_view take(std::size_t n) {
    if (n > bytes_.size()) fail();
    const std::string_view part = bytes_.substr(0, n);
    bytes_.remove_prefix(n);
    return part;
  }

  std::string_view bytes_;
  std::string what_;
};

}  // namespace enfilade
