// The messages of the parallel schemes, each a struct with its sender and receiver: few, and small
// (§7).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/ids.hpp"
#include "comm/communicator.hpp"
#include "comm/rank_set.hpp"
#include "store/cluster_files.hpp"

namespace enfilade {

/// Thief to victim: the thief is out of work in this iteration, and holds these clusters in its
/// memory (§3.3.3, figure 4). Cluster numbers are sent as bits, 64 neighbouring numbers per word: a
/// message of two kilobytes where a building of 13,000 clusters is in memory.
struct StealRequest {
  int iteration = 0;                ///< a victim that has not begun it yet answers when it does
  std::vector<ClusterId> resident;  ///< ascending
  RankSet idle;  ///< ranks known to the thief to have no cluster left to give in this iteration
};

/// Victim to thief: the cluster that belongs to the thief from now on, or none.
struct StealReply {
  ClusterId cluster;
  RankSet idle;  ///< ranks known to the victim to be idle, so that thieves send few vain requests
};

/// First tour of the ring (§3.3.4): from each rank to its successor once it is idle and has moved
/// its files. It carries an iteration's figures (FoldedNumbers of gather/iteration_figures.hpp),
/// into which each rank folds its own: `maxima` by maximum, `sums` by addition, in the order of the
/// ranks.
struct Token {
  std::vector<double> maxima;
  std::vector<double> sums;
  std::vector<double>
      coarse;  ///< the ranks' parts of the coarse system, added by ClusterWork::merge()
  std::vector<double> far_light{};  ///< ClusterWork::far_light() of the ranks, one after the other
};

/// Second tour of the ring, from rank 0 on. `value`: the paper's T_final (max change), or -1 to
/// stop. `plan`: the IterationPlan of the next iteration, as numbers.
struct Decision {
  double value = -1.0;
  std::vector<double> plan;
  std::vector<double>
      correction;  ///< Correction::changes of solver/iteration_end.hpp; may be empty
  std::vector<double> far_light{};  ///< Token::far_light of all ranks
};

/// The messages below are those of the schemes with a master, rank 0 (schemes/master/dealing.hpp).
/// There, each slave sends its Token to the master, and the master its Decision to each slave.

/// Figures of a slave's gather that the master plans by.
struct GatherNote {
  ClusterId cluster;
  double change_power = 0.0;  ///< sum of area |B(k) - B(k-1)|
  std::uint64_t links = 0;    ///< links gathered over: a measure of its work
};

/// Slave to master: the slave is out of work, and reports the gathers of its last order.
struct WorkRequest {
  std::vector<GatherNote> done;
};

/// Master to slave: the answer to a WorkRequest.
struct WorkOrder {
  std::vector<ClusterId> gather;    ///< in this order; empty: no more work in this iteration
  bool hold_each = false;           ///< ClusterWork::hold() for each receiver, one after the other
  std::vector<ClusterId> hold;      ///< else hold() for all of these at once; empty: no hold()
  std::vector<ClusterId> gathered;  ///< by any slave, since the last order: use their newest light
};

/// Slave to master: a request for sections of clusters.
struct SectionRequest {
  std::vector<SectionName> sections;
};

/// Master to slave: the requested sections, in the order of the request. As large as the clusters.
struct SectionReply {
  std::vector<SectionFile> sections;
};

/// Slave to master: the sections that a gather has changed: patches, and links where they changed.
struct ClusterResult {
  std::vector<SectionFile> sections;
};

using Message = std::variant<StealRequest, StealReply, Token, Decision, WorkRequest, WorkOrder,
                             SectionRequest, SectionReply, ClusterResult>;

struct Received {
  Rank from;
  Message message;
};

/// Tags of the communicator, one for each kind of message, in the order of Message.
enum class Tag : int {
  steal_request = 1,
  steal_reply,
  token,
  decision,
  work_request,
  work_order,
  section_request,
  section_reply,
  cluster_result
};
Tag tag_of(const Message& message);

/// Returns the message as bytes.
std::vector<std::byte> encode(const Message& message);
/// Returns the message of these bytes. Throws RunError for bytes that are not one message of this
/// tag.
Message decode(Tag tag, std::span<const std::byte> bytes);

/// Folds `own` into `token`: maxima by maximum, sums by addition; a shorter list counts as filled
/// up with zeros. Does not touch `coarse`.
void fold(Token& token, const Token& own);

/// The operations of Communicator, with messages instead of bytes.
void send(Communicator& communicator, Rank to, const Message& message);
std::optional<Received> poll(Communicator& communicator);
Received receive(Communicator& communicator, Machine& machine);

}  // namespace enfilade
