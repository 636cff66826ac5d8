// RUN/lock: no two commands write one RUN at once, and none reads it while it is written.
#pragma once

#include <string>

namespace enfilade {

/// A lock of the operating system on the file RUN/lock (fcntl's, which NFS keeps as well): it ends
/// with the process that holds it, however that dies. The file itself stays. Where the file system
/// keeps no locks, nothing is locked, and fault() says so.
class RunLock {
 public:
  RunLock() = default;
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Locks an existing RUN to write, once, and removes unfinished files of commands that died.
  /// Readers, and ranks of a run that died, get some seconds to end. Throws InputError where they
  /// do not, or another process writes.
  void write(const std::string& run_directory);
  /// Locks a RUN to read it. Throws InputError where another process writes.
  void read(const std::string& run_directory);
  /// Locks the RUN for one rank of the run that another process has locked to write: the run counts
  /// as alive as long as one of its ranks is.
  void join(const std::string& run_directory);

  /// Why nothing is locked; empty where all is well.
  const std::string& fault() const { return fault_; }

 private:
  void open(const std::string& run_directory, int flags);
  bool take(short type, int place, int seconds);
  void let_go(int place);

  int fd_ = -1;
  bool writes_ = false;
  std::string fault_;
};

}  // namespace enfilade
