#include "schemes/protocol/gather_cost.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/posix_file.hpp"
#include "run/history.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = "ENFCOST9";

/// Where a file of costs belongs.
struct CostPlace {
  std::uint64_t run = 0;  ///< Manifest::run
  int iteration = 0;
  Rank rank;
};

/// The mark, run u64, iteration i32, rank i32; then what the rank did in that iteration; then
/// XXH64 of all that.
void put_head(ByteWriter& w, const CostPlace& place) {
  w.put_mark(mark);
  w.put(place.run);
  w.put(static_cast<std::int32_t>(place.iteration));
  w.put(place.rank);
}

/// Most figures of a gather are zero. Layout: their count modulo 8 as u8; a list of u8 with a bit
/// for each number, 1 where it is not zero; the list of those numbers.
void put_sparse(ByteWriter& w, std::span<const double> numbers) {
  std::vector<std::uint8_t> bits((numbers.size() + 7) / 8, 0);
  std::vector<double> other;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(numbers[i]) == 0) continue;
    bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | 1u << i % 8);
    other.push_back(numbers[i]);
  }
  w.put(static_cast<std::uint8_t>(numbers.size() % 8));
  w.put_all(bits);
  w.put_all(other);
}

[[noreturn]] void damaged_cost() {
  throw RunError("costs: damaged; solve it again, then replay it");
}

std::vector<double> get_sparse(ByteReader& r) {
  const auto beyond = r.get<std::uint8_t>();
  const auto bits = r.get_all<std::uint8_t>();
  const auto other = r.get_all<double>();
  if (beyond >= 8 || (beyond > 0 && bits.empty())) damaged_cost();
  std::vector<double> numbers(beyond > 0 ? 8 * (bits.size() - 1) + beyond : 8 * bits.size(), 0.0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if ((bits[i / 8] >> i % 8 & 1) == 0) continue;
    if (next == other.size()) damaged_cost();
    numbers[i] = other[next++];
  }
  if (next != other.size()) damaged_cost();
  return numbers;
}

void put_cost(ByteWriter& w, const GatherCost& cost) {
  const FoldedNumbers numbers = to_numbers(cost.figures);
  w.put(cost.cluster);
  put_sparse(w, numbers.maxima);
  put_sparse(w, numbers.sums);
  w.put(cost.patches);
  w.put(cost.links_changed);
  if (cost.links_changed) w.put(cost.links);
  w.put(cost.as_before);
  if (cost.as_before) return;
  w.put_all(cost.coupled.words());
  w.put_all(cost.read);
}

/// Reads a flag; throws RunError for a byte other than 0 or 1.
bool get_flag(ByteReader& r) {
  const auto byte = r.get<std::uint8_t>();
  if (byte > 1) damaged_cost();
  return byte == 1;
}

GatherCost get_cost(ByteReader& r) {
  GatherCost cost;
  cost.cluster = r.get<ClusterId>();
  const std::vector<double> maxima = get_sparse(r), sums = get_sparse(r);
  cost.figures = figures_from(maxima, sums);
  cost.patches = r.get<SectionWeight>();
  cost.links_changed = get_flag(r);
  if (cost.links_changed) cost.links = r.get<SectionWeight>();
  cost.as_before = get_flag(r);
  if (cost.as_before) return cost;
  std::vector<std::uint64_t> coupled = r.get_all<std::uint64_t>();
  if (coupled.size() > CoupledPlaces::most_words) damaged_cost();
  cost.coupled = CoupledPlaces::of(std::move(coupled));
  cost.read = r.get_all<ClusterId>();
  return cost;
}

std::vector<std::string> files_of(const fs::path& directory) {
  std::vector<std::string> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(directory, missing)) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void incomplete(const std::string& run_directory, const std::string& what) {
  throw InputError(run_directory, "costs", what, "solve it again, then replay it");
}

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  throw RunError(path + ": is " + what + "; solve it again, then replay it");
}

/// Returns the bytes without their checksum. Throws RunError where they are damaged.
std::span<const std::byte> unsealed(std::span<const std::byte> bytes, const std::string& path) {
  std::uint64_t sum = 0;
  if (bytes.size() < sizeof sum) damaged(path, "cut off");
  const auto body = bytes.first(bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + body.size(), sizeof sum);
  if (sum != checksum(body)) damaged(path, "damaged (checksum)");
  return body;
}

void expect_head(ByteReader& r, const std::string& path, const CostPlace& place) {
  r.expect(mark);
  const auto run = r.get<std::uint64_t>();
  const auto iteration = r.get<std::int32_t>();
  const auto rank = r.get<Rank>();
  if (run != place.run) damaged(path, "of another run");
  if (iteration != place.iteration) damaged(path, "of another iteration");
  if (fs::path(path).filename() != "rank-" + std::to_string(rank.value))
    damaged(path, "of another rank");
}

/// Reads all ranks' files of an iteration; `take` reads one cluster's part and returns its id.
template <class Take>
void read_iteration(const std::string& run_directory, const CostPlace& place, std::size_t clusters,
                    IterationMethod& method, Take take) {
  std::vector<bool> seen(clusters, false);
  const std::string iteration = std::to_string(place.iteration);
  for (const std::string& path : files_of(run_directory + "/costs/" + iteration)) {
    const std::vector<std::byte> bytes = read_file(path);
    ByteReader r(unsealed(bytes, path), path);
    expect_head(r, path, place);
    method.coarse_correction = get_flag(r);
    method.jacobi = get_flag(r);
    for (auto n = r.get<std::uint64_t>(); n > 0; --n) {
      const ClusterId cluster = take(r);
      if (cluster.index() >= clusters) incomplete(run_directory, "is of another scene");
      if (seen[cluster.index()]) incomplete(run_directory, "has a gather twice: " + path);
      seen[cluster.index()] = true;
    }
    r.expect_end();
  }
  if (std::find(seen.begin(), seen.end(), false) != seen.end()) {
    incomplete(run_directory, "lacks gathers of iteration " + iteration);
  }
}

}  // namespace

