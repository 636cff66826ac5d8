// Runs a fuzz target over every file of a corpus, so that what fuzzing has found stays mended, and
// over random changes of these files: replay CORPUS CHANGES. Fails where a file that is called
// faulty_NAME is taken, or another one refused, if the target tells (was_read).
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "base/random.hpp"
#include "fuzz_target.hpp"

namespace {

using enfilade::Random;

void try_bytes(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// One to four changes: a bit turned, a byte replaced, a piece left out, or one of another file put
/// in.
std::string changed(std::string bytes, const std::string& other, Random& random) {
  for (std::uint64_t left = 1 + random.below(4); left > 0 && !bytes.empty(); --left) {
    const auto at = static_cast<std::size_t>(random.below(bytes.size()));
    const auto length = static_cast<std::size_t>(1 + random.below(16));
    switch (random.below(4)) {
      case 0:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        break;
      case 1:
        bytes[at] = static_cast<char>(random.below(256));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      default:
        bytes.insert(at, other, static_cast<std::size_t>(random.below(other.size() + 1)), length);
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  bool as_named = true;
  for (const std::filesystem::path& path : files) {
    std::puts(path.filename().c_str());
    std::fflush(stdout);  // a crash leaves the name as the last line
    std::ifstream in(path, std::ios::binary);
    corpus.emplace_back((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    try_bytes(corpus.back());
    if (!enfilade::fuzz::tells_what_was_read) continue;
    const bool faulty = path.filename().string().rfind("faulty_", 0) == 0;
    if (enfilade::fuzz::was_read == faulty) {
      std::puts(faulty ? "taken, though it is faulty"
                       : "refused: made for another version of its format?");
      as_named = false;
    }
  }
  const long changes = std::strtol(argv[2], nullptr, 10);
  for (long i = 0; i < changes && !corpus.empty(); ++i) {
    std::printf("\rchange %ld", i);  // the seed of its random numbers
    std::fflush(stdout);
    Random random(static_cast<std::uint64_t>(i));
    const std::string& file = corpus[random.below(corpus.size())];
    try_bytes(changed(file, corpus[random.below(corpus.size())], random));
  }
  return files.empty() || !as_named ? 1 : 0;
}
