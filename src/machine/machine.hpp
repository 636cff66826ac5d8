// The machine that a rank runs on: the real one, or a host of a simulated cluster. Here alone
// counted work and bytes become time. real.cpp and smpi.cpp implement it; an executable links one
// of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/run_record.hpp"
#include "base/work_count.hpp"
#include "machine/phase_profile.hpp"

namespace enfilade {

struct CostModel;

/// Where bytes live: the common directory (NFS, shared by all ranks) or the rank's local directory.
enum class Disk { common, local };

/// Seconds that a rank spent, by phase: io = reading, writing and moving files; idle = waiting for
/// stolen work, for other ranks and for the token.
struct TimeUse {
  double compute_s = 0.0, io_s = 0.0, idle_s = 0.0;
};

/// What a section of a cluster's file holds; `bytes` is its true size.
struct RecordCount {
  std::uint64_t surfaces = 0, patches = 0, links = 0;
  std::uint64_t bytes = 0;
};

/// Of a rank. "Real" and "simulated" below say what `real.cpp` and `smpi.cpp` do; the verbs and
/// values here are all that the rest of the program sees of the difference.
class Machine {
 public:
  virtual ~Machine() = default;
  /// Counted work was done. Real: nothing, it took its time. Simulated: charges flops by the cost
  /// model.
  virtual void compute(const WorkCount& work) = 0;
  /// The same; `listen` is called at the end. Where time passes only by charges, the work is
  /// charged in parts, and `listen` is called after each, as if the rank had paused in the midst of
  /// it.
  void compute_in_parts(const WorkCount& work, const std::function<void()>& listen);
  /// Called after the real bytes of file number `file` moved. Real: nothing. Simulated: charges
  /// disk, queue and wire.
  virtual void read(Disk disk, std::uint64_t file, std::uint64_t bytes) = 0;
  virtual void write(Disk disk, std::uint64_t file, std::uint64_t bytes) = 0;
  /// Moves a file from the local to the common directory: a renaming where both lie on one disk,
  /// else a copy.
  virtual void move_to_common(std::uint64_t file, std::uint64_t bytes) = 0;
  /// Returns the size that a section counts for, on the disk and in memory: its own, or (simulated)
  /// that of the records of the modelled program.
  virtual std::uint64_t record_bytes(const RecordCount& count) const = 0;

  /// Returns the memory of the host that a rank may use, in bytes; 0 = not known, no limit.
  virtual std::uint64_t memory_bytes() const = 0;
  /// Returns the most memory that this rank has used, in bytes. Real: as measured of its process.
  /// Simulated: `counted_bytes`, what the caller counted, since all ranks share one process.
  virtual std::uint64_t peak_memory_bytes(std::uint64_t counted_bytes) const {
    return counted_bytes;
  }
  /// Gives memory that was freed back to the system. Real: malloc_trim. Simulated: nothing, memory
  /// is counted and not measured.
  virtual void return_freed_memory() {}

  /// Returns the seconds since the start: wall clock, or simulated.
  virtual double now_s() const = 0;
  /// True where time passes by itself, as on a wall clock (real), and not only by charges
  /// (simulated).
  virtual bool time_passes_by_itself() const = 0;
  /// Lets the time charged so far pass, before a message to other ranks. Real: does nothing.
  virtual void settle() {}
  /// Waits between two polls for messages; `turn` counts the polls in vain, so that waiting can
  /// back off.
  virtual void pause(int turn) = 0;
  /// Waits for a message. Real: calls `poll` until it returns true, with pauses in between that
  /// leave the core to others. Simulated: calls `block`, which waits by itself, until it returns
  /// true; a rank that waits takes nothing but simulated time.
  virtual void wait_for_message(const std::function<bool()>& poll,
                                const std::function<bool()>& block);

  /// Returns the name of the host that this rank runs on.
  virtual std::string host() const = 0;
  /// Adds what only this machine can tell of a run to its record, on rank 0; `longest_s` is the
  /// longest time, by now_s(), that a rank took. Simulated: `simulated_s`. Real: nothing.
  virtual void describe(RunRecord& record, double longest_s) const;

  /// Begins `phase`, to which time belongs from now on. Returns the phase before.
  Phase enter(Phase phase);
  /// Returns the seconds so far, by phase.
  std::array<double, phase_count> seconds() const;
  TimeUse time_use() const;

  /// Begins to keep the phases over time.
  void trace();
  /// Returns the phases since trace(), over now_s(); nothing without it.
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

/// All ranks of a run are threads of one process and share its address space and its exit status:
/// simulated ones. Else each rank is a process.
bool ranks_share_a_process();
/// A real machine has no use for the costs.
std::unique_ptr<Machine> make_machine(const CostModel& costs);

}  // namespace enfilade
