#include "schemes/protocol/messages.hpp"

#include <algorithm>
#include <bit>

#include "base/byte_stream.hpp"

namespace enfilade {
namespace {

void write(ByteWriter& w, const StealRequest& request) {
  std::vector<std::uint32_t> words;
  std::vector<std::uint64_t> bits;
  for (const ClusterId id : request.resident) {
    if (words.empty() || words.back() != id.value / 64) {
      words.push_back(id.value / 64);
      bits.push_back(0);
    }
    bits.back() |= std::uint64_t{1} << (id.value % 64);
  }
  w.put(request.iteration);
  w.put_all(words);
  w.put_all(bits);
  w.put_all(request.idle.words());
}

void write(ByteWriter& w, const StealReply& reply) {
  w.put(reply.cluster);
  w.put_all(reply.idle.words());
}

void write(ByteWriter& w, const Token& token) {
  w.put_all(token.maxima);
  w.put_all(token.sums);
  w.put_all(token.coarse);
  w.put_all(token.far_light);
}

void write(ByteWriter& w, const Decision& decision) {
  w.put(decision.value);
  w.put_all(decision.plan);
  w.put_all(decision.correction);
  w.put_all(decision.far_light);
}

void write(ByteWriter& w, const WorkRequest& request) {
  w.put(static_cast<std::uint64_t>(request.done.size()));
  for (const GatherNote& note : request.done) {
    w.put(note.cluster);
    w.put(note.change_power);
    w.put(note.links);
  }
}

void write(ByteWriter& w, const WorkOrder& order) {
  w.put_all(order.gather);
  w.put(order.hold_each);
  w.put_all(order.hold);
  w.put_all(order.gathered);
}

void write(ByteWriter& w, const SectionRequest& request) {
  w.put(static_cast<std::uint64_t>(request.sections.size()));
  for (const SectionName& name : request.sections) {
    w.put(name.cluster);
    w.put(name.section);
    w.put(name.committed);
  }
}

void write_sections(ByteWriter& w, const std::vector<SectionFile>& sections) {
  w.put(static_cast<std::uint64_t>(sections.size()));
  for (const SectionFile& section : sections) {
    put_info(w, section.info);
    w.put_all(section.bytes);
  }
}

std::vector<SectionFile> read_sections(ByteReader& r) {
  std::vector<SectionFile> sections(r.get_count(section_info_bytes));
  for (SectionFile& section : sections) {
    section.info = get_info(r);
    section.bytes = r.get_all<std::byte>();
  }
  return sections;
}

void write(ByteWriter& w, const SectionReply& reply) { write_sections(w, reply.sections); }
void write(ByteWriter& w, const ClusterResult& result) { write_sections(w, result.sections); }

StealRequest read_steal_request(ByteReader& r) {
  StealRequest request;
  request.iteration = r.get<int>();
  const auto words = r.get_all<std::uint32_t>();
  auto bits = r.get_all<std::uint64_t>();
  bits.resize(words.size(), 0);
  for (std::size_t w = 0; w < words.size(); ++w) {
    for (; bits[w] != 0; bits[w] &= bits[w] - 1) {
      request.resident.emplace_back(64 * words[w] +
                                    static_cast<std::uint32_t>(std::countr_zero(bits[w])));
    }
  }
  request.idle = RankSet(r.get_all<std::uint64_t>());
  return request;
}

StealReply read_steal_reply(ByteReader& r) {
  const auto cluster = r.get<ClusterId>();
  return {cluster, RankSet(r.get_all<std::uint64_t>())};
}

Token read_token(ByteReader& r) {
  Token token;
  token.maxima = r.get_all<double>();
  token.sums = r.get_all<double>();
  token.coarse = r.get_all<double>();
  token.far_light = r.get_all<double>();
  return token;
}

Decision read_decision(ByteReader& r) {
  Decision decision;
  decision.value = r.get<double>();
  decision.plan = r.get_all<double>();
  decision.correction = r.get_all<double>();
  decision.far_light = r.get_all<double>();
  return decision;
}

WorkRequest read_work_request(ByteReader& r) {
  WorkRequest request;
  request.done.resize(r.get_count(sizeof(ClusterId) + sizeof(double) + sizeof(std::uint64_t)));
  for (GatherNote& note : request.done) {
    note.cluster = r.get<ClusterId>();
    note.change_power = r.get<double>();
    note.links = r.get<std::uint64_t>();
  }
  return request;
}

SectionRequest read_section_request(ByteReader& r) {
  SectionRequest request;
  request.sections.resize(r.get_count(sizeof(ClusterId) + sizeof(Section) + sizeof(bool)));
  for (SectionName& name : request.sections) {
    name.cluster = r.get<ClusterId>();
    name.section = r.get<Section>();
    name.committed = r.get<bool>();
  }
  return request;
}

WorkOrder read_work_order(ByteReader& r) {
  WorkOrder order;
  order.gather = r.get_all<ClusterId>();
  order.hold_each = r.get<bool>();
  order.hold = r.get_all<ClusterId>();
  order.gathered = r.get_all<ClusterId>();
  return order;
}

Message read_message(Tag tag, ByteReader& r) {
  switch (tag) {
    case Tag::steal_request:
      return read_steal_request(r);
    case Tag::steal_reply:
      return read_steal_reply(r);
    case Tag::token:
      return read_token(r);
    case Tag::decision:
      return read_decision(r);
    case Tag::work_request:
      return read_work_request(r);
    case Tag::work_order:
      return read_work_order(r);
    case Tag::section_request:
      return read_section_request(r);
    case Tag::section_reply:
      return SectionReply{read_sections(r)};
    case Tag::cluster_result:
      return ClusterResult{read_sections(r)};
    default:
      throw RunError("message with the unknown tag " + std::to_string(static_cast<int>(tag)));
  }
}

}  // namespace

Tag tag_of(const Message& message) {
  return static_cast<Tag>(message.index() + 1);  // both in one order
}

std::vector<std::byte> encode(const Message& message) {
  ByteWriter w;
  std::visit([&w](const auto& m) { write(w, m); }, message);
  return w.take();
}

Message decode(Tag tag, std::span<const std::byte> bytes) {
  ByteReader r(bytes, "message");
  Message message = read_message(tag, r);
  r.expect_end();
  return message;
}

void fold(Token& token, const Token& own) {
  token.maxima.resize(std::max(token.maxima.size(), own.maxima.size()), 0.0);
  token.sums.resize(std::max(token.sums.size(), own.sums.size()), 0.0);
  for (std::size_t i = 0; i < own.maxima.size(); ++i) {
    token.maxima[i] = std::max(token.maxima[i], own.maxima[i]);
  }
  for (std::size_t i = 0; i < own.sums.size(); ++i) token.sums[i] += own.sums[i];
}

namespace {

Received decoded(const Envelope& envelope) {
  return {envelope.from, decode(static_cast<Tag>(envelope.tag), envelope.bytes)};
}

}  // namespace

void send(Communicator& communicator, Rank to, const Message& message) {
  communicator.send(to, static_cast<int>(tag_of(message)), encode(message));
}

std::optional<Received> poll(Communicator& communicator) {
  const std::optional<Envelope> envelope = communicator.poll();
  if (!envelope) return std::nullopt;
  return decoded(*envelope);
}

Received receive(Communicator& communicator, Machine& machine) {
  return decoded(communicator.receive(machine));
}

}  // namespace enfilade
