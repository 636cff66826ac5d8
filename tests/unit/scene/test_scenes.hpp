// Small scenes and texts that the tests of this room share.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.hpp"
#include "scene_file/scene_io.hpp"
#include "unit/source_files.hpp"

namespace enfilade {

inline std::string test_data(const std::string& name) {
  return source_file("tests/data/scene/" + name);
}

/// A folder in the test's temporary directory (tests/unit/main.cpp), gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int made = 0;
    path_ = ::testing::TempDir() + "folder" + std::to_string(made++);
    std::filesystem::create_directory(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_),
                                                  std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

/// What an InputError says, or "" where none is thrown.
template <class Action>
std::string input_error(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

inline std::string all_warnings(const Warnings& warnings) {
  std::string text;
  for (const Warning& w : warnings.all()) text += w.where + ": " + w.what + "\n";
  return text;
}

inline double total_area(const std::vector<Piece>& pieces) {
  double sum = 0.0;
  for (const Piece& piece : pieces) sum += area_m2(piece.polygon);
  return sum;
}

inline Surface grey_surface(Polygon vertices, double exitance = 0.0) {
  Surface surface;
  surface.vertices = std::move(vertices);
  surface.reflectance = {0.5};
  surface.exitance = {exitance};
  return surface;
}

}  // namespace enfilade
