// The two chunks of a glTF binary: JSON, and the bytes that it describes.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace enfilade {

/// Collects buffer views and accessors; the caller adds the rest of the JSON.
class GlbWriter {
 public:
  nlohmann::ordered_json json;
  std::string chunk;

  template <class T>
  std::size_t add_view(const std::vector<T>& values, int target) {
    const std::size_t bytes = values.size() * sizeof(T), start = chunk.size();
    chunk.resize(start + (bytes + 3) / 4 * 4, '\0');
    if (bytes > 0) std::memcpy(chunk.data() + start, values.data(), bytes);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes}, {"target", target}});
    return json["bufferViews"].size() - 1;
  }
  std::size_t add_accessor(std::size_t view, std::size_t offset, int type, std::size_t count,
                           const char* shape) {
    json["accessors"].push_back({{"bufferView", view},
                                 {"byteOffset", offset},
                                 {"componentType", type},
                                 {"count", count},
                                 {"type", shape}});
    return json["accessors"].size() - 1;
  }
  std::string bytes() const {
    std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out;
    const auto word = [&out](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>((value >> shift) & 0xFF);
    };
    word(0x46546C67);  // "glTF"
    word(2);
    word(12 + 8 + text.size() + 8 + chunk.size());
    word(text.size());
    word(0x4E4F534A);  // "JSON"
    out += text;
    word(chunk.size());
    word(0x004E4942);  // "BIN"
    return out + chunk;
  }
};

}  // namespace enfilade
