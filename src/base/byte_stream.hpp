// Plain values to bytes and back, in little-endian order and without padding: for the files that
// ranks of one run share, and for messages between them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/error.hpp"

namespace enfilade {

// Values are copied as they lie in memory, and bytes are to be little-endian.
static_assert(std::endian::native == std::endian::little);

/// May a T be copied as it lies in memory: has it no padding, whose bytes would be anything?
/// Structs with floating-point members cannot be asked that: they are written field by field, or
/// declared by a specialisation that compares their size with that of their fields.
template <class T>
inline constexpr bool has_no_padding =
    std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>;
template <class T>
inline constexpr bool has_no_padding<glm::vec<2, T>> = sizeof(glm::vec<2, T>) == 2 * sizeof(T);
template <class T>
inline constexpr bool has_no_padding<glm::vec<3, T>> = sizeof(glm::vec<3, T>) == 3 * sizeof(T);
template <class T>
concept PlainValue = std::is_trivially_copyable_v<T> && has_no_padding<T>;

/// Appends values to a sequence of bytes, without gaps.
class ByteWriter {
 public:
  ByteWriter() = default;
  explicit ByteWriter(std::size_t expected_bytes) { bytes_.reserve(expected_bytes); }

  template <class T>
  void put(const T& value) {
    static_assert(PlainValue<T>);
    add(std::as_bytes(std::span(&value, 1)));
  }
  /// Writes the number of values, as a `Count`, then the values.
  template <class Count = std::uint64_t, class Values>
  void put_all(const Values& values) {
    static_assert(PlainValue<typename Values::value_type>);
    ENFILADE_CHECK(static_cast<Count>(values.size()) == values.size(),
                   std::to_string(values.size()));
    put(static_cast<Count>(values.size()));
    add(std::as_bytes(std::span(values.data(), values.size())));
  }
  void put_text(std::string_view text);
  /// Writes letters that the reader knows beforehand and checks: ByteReader::expect.
  void put_mark(std::string_view mark) { add(std::as_bytes(std::span(mark))); }

  std::span<const std::byte> bytes() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }
  std::string text() const;

 private:
  void add(std::span<const std::byte> raw);

  std::vector<std::byte> bytes_;
};

/// Throws RunError where the bytes end too early ("WHAT: cut off"), before it allocates memory for
/// values that are not there.
class ByteReader {
 public:
  ByteReader(std::span<const std::byte> bytes, std::string what)
      : bytes_(bytes), what_(std::move(what)) {}
  ByteReader(std::string_view text, std::string what)
      : ByteReader(std::as_bytes(std::span(text)), std::move(what)) {}

  template <class T>
  T get() {
    static_assert(PlainValue<T>);
    T value;
    std::memcpy(static_cast<void*>(&value), advance(sizeof(T)), sizeof(T));
    return value;
  }
  template <class T, class Count = std::uint64_t>
  std::vector<T> get_all() {
    std::vector<T> values;
    get_all<std::vector<T>, Count>(values);
    return values;
  }
  /// Reads into any container whose values lie in one piece of memory.
  template <class Values, class Count = std::uint64_t>
  void get_all(Values& values) {
    using T = typename Values::value_type;
    static_assert(PlainValue<T>);
    values.resize(get_count<Count>(sizeof(T)));
    const std::size_t size = values.size() * sizeof(T);
    const std::byte* from = advance(size);
    if (size > 0) std::memcpy(static_cast<void*>(values.data()), from, size);
  }
  std::string get_text();
  /// Reads a count of values that take at least `bytes_each` bytes each; throws RunError where
  /// fewer bytes are left.
  template <class Count = std::uint64_t>
  std::size_t get_count(std::size_t bytes_each) {
    const auto count = get<Count>();
    if (count > bytes_.size() / bytes_each) cut_off();
    return static_cast<std::size_t>(count);
  }
  /// Throws RunError where the next letters are not `mark`.
  void expect(std::string_view mark);
  /// Throws RunError where bytes are left.
  void expect_end() const;

 private:
  [[noreturn]] void cut_off() const;
  /// Returns the next `size` bytes and moves on behind them.
  const std::byte* advance(std::size_t size);

  std::span<const std::byte> bytes_;
  std::string what_;
};

}  // namespace enfilade