ClusterWeight Recording::weight(ClusterId cluster, int iteration) const {
  ClusterWeight weight = start[cluster.index()];
  if (iteration == 0) return weight;
  const GatherCost& cost = gathers[static_cast<std::size_t>(iteration) - 1][cluster.index()];
  weight.patches = cost.patches;
  weight.links = cost.links;
  return weight;
}

void CostRecorder::add_start(const ClusterState& state) {
  ClusterWeight weight;
  weight.geometry = {state.patches().polygons(), state.bytes_of(Section::geometry).size(), 0};
  weight.patches = {state.patches().size(), state.bytes_of(Section::patches).size(),
                    state.memory_bytes()};
  weight.links = {0, state.bytes_of(Section::links).size(), 0};  // none yet
  start_.emplace_back(state.id(), weight);
}

/// Most gathers of later iterations read what they read before: that is kept once.
void CostRecorder::add(GatherCost cost) {
  const std::uint64_t sum = checksum(std::as_bytes(std::span(cost.coupled.words()))) ^
                            std::rotl(checksum(std::as_bytes(std::span(cost.read))), 1);
  auto& [iteration, last_sum] = last_[cost.cluster];
  if (iteration_ > 1 && iteration == iteration_ - 1 && last_sum == sum) {
    cost.as_before = true;
    cost.coupled = {};
    cost.read = {};
  }
  iteration = iteration_;
  last_sum = sum;
  gathers_.push_back(std::move(cost));
}

void CostRecorder::write(int iteration) {
  iteration_ = iteration + 1;
  ByteWriter w;
  put_head(w, {run_, iteration, rank_});
  w.put(method_.coarse_correction);
  w.put(method_.jacobi);
  if (iteration == 0) {
    w.put(static_cast<std::uint64_t>(start_.size()));
    for (const auto& [cluster, weight] : start_) {
      w.put(cluster);
      w.put(weight);
    }
  } else {
    w.put(static_cast<std::uint64_t>(gathers_.size()));
    for (const GatherCost& cost : gathers_) put_cost(w, cost);
  }
  start_.clear();
  gathers_.clear();
  w.put(checksum(w.bytes()));
  const std::string directory = directory_ + std::to_string(iteration);
  make_directory(directory);
  write_file(directory + "/rank-" + std::to_string(rank_.value), w.take(), {});
}

void drop_costs(const std::string& run_directory, int committed) {
  for (const std::string& path : files_of(run_directory + "/costs")) {
    if (std::atoi(fs::path(path).filename().c_str()) > committed) remove_directory(path);
  }
}

static void take_bands(Recording& recording, const std::string& run_directory) {
  if (recording.gathers.empty()) return;
  const auto bands_of = [](const GatherCost& cost) { return cost.figures.absorbed_power.size(); };
  recording.bands = bands_of(recording.gathers.front().front());
  for (const auto& gathers : recording.gathers) {
    for (const GatherCost& cost : gathers)
      if (bands_of(cost) != recording.bands)
        incomplete(run_directory, "has gathers of other bands");
  }
}

Recording read_recording(const std::string& run_directory, std::size_t clusters) {
  const auto manifest = read_manifest(RunLayout(run_directory));
  if (!manifest || !manifest->finished) {
    throw InputError(run_directory, "--replay", "not a run that was solved to its end",
                     "solve it first, or go on with it by --resume");
  }
  committed_manifest(RunLayout(run_directory));  // of what RUN is prepared for
  if (!files_of(run_directory + "/costs/" + std::to_string(manifest->iteration + 1)).empty())
    incomplete(run_directory, "has gathers after the committed iteration");
  Recording recording;
  recording.history = history_of(manifest);
  recording.basis = manifest->basis;
  recording.hierarchy = manifest->hierarchy;
  recording.start.resize(clusters);
  read_iteration(run_directory, {manifest->run, 0, {}}, clusters, recording.method,
                 [&](ByteReader& r) {
                   const auto id = r.get<ClusterId>();
                   const auto weight = r.get<ClusterWeight>();
                   if (id.index() < clusters) recording.start[id.index()] = weight;
                   return id;
                 });
  for (int k = 1; k <= manifest->iteration; ++k) {
    auto& gathers = recording.gathers.emplace_back(clusters);
    read_iteration(run_directory, {manifest->run, k, {}}, clusters, recording.method,
                   [&](ByteReader& r) {
                     GatherCost cost = get_cost(r);
                     const ClusterId id = cost.cluster;
                     if (id.index() >= clusters) return id;
                     if (cost.as_before) {
                       if (k == 1) incomplete(run_directory, "is damaged");
                       const GatherCost& before =
                           recording.gathers[static_cast<std::size_t>(k) - 2][id.index()];
                       cost.coupled = before.coupled;
                       cost.read = before.read;
                     }
                     for (const ClusterId read : cost.read) {
                       if (read.index() >= clusters)
                         incomplete(run_directory, "is of another scene");
                     }
                     if (!cost.links_changed) cost.links = recording.weight(id, k - 1).links;
                     gathers[id.index()] = std::move(cost);
                     return id;
                   });
  }
  take_bands(recording, run_directory);
  return recording;
}

}  // namespace enfilade
