// The messages of the parallel algorithm: few, and small (§7).
#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "base/ids.hpp"

namespace enfilade {

/// Thief to victim: "I am out of work in this iteration, and these clusters are in my memory"
/// (§3.3.3, figure 4).
struct StealRequest {
  int iteration = 0;  ///< a victim that has not heard yet that it has begun answers when it has
  std::vector<ClusterId> resident;
};

/// Victim to thief: the cluster that is now the thief's, or none.
struct StealReply {
  ClusterId cluster;
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
struct Verdict {
  double value = -1.0;
  std::vector<double> plan;
  std::vector<double> correction;  ///< what the coarse system adds to the light; may be empty
};

using Message = std::variant<StealRequest, StealReply, Token, Verdict>;

struct Received {
  Rank from;
  Message message;
};

/// MPI tags, one a kind of message.
enum class Tag : int { steal_request = 1, steal_reply = 2, token = 3, verdict = 4, stop = 5 };

std::vector<std::byte> encode(const StealRequest& request);
std::vector<std::byte> encode(const StealReply& reply);
std::vector<std::byte> encode(const Token& token);
std::vector<std::byte> encode(const Verdict& verdict);
/// Throws RunError for bytes that are no such message.
Message decode(Tag tag, std::span<const std::byte> bytes);

}  // namespace enfilade
