// The machine that a rank runs on: the real one, or a host of a simulated cluster. The one place
// where work and bytes become time. `real` and `smpi` implement it; an executable links exactly one
// of them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/work_count.hpp"
#include "machine/phase_profile.hpp"

namespace enfilade {

/// Where bytes live: the common directory (NFS, shared by all ranks) or the rank's local directory.
enum class Disk { common, local };

/// Seconds that a rank spent, by what it did: io = reading, writing and moving files; idle =
/// waiting for stolen work, for the others and for the token.
struct TimeUse {
  double compute_s = 0.0, io_s = 0.0, idle_s = 0.0;
};

/// What a section of a cluster's file holds; `bytes` is its true size.
struct RecordCount {
  std::uint64_t surfaces = 0, patches = 0, links = 0;
  std::uint64_t bytes = 0;
};

class Machine {
 public:
  virtual ~Machine() = default;
  /// Real: nothing, the work took its time. Simulated: flops by the cost model.
  virtual void compute(const WorkCount& work) = 0;
  /// Called after the real bytes of file number `file` moved. Real: nothing. Simulated: disk, queue
  /// and wire.
  virtual void read(Disk disk, std::uint64_t file, std::uint64_t bytes) = 0;
  virtual void write(Disk disk, std::uint64_t file, std::uint64_t bytes) = 0;
  /// From the local to the common directory: a renaming where both lie on one disk, else a copy.
  virtual void move_to_common(std::uint64_t file, std::uint64_t bytes) = 0;
  /// The size that a section counts for, on the disk and in memory: its own, or (simulated) that of
  /// the records of the modelled program.
  virtual std::uint64_t record_bytes(const RecordCount& count) const = 0;
  /// Memory of the host that a rank may use; 0 = not known, no limit.
  virtual std::uint64_t memory_bytes() const = 0;
  /// Gives memory that was freed back to the system. Real: malloc_trim. Simulated: nothing, memory
  /// is counted and not measured.
  virtual void return_freed_memory() {}
  /// Before others hear of this rank: what was charged so far has passed. Real: nothing.
  virtual void settle() {}
  /// Seconds since the start: wall clock, or simulated.
  virtual double now_s() const = 0;
  /// Between two looks at the messages; `turn` counts the looks in vain, so that waiting can back
  /// off.
  virtual void pause(int turn) = 0;
  virtual bool simulated() const = 0;
  /// Name of the host that this rank runs on.
  virtual std::string host() const = 0;

  /// From now on, time belongs to `phase`. Returns the phase before.
  Phase enter(Phase phase);
  /// Seconds so far, by phase.
  std::array<double, phase_count> seconds() const;
  TimeUse time_use() const;

  /// From now on, what is done when is kept.
  void trace();
  /// What was done since trace(), over now_s(); nothing without it.
  std::optional<PhaseProfile> profile() const;

 private:
  std::array<double, phase_count> seconds_{};
  Phase phase_ = Phase::compute;
  double since_s_ = 0.0;
  std::optional<PhaseProfile> profile_;
};

/// Time belongs to a phase until the end of the scope.
class PhaseScope {
 public:
  PhaseScope(Machine& machine, Phase phase) : machine_(machine), before_(machine.enter(phase)) {}
  ~PhaseScope() { machine_.enter(before_); }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  Machine& machine_;
  Phase before_;
};

/// What Machine::simulated() will say, before there is one.
bool machines_are_simulated();
/// `cost_model_file` empty = the default of the build. Throws InputError for a bad file.
std::unique_ptr<Machine> make_machine(const std::string& cost_model_file);

}  // namespace enfilade
