// Communicator by MPI. Messages are probed for and then received, never tested for: SMPI keeps each
// request that ended by a test in a list, and searches that list at the end of each later activity.
#include "comm/communicator.hpp"

#include <mpi.h>

#include <cstdlib>
#include <deque>
#include <iostream>
#include <map>

#include "base/error.hpp"

namespace enfilade {
namespace {

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw RunError(std::string(call) +
                 " failed: " + std::string(text, static_cast<std::size_t>(length)));
}

/// The tag of a part of a message that the sender's next one continues.
constexpr int part_tag = 0;

/// So many sends may be under way before the completed ones are looked for and forgotten.
constexpr std::size_t most_sending = 64;

/// The longest message that goes in one piece, and the size of a rank's one receive buffer.
constexpr std::size_t inbox_bytes = 1 << 20;

}  // namespace

struct Communicator::Impl {
  /// A send under way: its bytes must stay until MPI has taken them.
  struct Pending {
    std::vector<std::byte> bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  MPI_Comm comm = MPI_COMM_NULL;
  int rank = 0, size = 1;
  std::deque<Pending> sending;
  MessageCount sent;
  std::vector<std::byte> inbox = std::vector<std::byte>(inbox_bytes);
  std::map<int, std::vector<std::byte>> parts;  ///< of incomplete messages, by sender

  void start(int to, int tag, std::vector<std::byte> bytes) {
    ENFILADE_CHECK(bytes.size() <= inbox.size(), std::to_string(bytes.size()) + " bytes");
    if (sending.size() >= most_sending) drop_sent();
    Pending& p = sending.emplace_back(Pending{std::move(bytes), MPI_REQUEST_NULL});
    check(MPI_Isend(p.bytes.data(), static_cast<int>(p.bytes.size()), MPI_BYTE, to, tag, comm,
                    &p.request),
          "MPI_Isend");
  }
  /// Forgets the sends that MPI has completed, so that a rank that sends much keeps little.
  void drop_sent() {
    std::erase_if(sending, [](Pending& p) {
      int gone = 0;
      check(MPI_Test(&p.request, &gone, MPI_STATUS_IGNORE), "MPI_Test");
      return gone != 0;
    });
  }
  /// A message longer than the inbox goes in parts; the parts of one sender arrive in order.
  void send(Rank to, int tag, std::vector<std::byte> bytes) {
    ++sent.messages;
    sent.bytes += bytes.size();
    auto at = bytes.begin();
    const auto part = static_cast<std::ptrdiff_t>(inbox.size());
    for (; bytes.end() - at > part; at += part) start(to.value, part_tag, {at, at + part});
    bytes.erase(bytes.begin(), at);
    start(to.value, tag, std::move(bytes));
  }
  /// Blocks until a message from `source` is here; returns nothing where it was a part that others
  /// follow.
  std::optional<Envelope> take(int source) {
    MPI_Status status;
    check(MPI_Recv(inbox.data(), static_cast<int>(inbox.size()), MPI_BYTE, source, MPI_ANY_TAG,
                   comm, &status),
          "MPI_Recv");
    int count = 0;
    check(MPI_Get_count(&status, MPI_BYTE, &count), "MPI_Get_count");
    const std::span<const std::byte> bytes(inbox.data(), static_cast<std::size_t>(count));
    std::vector<std::byte>& whole = parts[status.MPI_SOURCE];
    whole.insert(whole.end(), bytes.begin(), bytes.end());
    if (status.MPI_TAG == part_tag) return std::nullopt;
    Envelope envelope{Rank{status.MPI_SOURCE}, status.MPI_TAG, std::move(whole)};
    parts.erase(status.MPI_SOURCE);
    return envelope;
  }
  void finish() {
    while (!sending.empty()) {
      check(MPI_Wait(&sending.front().request, MPI_STATUS_IGNORE), "MPI_Wait");
      sending.pop_front();
    }
  }
};

int exit_status_of(const std::exception& error) {
  if (const auto* peer = dynamic_cast<const PeerFailure*>(&error)) return peer->exit_status();
  return dynamic_cast<const InputError*>(&error) != nullptr ? 2 : 1;
}

Communicator::Communicator(int& argc, char**& argv) : impl_(std::make_unique<Impl>()) {
  check(MPI_Init(&argc, &argv), "MPI_Init");
  check(MPI_Comm_dup(MPI_COMM_WORLD, &impl_->comm), "MPI_Comm_dup");
  check(MPI_Comm_set_errhandler(impl_->comm, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check(MPI_Comm_rank(impl_->comm, &impl_->rank), "MPI_Comm_rank");
  check(MPI_Comm_size(impl_->comm, &impl_->size), "MPI_Comm_size");
}

Communicator::~Communicator() {
  try {
    impl_->finish();
    MPI_Comm_free(&impl_->comm);
    MPI_Finalize();
  } catch (const std::exception&) {
    // The run is over: nothing can be done about an MPI that fails to end.
  }
}

Rank Communicator::rank() const { return Rank{impl_->rank}; }
int Communicator::size() const { return impl_->size; }
const MessageCount& Communicator::sent() const { return impl_->sent; }

void Communicator::send(Rank to, int tag, std::vector<std::byte> bytes) {
  ENFILADE_CHECK(tag != part_tag, "a message without a tag");
  impl_->send(to, tag, std::move(bytes));
}

std::optional<Envelope> Communicator::poll() {
  while (true) {
    int arrived = 0;
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, impl_->comm, &arrived, &status), "MPI_Iprobe");
    if (arrived == 0) return std::nullopt;
    if (auto envelope = impl_->take(status.MPI_SOURCE)) return envelope;
  }
}

Envelope Communicator::receive(Machine& machine) {
  std::optional<Envelope> envelope;
  machine.wait_for_message([&] { return (envelope = poll()).has_value(); },
                           [&] { return (envelope = impl_->take(MPI_ANY_SOURCE)).has_value(); });
  return std::move(*envelope);
}

void Communicator::finish_sends() { impl_->finish(); }

void Communicator::barrier() { check(MPI_Barrier(impl_->comm), "MPI_Barrier"); }

std::string Communicator::broadcast(const std::string& text) {
  auto length = static_cast<unsigned long long>(text.size());
  check(MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, impl_->comm), "MPI_Bcast");
  std::string result = text;
  result.resize(static_cast<std::size_t>(length));
  constexpr std::size_t most = std::size_t{1} << 30;  // MPI counts in int
  for (std::size_t at = 0; at < result.size(); at += most) {
    const auto part = static_cast<int>(std::min(most, result.size() - at));
    check(MPI_Bcast(result.data() + at, part, MPI_CHAR, 0, impl_->comm), "MPI_Bcast");
  }
  return result;
}

