// The simulated disk and wire against closed forms: k clients think, then ask one server. Mean
// value analysis (Reiser and Lavenberg 1980) of the machine-repairman model gives their throughput
// exactly where thinking and serving take exponential times, for a server that takes one after the
// other (the disk) as for one that is shared by all at once (the wire).
#include <cmath>

#include "base/random.hpp"
#include "check.hpp"

namespace enfilade::spmd_tests {
namespace {

constexpr double think_s = 0.4, serve_s = 0.1, until_s = 3000.0;
constexpr double bytes_per_s = 1e6;       // of the slow part of queue_disk.xml and queue_wire.xml
constexpr double flops_per_s = 1e9;       // of a client there
constexpr double flops_per_ray = 3000.0;  // of the default cost model, as are the next two
constexpr double flops_per_byte = 4.0;
constexpr double request_s = 0.001;

/// Requests a second of `clients` that think for `idle_s` on average between two requests.
double mean_value_analysis(int clients, double idle_s) {
  double waiting = 0.0, throughput = 0.0;
  for (int k = 1; k <= clients; ++k) {
    const double response_s = serve_s * (1.0 + waiting);
    throughput = k / (idle_s + response_s);
    waiting = throughput * response_s;
  }
  return throughput;
}

double exponential(Random& random, double mean) { return -mean * std::log(1.0 - random.uniform()); }

}  // namespace

void queue_of_clients(Context& context) {
  Random random(17 + 1000 * static_cast<std::uint64_t>(context.communicator.rank().value));
  std::uint64_t requests = 0;
  context.communicator.barrier();
  while (context.machine.now_s() < until_s) {
    WorkCount thinking;
    thinking.rays = static_cast<std::uint64_t>(
        std::llround(exponential(random, think_s) * flops_per_s / flops_per_ray));
    context.machine.compute(thinking);
    const double bytes = exponential(random, serve_s * bytes_per_s);
    context.machine.read(Disk::common, 0, static_cast<std::uint64_t>(std::llround(bytes)));
    ++requests;
  }
  const auto all = context.communicator.gather(std::vector<double>{static_cast<double>(requests)});
  context.communicator.on_root([&] {
    double sum = 0.0;
    for (const auto& rank : all) sum += rank[0];
    const double decoding_s = serve_s * bytes_per_s * flops_per_byte / flops_per_s;
    const double expected =
        mean_value_analysis(context.communicator.size(), think_s + request_s + decoding_s);
    SPMD_CHECK(
        std::abs(sum / until_s / expected - 1.0) < 0.05,
        std::to_string(sum / until_s) + " requests a second, not " + std::to_string(expected));
  });
}

}  // namespace enfilade::spmd_tests
