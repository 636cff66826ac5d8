// The messages of the parallel algorithm: few, and small (§7).
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

/// Thief to victim: "I am out of work in this iteration, and these clusters are in my memory"
/// (§3.3.3, figure 4). They go as bits, 64 neighbouring numbers a word: a message of two kilobytes
/// where a building of 13,000 clusters is in memory.
struct StealRequest {
  int iteration = 0;  ///< a victim that has not heard yet that it has begun answers when it has
  std::vector<ClusterId> resident;  ///< ascending
  RankSet idle;  ///< that have nothing left to give in this iteration, as far as the thief knows
};

/// Victim to thief: the cluster that is now the thief's, or none.
struct StealReply {
  ClusterId cluster;
  RankSet idle;  ///< as the victim knows them; word goes round, so that few are asked in vain
};

/// First tour of the ring (§3.3.4), from each rank to its successor once it is idle and has moved
/// its files. Each rank folds in its own numbers: `maxima` by maximum, `sums` by addition, in the
/// order of the ranks.
struct Token {
  std::vector<double> maxima;
  std::vector<double> sums;
  std::vector<double> coarse;  ///< a part of the coarse system, merged as `radiosity` says
};

/// Second tour, from rank 0 on: `value` is T_final where another iteration follows, -1 where all is
/// done; `plan` is what every rank must know about that iteration.
struct Decision {
  double value = -1.0;
  std::vector<double> plan;
  std::vector<double> correction;  ///< what the coarse system adds to the light; may be empty
};

/// The following are those of the schemes with a master (schemes/master/dealing.hpp), which is rank
/// 0. There, slaves send their Token to the master and the master its Decision to each slave.

/// What a gather of a slave did, as far as the master needs it to plan by.
struct GatherNote {
  ClusterId cluster;
  double change_power = 0.0;  ///< sum of area |B(k) - B(k-1)|
  std::uint64_t links = 0;    ///< that it gathered over: how much work it was
};

/// Slave to master: "I have nothing to do; this is what became of your last order."
struct WorkRequest {
  std::vector<GatherNote> done;
};

/// Master to slave, in answer.
struct WorkOrder {
  std::vector<ClusterId> gather;    ///< in this order; none: this iteration has nothing more for it
  bool hold_each = false;           ///< hold what each receiver sees, one receiver after the other
  std::vector<ClusterId> hold;      ///< else: hold what all of these see; none: as before
  std::vector<ClusterId> gathered;  ///< by anybody, not told before: the newest light is to be used
};

/// Slave to master: these sections of clusters, please.
struct SectionRequest {
  std::vector<SectionName> sections;
};

/// Master to slave: those sections, in the order asked for. As long as the clusters are.
struct SectionReply {
  std::vector<SectionFile> sections;
};

/// Slave to master: what a gather made of a cluster: its patches, and its links where they changed.
struct ClusterResult {
  std::vector<SectionFile> sections;
};

using Message = std::variant<StealRequest, StealReply, Token, Decision, WorkRequest, WorkOrder,
                             SectionRequest, SectionReply, ClusterResult>;

struct Received {
  Rank from;
  Message message;
};

/// Tags of the communicator, one a kind of message.
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

std::vector<std::byte> encode(const Message& message);
/// Throws RunError for bytes that are no such message.
Message decode(Tag tag, std::span<const std::byte> bytes);

/// Maxima by maximum, sums by addition; a shorter list counts as filled up with zeros. Leaves
/// `coarse`.
void fold(Token& token, const Token& own);

/// What Communicator does with bytes, with messages.
void send(Communicator& communicator, Rank to, const Message& message);
std::optional<Received> poll(Communicator& communicator);
Received receive(Communicator& communicator, Machine& machine);

}  // namespace enfilade
