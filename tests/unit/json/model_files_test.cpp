#include "json/model_files.hpp"

#include <sys/stat.h>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

std::string refusal(ModelFiles& files, const std::string& path) {
  return input_error([&] { files.read(path, {files.model(), "line 3"}); });
}

TEST(ModelFiles, ReadBelowTheModelsFolderAlone) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("house"));
  std::filesystem::create_directory(folder.file("house/parts"));
  folder.write("secret.txt", "hidden");
  folder.write("house/parts/door.bin", "door");
  const std::string model = folder.write("house/model.x", "model");
  std::filesystem::create_symlink(folder.file("secret.txt"), folder.file("house/link.txt"));
  ModelFiles files(model, false);
  EXPECT_EQ(files.read_model(), "model");
  EXPECT_EQ(files.read(ModelFiles::path_from(model, "parts/door.bin"), {model, "x"}), "door");
  EXPECT_EQ(files.read(ModelFiles::path_from(model, "parts/../parts/door.bin"), {model, "x"}),
            "door");
  for (const char* name : {"../secret.txt", "parts/../../secret.txt", "/etc/passwd", "link.txt"}) {
    const std::string path = ModelFiles::path_from(model, name);
    EXPECT_FALSE(files.allowed(path)) << name;
    const std::string error = refusal(files, path);
    EXPECT_THAT(error, HasSubstr("lies outside the model's folder")) << name;
    EXPECT_THAT(error, HasSubstr("model.x: line 3: ")) << name;
    EXPECT_THAT(error, testing::Not(HasSubstr("hidden"))) << name;
  }
  ModelFiles open(model, true);
  EXPECT_EQ(open.read(ModelFiles::path_from(model, "../secret.txt"), {model, "x"}), "hidden");
}

TEST(ModelFiles, OnlyRegularFilesAreRead) {
  const TemporaryFolder folder;
  const std::string model = folder.write("model.x", "model");
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  folder.write("empty", "");
  std::filesystem::create_directory(folder.file("below"));
  ModelFiles files(model, false);
  EXPECT_THAT(refusal(files, folder.file("pipe")), HasSubstr("is no regular file"));
  EXPECT_THAT(refusal(files, folder.file("gone")), HasSubstr("does not exist"));
  EXPECT_THAT(refusal(files, folder.file("below")), HasSubstr("is a directory"));
  EXPECT_THAT(refusal(files, folder.file("empty")), HasSubstr("is empty"));
  ModelFiles device("/dev/zero", false);
  EXPECT_THAT(input_error([&] { device.read_model(); }),
              HasSubstr("/dev/zero: file: is no regular file"));
}

}  // namespace
}  // namespace enfilade
