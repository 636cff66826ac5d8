#include "report/walk/binary_arrays.hpp"

#include <zlib.h>

#include <bit>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "report/drawing/base64.hpp"

namespace enfilade {

static_assert(std::endian::native == std::endian::little);

void BinaryArrays::add_bytes(const std::string& name, const void* values, std::size_t width,
                             std::size_t length) {
  const auto* bytes = static_cast<const char*>(values);
  entries_.push_back({name, width, length});
  for (std::size_t plane = 0; plane < width; ++plane) {
    for (std::size_t i = 0; i < length; ++i) data_ += bytes[i * width + plane];
  }
  data_.resize((data_.size() + 3) / 4 * 4, '\0');
}

void BinaryArrays::add(const std::string& name, std::span<const float> values) {
  add_bytes(name, values.data(), sizeof(float), values.size());
}
void BinaryArrays::add(const std::string& name, std::span<const std::uint32_t> values) {
  add_bytes(name, values.data(), sizeof(std::uint32_t), values.size());
}
void BinaryArrays::add(const std::string& name, std::span<const std::uint16_t> values) {
  add_bytes(name, values.data(), sizeof(std::uint16_t), values.size());
}
void BinaryArrays::add(const std::string& name, std::span<const std::uint8_t> values) {
  add_bytes(name, values.data(), sizeof(std::uint8_t), values.size());
}

nlohmann::ordered_json BinaryArrays::list() const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Entry& entry : entries_)
    list.push_back({{"name", entry.name}, {"bytes", entry.width}, {"length", entry.length}});
  return list;
}

std::string BinaryArrays::text() const {
  uLongf size = compressBound(data_.size());
  std::string packed(size, '\0');
  const int code =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(data_.data()), data_.size(), Z_DEFAULT_COMPRESSION);
  if (code != Z_OK) throw RunError("zlib could not compress the walk-through's data");
  packed.resize(size);
  return base64(packed);
}

std::uint16_t half_float(double value) { return glm::packHalf1x16(static_cast<float>(value)); }

}  // namespace enfilade
