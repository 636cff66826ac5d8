#include "import/gltf/gltf_document.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

std::string at(const char* list, std::size_t index) {
  return list + ("[" + std::to_string(index) + "]");
}

std::size_t little_endian(std::string_view bytes, std::size_t offset) {
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[offset + i]);
  return value;
}

/// Returns false where the text is not base64 (RFC 4648).
bool decode_base64(std::string_view text, std::string& bytes) {
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    unsigned value = 0;
    if (c >= 'A' && c <= 'Z')
      value = static_cast<unsigned>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      value = static_cast<unsigned>(c - 'a') + 26;
    else if (c >= '0' && c <= '9')
      value = static_cast<unsigned>(c - '0') + 52;
    else if (c == '+' || c == '-')
      value = 62;
    else if (c == '/' || c == '_')
      value = 63;
    else if (c == '=' || c == '\n' || c == '\r')
      continue;
    else
      return false;
    bits = bits << 6 | value;
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xFF);
  }
  return true;
}

/// %20 and the like become what they stand for.
std::string decode_percent(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(uri[i + 1]) != 0 &&
                       std::isxdigit(uri[i + 2]) != 0;
    text += coded ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (coded) i += 2;
  }
  return text;
}

}  // namespace

GltfDocument::GltfDocument(ModelFiles& files, const std::vector<std::string_view>& known)
    : files_(files) {
  const std::string& bytes = files_.read_model();
  if (bytes.compare(0, 4, "glTF") == 0)
    split_binary(bytes);
  else
    root_ = parse_json(bytes, files_.model());
  if (!root_.is_object()) fail("top level", "is not an object", "export the model again");
  const std::string version =
      root_.contains("asset") && root_["asset"].is_object() ? text(root_["asset"], "version") : "";
  if (version.compare(0, 2, "2.") != 0) {
    fail("asset.version", "is " + in_quotes(version) + ", not 2.0",
         "convert the model to glTF 2.0");
  }
  const std::string least = text(root_["asset"], "minVersion");
  if (!least.empty() && least != "2.0") {
    fail("asset.minVersion", "asks for a reader of glTF " + in_quotes(least),
         "export the model as glTF 2.0");
  }
  check_extensions(known);
}

void GltfDocument::split_binary(const std::string& bytes) {
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr const char* hint = "export the model again";
  std::size_t offset = header;
  bool any_text = false;
  if (bytes.size() < header + chunk_header) fail("file", "is cut off within its header", hint);
  if (little_endian(bytes, 4) != 2) fail("file", "is binary glTF of another version than 2", hint);
  while (offset + chunk_header <= bytes.size()) {
    const std::size_t length = little_endian(bytes, offset);
    const std::string kind = bytes.substr(offset + 4, 4);
    offset += chunk_header;
    if (length > bytes.size() - offset) fail("file", "is cut off within a chunk", hint);
    const std::string_view chunk = std::string_view(bytes).substr(offset, length);
    if (kind == "JSON" && !any_text) {
      root_ = parse_json(std::string(chunk), files_.model());
      any_text = true;
    } else if (kind == std::string("BIN\0", 4) && !has_binary_) {
      binary_ = chunk;
      has_binary_ = true;
    }
    offset += length;
  }
  if (!any_text) fail("file", "holds no JSON chunk", hint);
}

void GltfDocument::check_extensions(const std::vector<std::string_view>& known) const {
  if (!root_.contains("extensionsRequired")) return;
  for (const Json& name : root_["extensionsRequired"]) {
    const std::string word = name.is_string() ? name.get<std::string>() : shown(name);
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    fail("extensionsRequired", "the extension " + in_quotes(word) + " is required and is not read",
         "export the model without it");
  }
}

void GltfDocument::fail(const std::string& where, const std::string& what,
                        const std::string& hint) const {
  throw InputError(files_.model(), where, what, hint);
}

std::size_t GltfDocument::count(const char* list) const {
  const auto it = root_.find(list);
  if (it == root_.end()) return 0;
  if (!it->is_array()) fail(list, "is not a list", "export the model again");
  return it->size();
}

const GltfDocument::Json& GltfDocument::entry(const char* list, std::size_t index,
                                              const std::string& user) const {
  if (index >= count(list))
    fail(user, "names " + at(list, index) + ", which is not there", "export the model again");
  const Json& value = root_[list][index];
  if (!value.is_object()) fail(at(list, index), "is not an object", "export the model again");
  return value;
}

double GltfDocument::real(const Json& object, const char* key, double none,
                          const std::string& where) const {
  const auto it = object.find(key);
  if (it == object.end()) return none;
  if (!it->is_number())
    fail(where + "." + key, "is " + shown(*it) + ", not a number", "write a number");
  return it->get<double>();
}

std::size_t GltfDocument::whole(const Json& object, const char* key, std::size_t none,
                                const std::string& where) const {
  const auto it = object.find(key);
  if (it == object.end()) return none;
  const double value = it->is_number() ? it->get<double>() : -1.0;
  if (value < 0.0 || value > 9e15 || value != std::floor(value))
    fail(where + "." + key, "is " + shown(*it) + ", not a whole number", "write one, from 0");
  return static_cast<std::size_t>(value);
}

std::size_t GltfDocument::need_whole(const Json& object, const char* key,
                                     const std::string& where) const {
  if (!object.contains(key)) fail(where, std::string("has no \"") + key + "\"", "add it");
  return whole(object, key, 0, where);
}

