// The costs of a RUN, as if their checksums were right: any bytes give a recording that a replay
// can go through, or an error. The input is what rank 0 wrote of the clusters at the start and of
// two iterations, after the heads of its files; a u16 before the first and the second tells its
// bytes.
#include <cmath>

#include "base/atomic_file.hpp"
#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "fuzz_target.hpp"
#include "run/manifest.hpp"
#include "run/run_mark.hpp"
#include "schemes/protocol/gather_cost.hpp"

namespace enfilade {
namespace {

constexpr std::size_t clusters = 8;
constexpr int iterations = 2;
constexpr std::uint64_t run = 1;

/// A RUN that was solved to its end, without its costs.
struct SolvedRun {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("enfilade-costs-fuzz-" + std::to_string(::getpid()));
  SolvedRun() {
    for (int k = 0; k <= iterations; ++k)
      std::filesystem::create_directories(path / "costs" / std::to_string(k));
    std::filesystem::create_directories(path / "common");
    RunMark mark;
    mark.prepared = true;
    write_run_mark(path.string(), mark);
    Manifest manifest;
    manifest.iteration = iterations;
    manifest.clusters = clusters;
    manifest.preparation = mark.preparation();
    manifest.run = run;
    manifest.finished = true;
    manifest.history.assign(iterations, to_numbers(IterationSummary{}));
    commit_manifest(RunLayout(path.string()), manifest);
  }
  ~SolvedRun() { std::filesystem::remove_all(path); }

  void put_costs(int iteration, std::span<const std::byte> bytes) const {
    ByteWriter w;
    w.put_mark("ENFCOST9");
    w.put(run);
    w.put(static_cast<std::int32_t>(iteration));
    w.put(Rank{0});
    for (const std::byte byte : bytes) w.put(byte);
    w.put(checksum(w.bytes()));
    const auto file = path / "costs" / std::to_string(iteration) / "rank-0";
    std::ofstream(file, std::ios::binary).write(w.text().data(), std::ssize(w.bytes()));
  }
};

void check(const Recording& recording) {
  fuzz::require(recording.start.size() == clusters);
  IterationFigures sum;
  for (const auto& gathers : recording.gathers) {
    fuzz::require(gathers.size() == clusters);
    for (const GatherCost& cost : gathers) {
      fuzz::require(cost.figures.absorbed_power.size() == recording.bands);
      fuzz::require(std::isfinite(cost.figures.received_power));
      for (const ClusterId id : cost.read) fuzz::require(id.index() < clusters);
      add(sum, cost.figures);
    }
  }
}

}  // namespace
}  // namespace enfilade

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  static const SolvedRun solved;
  auto rest = std::as_bytes(std::span(data, size));
  for (int k = 0; k <= iterations; ++k) {
    std::size_t bytes = rest.size();
    if (k < iterations && bytes >= 2) {
      bytes = std::to_integer<std::size_t>(rest[0]) | std::to_integer<std::size_t>(rest[1]) << 8;
      rest = rest.subspan(2);
      bytes = std::min(bytes, rest.size());
    }
    solved.put_costs(k, rest.first(bytes));
    rest = rest.subspan(bytes);
  }
  fuzz::tells_what_was_read = true;
  fuzz::was_read = false;
  try {
    check(read_recording(solved.path.string(), clusters));
    fuzz::was_read = true;
  } catch (const InputError&) {
  } catch (const RunError&) {
  }
  return 0;
}
