// The cluster files of a slave: messages to the master, which alone reads and writes files.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "base/error.hpp"
#include "machine/machine.hpp"
#include "schemes/protocol/messages.hpp"
#include "store/cluster_files.hpp"

namespace enfilade {

class RemoteFiles final : public ClusterFiles {
 public:
  /// Both must outlive it.
  RemoteFiles(Communicator& communicator, Machine& machine)
      : communicator_(communicator), machine_(machine) {}

  /// Records that other slaves have gathered for these clusters in this iteration: their newest
  /// light is read.
  void know_gathered(std::span<const ClusterId> clusters) {
    written_.insert(clusters.begin(), clusters.end());
  }

  void set_committed(int iteration) override { committed_ = iteration; }
  int committed() const override { return committed_; }
  /// Fetches the sections in one message; each is kept until it is read, once.
  void prefetch(std::vector<SectionName> names) override;
  SectionFile load_section(const SectionName& name) override;
  /// Sends the sections to the master.
  void store_sections(std::vector<SectionFile> sections) override;
  bool written(ClusterId id) const override { return written_.contains(id); }
  /// The master moves the files; fetched sections are out of date.
  void move_to_common() override;

 private:
  Communicator& communicator_;
  Machine& machine_;
  int committed_ = 0;
  std::set<ClusterId> written_;
  std::map<SectionName, SectionFile> fetched_;
};

/// Waits for the next message, which must be a T: a slave gets messages from the master alone.
/// Throws RunError for any other.
template <class T>
T receive_from_master(Communicator& communicator, Machine& machine) {
  Received received = receive(communicator, machine);
  T* message = std::get_if<T>(&received.message);
  if (message == nullptr)
    throw RunError("the master sent a message that the slave did not wait for");
  return std::move(*message);
}

}  // namespace enfilade
