// The JSON of a glTF file and the bytes that it names.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "json/model_files.hpp"

namespace enfilade {

/// Values of the JSON with their keys checked: an error names the key, as in `nodes[3].mesh`.
class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// Splits a .glb; checks version 2 and that every extension which the file requires is one of
  /// `known`. Throws InputError.
  GltfDocument(ModelFiles& files, const std::vector<std::string_view>& known);

  [[noreturn]] void fail(const std::string& where, const std::string& what,
                         const std::string& hint) const;
  const Json& root() const { return root_; }
  /// Returns entry `index` of the list under a key of the root, such as "meshes". Fails where it is
  /// not there, and names `user`, which asked for it.
  const Json& entry(const char* list, std::size_t index, const std::string& user) const;
  std::size_t count(const char* list) const;

  /// Values of an object under `key`, or what is to be taken where there is none. They fail where
  /// the value is of another kind.
  double real(const Json& object, const char* key, double none, const std::string& where) const;
  std::size_t whole(const Json& object, const char* key, std::size_t none,
                    const std::string& where) const;
  /// Fails where there is none.
  std::size_t need_whole(const Json& object, const char* key, const std::string& where) const;
  std::vector<double> reals(const Json& object, const char* key, std::vector<double> none,
                            const std::string& where) const;
  std::string text(const Json& object, const char* key) const;
  /// Returns the extension of an object; null where it has none of that name.
  const Json* extension(const Json& object, const char* name) const;

  /// Returns the bytes of a buffer, a buffer view or an image; of an image none where its file is
  /// missing or may not be read.
  std::string_view buffer(std::size_t index, const std::string& user);
  std::string_view buffer_view(std::size_t index, const std::string& user);
  std::string_view image(std::size_t index, const std::string& user);

 private:
  void split_binary(const std::string& bytes);
  void check_extensions(const std::vector<std::string_view>& known) const;
  std::string_view uri_bytes(const std::string& uri, const std::string& where);
  std::string_view part(std::string_view bytes, std::size_t offset, std::size_t length,
                        const std::string& where) const;
  std::string_view decompressed(const Json& compression, std::size_t index,
                                const std::string& where);

  ModelFiles& files_;
  Json root_;
  std::string_view binary_;  ///< of a .glb
  bool has_binary_ = false;
  std::map<std::string, std::string> decoded_;       ///< data URIs, by the key that holds them
  std::map<std::size_t, std::string> decompressed_;  ///< buffer views
};

}  // namespace enfilade
