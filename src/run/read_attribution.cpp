#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "run/stats_json.hpp"

namespace enfilade {

namespace {

/// Picks the words under a few top-level keys, without keeping the surfaces of a large scene.
class TopLevelWords : public nlohmann::json_sax<nlohmann::json> {
 public:
  std::vector<std::string> lines;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool string(string_t& word) override {
    constexpr std::array keys{"source", "licence", "license", "attribution", "copyright", "author"};
    if (depth_ == 1 && std::find(keys.begin(), keys.end(), key_) != keys.end()) {
      lines.push_back(key_ + ": " + word);
    }
    return true;
  }
  bool start_object(std::size_t) override { return ++depth_ > 0; }
  bool end_object() override { return --depth_ >= 0; }
  bool start_array(std::size_t) override { return ++depth_ > 0; }
  bool end_array() override { return --depth_ >= 0; }
  bool key(string_t& key) override {
    if (depth_ == 1) key_ = key;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  int depth_ = 0;
  std::string key_;
};

}  // namespace

std::vector<std::string> read_attribution(const std::string& scene_text) {
  TopLevelWords words;
  nlohmann::json::sax_parse(scene_text, &words);
  return words.lines;
}

}  // namespace enfilade
