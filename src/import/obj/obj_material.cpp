#include "import/obj/obj_material.hpp"

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "import/intake/text_lines.hpp"
#include "import/intake/texture_mean.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

class LibraryReader {
 public:
  LibraryReader(ModelFiles& files, Warnings& warnings,
                std::map<std::string, ModelMaterial>& materials)
      : files_(files), warnings_(warnings), materials_(materials) {}

  void read(TextLines lines) {
    while (lines.next()) {
      const std::string_view key = lines.words()[0];
      if (key == "newmtl") {
        finish();
        begin(lines);
      } else if (!open_) {
        lines.fail(in_quotes(std::string(key.substr(0, 40))) + " stands before any newmtl",
                   "begin each material with newmtl and its name");
      } else {
        read_property(lines, key);
      }
    }
    finish();
  }

 private:
  struct Draft {
    Spectrum diffuse, emission{0.0, 0.0, 0.0};
    std::array<double, 3> texture{1.0, 1.0, 1.0}, emission_texture{1.0, 1.0, 1.0};
    double opacity = 1.0;
    bool bright_ambient = false;
  };

  void begin(const TextLines& lines) {
    name_ = lines.rest();
    open_ = true;
    where_ = "material " + in_quotes(name_);
    draft_ = {};
  }

  void read_property(const TextLines& lines, std::string_view key) {
    if (key == "Kd") {
      draft_.diffuse = colour(lines);
    } else if (key == "Ke") {
      draft_.emission = colour(lines);
    } else if (key == "Ka") {
      const Spectrum ambient = colour(lines);
      draft_.bright_ambient = *std::max_element(ambient.begin(), ambient.end()) > 1.0;
    } else if (key == "d") {
      draft_.opacity = lines.real(lines.words().size() - 1);  // "d -halo 0.5" as well
    } else if (key == "Tr") {
      draft_.opacity = 1.0 - lines.real(1);
    } else if (key == "map_Kd") {
      draft_.texture = texture(lines);
    } else if (key == "map_Ke") {
      draft_.emission_texture = texture(lines);
    } else if (key == "map_d") {
      warnings_.add(where_, "map_d is not carried out: d alone says what light passes");
    }
  }

  Spectrum colour(const TextLines& lines) {
    if (lines.words().size() > 1 && (lines.words()[1] == "spectral" || lines.words()[1] == "xyz")) {
      lines.fail("a colour by " + std::string(lines.words()[1]) + " is not read",
                 "write it as red, green and blue");
    }
    const double red = lines.real(1);
    const bool grey = lines.words().size() == 2;
    Spectrum bands{red, grey ? red : lines.real(2), grey ? red : lines.real(3)};
    for (const double band : bands) {
      if (band < 0.0) lines.fail("a colour is below zero", "write 0 or more");
    }
    return bands;
  }

  std::array<double, 3> texture(const TextLines& lines) {
    constexpr std::array<double, 3> none{1.0, 1.0, 1.0};
    const std::string name = texture_name(lines);
    const std::string path = ModelFiles::path_from(lines.file(), name);
    if (name.empty() || !ModelFiles::exists(path)) {
      warnings_.add(where_, "texture " + in_quotes(name) + " does not exist: left out");
      return none;
    }
    if (!files_.allowed(path)) {
      warnings_.add(where_,
                    "texture " + in_quotes(name) +
                        " lies outside the model's folder: left out (--allow-outside reads it)");
      return none;
    }
    const std::optional<TextureMean> mean =
        texture_mean(files_.read(path, {lines.file(), lines.where()}));
    if (mean) return mean->srgb;
    warnings_.add(where_, "texture " + in_quotes(name) + " cannot be decoded: left out");
    return none;
  }

  /// What stands behind the options, each of which begins with a minus sign.
  static std::string texture_name(const TextLines& lines) {
    std::size_t first = 1;
    const auto is_number = [&](std::size_t i) {
      return lines.words()[i].find_first_not_of("0123456789.+-eE") == std::string_view::npos;
    };
    while (first + 1 < lines.words().size() && lines.words()[first].size() > 1 &&
           lines.words()[first][0] == '-') {
      const bool numbers = is_number(first + 1);
      for (first += numbers ? 1 : 2;
           numbers && first + 1 < lines.words().size() && is_number(first);)
        ++first;
    }
    return lines.file_name_from(first);
  }

  void finish() {
    if (!open_) return;
    ModelMaterial material;
    material.name = name_;
    material.open = draft_.opacity < 0.5;
    if (draft_.bright_ambient) {
      warnings_.add(where_,
                    "Ka above 1 is no light that is given off: where it is a lamp, write Ke");
    }
    if (draft_.diffuse.empty()) {
      warnings_.add(where_, "has no Kd: reflectance taken as 0.5");
      draft_.diffuse = {0.5, 0.5, 0.5};
    }
    for (std::size_t i = 0; i < 3; ++i) {
      draft_.diffuse[i] *= draft_.texture[i];
      material.exitance[i] =
          std::numbers::pi * std::max(0.0, draft_.emission[i]) * draft_.emission_texture[i];
    }
    material.reflectance = reflectance_of(draft_.diffuse, where_, warnings_);
    materials_[name_] = std::move(material);
    open_ = false;
  }

  ModelFiles& files_;
  Warnings& warnings_;
  std::map<std::string, ModelMaterial>& materials_;
  bool open_ = false;  ///< a material is being read
  std::string name_, where_;
  Draft draft_;
};

}  // namespace

void read_obj_materials(const std::string& path, ModelFiles& files, const ModelFiles::Place& place,
                        Warnings& warnings, std::map<std::string, ModelMaterial>& materials) {
  LibraryReader(files, warnings, materials).read(TextLines(path, files.read_text(path, place)));
}

}  // namespace enfilade
