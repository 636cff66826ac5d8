#include "comm/messages.hpp"

#include <cstring>

#include "base/error.hpp"

namespace enfilade {
namespace {

class Writer {
 public:
  template <class T>
  void put(std::span<const T> values) {
    put_one(static_cast<std::uint64_t>(values.size()));
    const auto raw = std::as_bytes(values);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  template <class T>
  void put_one(T value) {
    const auto raw = std::as_bytes(std::span<const T>(&value, 1));
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  T one() {
    need(sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> many() {
    const auto count = one<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) need(bytes_.size() + 1);
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes_.data(), count * sizeof(T));
    bytes_ = bytes_.subspan(count * sizeof(T));
    return values;
  }
  void end() const {
    if (!bytes_.empty()) throw RunError("message too long for its kind");
  }

 private:
  void need(std::size_t size) const {
    if (bytes_.size() < size) throw RunError("message too short for its kind");
  }
  std::span<const std::byte> bytes_;
};

}  // namespace

std::vector<std::byte> encode(const StealRequest& request) {
  Writer w;
  w.put_one(request.iteration);
  w.put(std::span<const ClusterId>(request.resident));
  return w.take();
}

std::vector<std::byte> encode(const StealReply& reply) {
  Writer w;
  w.put_one(reply.cluster);
  return w.take();
}

std::vector<std::byte> encode(const Token& token) {
  Writer w;
  w.put(std::span<const double>(token.maxima));
  w.put(std::span<const double>(token.sums));
  w.put(std::span<const double>(token.coarse));
  return w.take();
}

std::vector<std::byte> encode(const Verdict& verdict) {
  Writer w;
  w.put_one(verdict.value);
  w.put(std::span<const double>(verdict.plan));
  w.put(std::span<const double>(verdict.correction));
  return w.take();
}

Message decode(Tag tag, std::span<const std::byte> bytes) {
  Reader r(bytes);
  Message message;
  switch (tag) {
    case Tag::steal_request: {
      StealRequest request;
      request.iteration = r.one<int>();
      request.resident = r.many<ClusterId>();
      message = std::move(request);
      break;
    }
    case Tag::steal_reply: {
      message = StealReply{r.one<ClusterId>()};
      break;
    }
    case Tag::token: {
      Token token;
      token.maxima = r.many<double>();
      token.sums = r.many<double>();
      token.coarse = r.many<double>();
      message = std::move(token);
      break;
    }
    case Tag::verdict: {
      Verdict verdict;
      verdict.value = r.one<double>();
      verdict.plan = r.many<double>();
      verdict.correction = r.many<double>();
      message = std::move(verdict);
      break;
    }
    default:
      throw RunError("message with the unknown tag " + std::to_string(static_cast<int>(tag)));
  }
  r.end();
  return message;
}

}  // namespace enfilade