std::vector<std::vector<double>> Communicator::gather(std::span<const double> numbers) {
  const int mine = static_cast<int>(numbers.size());
  const auto ranks = static_cast<std::size_t>(impl_->size);
  std::vector<int> counts(ranks), offsets(ranks);
  check(MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, impl_->comm), "MPI_Gather");
  std::size_t total = 0;
  for (std::size_t r = 0; r < ranks; ++r) {
    offsets[r] = static_cast<int>(total);
    total += static_cast<std::size_t>(counts[r]);
  }
  std::vector<double> all(root() ? total : 0);
  check(MPI_Gatherv(numbers.data(), mine, MPI_DOUBLE, all.data(), counts.data(), offsets.data(),
                    MPI_DOUBLE, 0, impl_->comm),
        "MPI_Gatherv");
  std::vector<std::vector<double>> result;
  if (!root()) return result;
  for (std::size_t r = 0; r < ranks; ++r) {
    const auto first = all.begin() + offsets[r];
    result.emplace_back(first, first + counts[r]);
  }
  return result;
}

void Communicator::on_root(const std::function<void()>& work) {
  int status = 0;
  std::exception_ptr failure;
  if (root()) {
    try {
      work();
    } catch (const std::exception& error) {
      status = exit_status_of(error);
      failure = std::current_exception();
    }
  }
  check(MPI_Bcast(&status, 1, MPI_INT, 0, impl_->comm), "MPI_Bcast");
  others_know_ = status != 0;
  if (failure) std::rethrow_exception(failure);
  if (status != 0) throw PeerFailure(status);
}

void Communicator::abort(int exit_status) {
  std::cout.flush();
  std::cerr.flush();
  // The end of a process that all ranks share ends them all; SMPI's MPI_Abort would end it with
  // status 0.
  if (!ranks_share_a_process()) MPI_Abort(impl_->comm, exit_status);
  std::_Exit(exit_status);
}

}  // namespace enfilade
