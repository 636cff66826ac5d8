#include "comm/messages.hpp"

#include "base/byte_stream.hpp"

namespace enfilade {
std::vector<std::byte> encode(const StealRequest& request) {
  ByteWriter w;
  w.put(request.iteration);
  w.put_all(request.resident);
  return w.take();
}

std::vector<std::byte> encode(const StealReply& reply) {
  ByteWriter w;
  w.put(reply.cluster);
  return w.take();
}

std::vector<std::byte> encode(const Token& token) {
  ByteWriter w;
  w.put_all(token.maxima);
  w.put_all(token.sums);
  w.put_all(token.coarse);
  return w.take();
}

std::vector<std::byte> encode(const Verdict& verdict) {
  ByteWriter w;
  w.put(verdict.value);
  w.put_all(verdict.plan);
  w.put_all(verdict.correction);
  return w.take();
}

Message decode(Tag tag, std::span<const std::byte> bytes) {
  ByteReader r(bytes, "message");
  Message message;
  switch (tag) {
    case Tag::steal_request: {
      StealRequest request;
      request.iteration = r.get<int>();
      request.resident = r.get_all<ClusterId>();
      message = std::move(request);
      break;
    }
    case Tag::steal_reply: {
      message = StealReply{r.get<ClusterId>()};
      break;
    }
    case Tag::token: {
      Token token;
      token.maxima = r.get_all<double>();
      token.sums = r.get_all<double>();
      token.coarse = r.get_all<double>();
      message = std::move(token);
      break;
    }
    case Tag::verdict: {
      Verdict verdict;
      verdict.value = r.get<double>();
      verdict.plan = r.get_all<double>();
      verdict.correction = r.get_all<double>();
      message = std::move(verdict);
      break;
    }
    default:
      throw RunError("message with the unknown tag " + std::to_string(static_cast<int>(tag)));
  }
  r.expect_end();
  return message;
}

}  // namespace enfilade
