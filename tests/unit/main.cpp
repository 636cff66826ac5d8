// Runs the tests of a room. ctest runs many at once, so each process has a temporary directory of
// its own, gone at the end.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string directory =
      (std::filesystem::temp_directory_path() / "enfilade_tests_XXXXXX").string();
  if (mkdtemp(directory.data()) == nullptr) return 1;
  setenv("TEST_TMPDIR", (directory + "/").c_str(), 1);
  const int result = RUN_ALL_TESTS();
  std::filesystem::remove_all(directory);
  return result;
}