std::vector<double> GltfDocument::reals(const Json& object, const char* key,
                                        std::vector<double> none, const std::string& where) const {
  const auto it = object.find(key);
  if (it == object.end()) return none;
  std::vector<double> values;
  if (it->is_array()) {
    for (const Json& value : *it)
      if (value.is_number()) values.push_back(value.get<double>());
  }
  if (!it->is_array() || values.size() != it->size() || values.size() != none.size()) {
    fail(where + "." + key, "is " + shown(*it),
         "write a list of " + std::to_string(none.size()) + " numbers");
  }
  return values;
}

std::string GltfDocument::text(const Json& object, const char* key) const {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

const GltfDocument::Json* GltfDocument::extension(const Json& object, const char* name) const {
  const auto all = object.find("extensions");
  if (all == object.end() || !all->is_object()) return nullptr;
  const auto it = all->find(name);
  return it != all->end() && it->is_object() ? &*it : nullptr;
}

std::string_view GltfDocument::uri_bytes(const std::string& uri, const std::string& where) {
  if (uri.compare(0, 5, "data:") != 0) {
    const std::string path = ModelFiles::path_from(files_.model(), decode_percent(uri));
    return files_.read(path, {files_.model(), where});
  }
  const auto known = decoded_.find(where);
  if (known != decoded_.end()) return known->second;
  const std::size_t comma = uri.find(',');
  std::string bytes;
  if (comma == std::string::npos || uri.substr(0, comma).find(";base64") == std::string::npos ||
      !decode_base64(std::string_view(uri).substr(comma + 1), bytes))
    fail(where, "is a data URI that is not base64", "export the model again");
  return decoded_.emplace(where, std::move(bytes)).first->second;
}

std::string_view GltfDocument::part(std::string_view bytes, std::size_t offset, std::size_t length,
                                    const std::string& where) const {
  if (offset > bytes.size() || length > bytes.size() - offset) {
    fail(where,
         "reaches to byte " + std::to_string(offset + length) + " of " +
             std::to_string(bytes.size()),
         "export the model again");
  }
  return bytes.substr(offset, length);
}

std::string_view GltfDocument::buffer(std::size_t index, const std::string& user) {
  const Json& entry_of = entry("buffers", index, user);
  const std::string where = at("buffers", index);
  const std::size_t length = need_whole(entry_of, "byteLength", where);
  if (entry_of.contains("uri"))
    return part(uri_bytes(text(entry_of, "uri"), where + ".uri"), 0, length, where);
  if (index != 0 || !has_binary_) fail(where, "has no bytes", "add its \"uri\"");
  return part(binary_, 0, length, where);
}

std::string_view GltfDocument::decompressed(const Json& compression, std::size_t index,
                                            const std::string& where) {
  const auto known = decompressed_.find(index);
  if (known != decompressed_.end()) return known->second;
  const std::string_view source = part(buffer(need_whole(compression, "buffer", where), where),
                                       whole(compression, "byteOffset", 0, where),
                                       need_whole(compression, "byteLength", where), where);
  const std::size_t count = need_whole(compression, "count", where);
  const std::size_t stride = need_whole(compression, "byteStride", where);
  const std::string mode = text(compression, "mode"), filter = text(compression, "filter");
  constexpr std::size_t most = std::size_t{1} << 31;
  const bool triangles = mode == "TRIANGLES", indices = triangles || mode == "INDICES";
  const bool fine = stride > 0 && count <= most / stride &&
                    (indices ? (stride == 2 || stride == 4) && (!triangles || count % 3 == 0)
                             : mode == "ATTRIBUTES" && stride % 4 == 0 && stride <= 256);
  if (!fine) fail(where, "is compressed in a way that is not known", "export the model again");
  std::string bytes(count * stride, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(source.data());
  const int fault =
      triangles ? meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, source.size())
      : indices ? meshopt_decodeIndexSequence(bytes.data(), count, stride, from, source.size())
                : meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, source.size());
  if (fault != 0) fail(where, "cannot be decompressed", "export the model again");
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  else if (filter == "QUATERNION" && stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  else if (filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  else if (!filter.empty() && filter != "NONE")
    fail(where + ".filter", "is " + in_quotes(filter.substr(0, 40)) + ", which is not known",
         "export the model again");
  return decompressed_.emplace(index, std::move(bytes)).first->second;
}

std::string_view GltfDocument::buffer_view(std::size_t index, const std::string& user) {
  const Json& view = entry("bufferViews", index, user);
  const std::string where = at("bufferViews", index);
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (const Json* compression = extension(view, name))
      return decompressed(*compression, index, where + ".extensions." + name);
  }
  return part(buffer(need_whole(view, "buffer", where), where), whole(view, "byteOffset", 0, where),
              need_whole(view, "byteLength", where), where);
}

std::string_view GltfDocument::image(std::size_t index, const std::string& user) {
  const Json& entry_of = entry("images", index, user);
  const std::string where = at("images", index);
  if (entry_of.contains("bufferView"))
    return buffer_view(whole(entry_of, "bufferView", 0, where), where);
  const std::string uri = text(entry_of, "uri");
  if (uri.compare(0, 5, "data:") != 0) {
    const std::string path = ModelFiles::path_from(files_.model(), decode_percent(uri));
    if (uri.empty() || !ModelFiles::exists(path) || !files_.allowed(path)) return {};
  }
  return uri_bytes(uri, where + ".uri");
}

}  // namespace enfilade
