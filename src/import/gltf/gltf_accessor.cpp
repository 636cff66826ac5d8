#include "import/gltf/gltf_accessor.hpp"

#include <cstring>
#include <limits>

#include "json/json_text.hpp"

namespace enfilade {
namespace {

using Json = GltfDocument::Json;

/// What glTF calls a component type: 5120 to 5126.
struct Component {
  std::size_t bytes = 0;
  bool is_signed = false, is_real = false;
};

Component component_of(const GltfDocument& document, std::size_t code, const std::string& where) {
  switch (code) {
    case 5120:
      return {1, true, false};
    case 5121:
      return {1, false, false};
    case 5122:
      return {2, true, false};
    case 5123:
      return {2, false, false};
    case 5125:
      return {4, false, false};
    case 5126:
      return {4, true, true};
    default:
      document.fail(where + ".componentType", "is " + std::to_string(code) + ", which is not known",
                    "export the model again");
  }
}

std::size_t width_of(const GltfDocument& document, const std::string& type,
                     const std::string& where) {
  for (const auto& [name, width] : {std::pair{"SCALAR", 1},
                                    {"VEC2", 2},
                                    {"VEC3", 3},
                                    {"VEC4", 4},
                                    {"MAT2", 4},
                                    {"MAT3", 9},
                                    {"MAT4", 16}}) {
    if (type == name) return static_cast<std::size_t>(width);
  }
  document.fail(where + ".type", "is " + in_quotes(type.substr(0, 40)) + ", which is not known",
                "export the model again");
}

template <class T>
double as(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double number_at(const char* at, const Component& c) {
  if (c.is_real) return as<float>(at);
  if (c.bytes == 1) return c.is_signed ? as<std::int8_t>(at) : as<std::uint8_t>(at);
  if (c.bytes == 2) return c.is_signed ? as<std::int16_t>(at) : as<std::uint16_t>(at);
  return as<std::uint32_t>(at);
}

class AccessorReader {
 public:
  AccessorReader(GltfDocument& document, std::size_t index, const std::string& user)
      : document_(document),
        accessor_(document.entry("accessors", index, user)),
        where_("accessors[" + std::to_string(index) + "]") {}

  GltfValues read() {
    component_ =
        component_of(document_, document_.need_whole(accessor_, "componentType", where_), where_);
    values_.width = width_of(document_, document_.text(accessor_, "type"), where_);
    values_.count = document_.need_whole(accessor_, "count", where_);
    constexpr std::size_t most = 200'000'000;
    if (values_.count > most / values_.width)
      document_.fail(where_, "has too many numbers", "split the model");
    const bool dense = accessor_.contains("bufferView");
    if (!dense) values_.numbers.resize(values_.count * values_.width);
    if (dense) {
      values_.numbers = numbers(document_.whole(accessor_, "bufferView", 0, where_),
                                document_.whole(accessor_, "byteOffset", 0, where_), component_,
                                values_.width, values_.count);
    }
    if (accessor_.contains("sparse")) replace_sparse(accessor_["sparse"]);
    if (accessor_.value("normalized", Json(false)) == true) normalise();
    return std::move(values_);
  }

 private:
  std::vector<double> numbers(std::size_t view, std::size_t offset, const Component& component,
                              std::size_t width, std::size_t count) {
    const std::string_view bytes = document_.buffer_view(view, where_);
    const std::size_t size = component.bytes * width;
    std::size_t stride =
        document_.whole(document_.entry("bufferViews", view, where_), "byteStride", 0, where_);
    if (stride == 0) stride = size;
    if (count > 0 && (offset > bytes.size() || size > bytes.size() - offset ||
                      (count - 1) > (bytes.size() - offset - size) / stride)) {
      document_.fail(where_, "reaches out of bufferViews[" + std::to_string(view) + "]",
                     "export the model again");
    }
    std::vector<double> read(count * width);
    for (std::size_t e = 0; e < count; ++e) {
      for (std::size_t i = 0; i < width; ++i)
        read[e * width + i] =
            number_at(bytes.data() + offset + e * stride + i * component.bytes, component);
    }
    return read;
  }

  void replace_sparse(const Json& sparse) {
    const std::string where = where_ + ".sparse";
    const std::size_t count = document_.need_whole(sparse, "count", where);
    if (!sparse.is_object() || !sparse.contains("indices") || !sparse.contains("values") ||
        count > values_.count)
      document_.fail(where, "is incomplete", "export the model again");
    const Json &indices = sparse["indices"], &values = sparse["values"];
    const Component whole = component_of(
        document_, document_.need_whole(indices, "componentType", where), where + ".indices");
    const std::vector<double> at =
        numbers(document_.need_whole(indices, "bufferView", where),
                document_.whole(indices, "byteOffset", 0, where), whole, 1, count);
    const std::vector<double> by =
        numbers(document_.need_whole(values, "bufferView", where),
                document_.whole(values, "byteOffset", 0, where), component_, values_.width, count);
    for (std::size_t e = 0; e < count; ++e) {
      if (!(at[e] >= 0.0 && at[e] < static_cast<double>(values_.count)))
        document_.fail(where + ".indices", "names an element that is not there",
                       "export the model again");
      for (std::size_t i = 0; i < values_.width; ++i)
        values_.numbers[static_cast<std::size_t>(at[e]) * values_.width + i] =
            by[e * values_.width + i];
    }
  }

  void normalise() {
    if (component_.is_real) return;
    const int bits = static_cast<int>(8 * component_.bytes) - (component_.is_signed ? 1 : 0);
    const double largest = static_cast<double>((std::uint64_t{1} << bits) - 1);
    for (double& x : values_.numbers) x = std::max(x / largest, -1.0);
  }

  GltfDocument& document_;
  const Json& accessor_;
  std::string where_;
  Component component_;
  GltfValues values_;
};

}  // namespace

GltfValues read_accessor(GltfDocument& document, std::size_t index, std::size_t width,
                         const std::string& user) {
  GltfValues values = AccessorReader(document, index, user).read();
  if (width != 0 && values.width != width) {
    document.fail(user,
                  "has elements of " + std::to_string(values.width) + " numbers, not " +
                      std::to_string(width),
                  "export the model again");
  }
  return values;
}

}  // namespace enfilade
