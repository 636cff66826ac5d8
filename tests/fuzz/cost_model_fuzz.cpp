// The cost model's reader: any bytes give prices that are numbers, or an InputError.
#include <cmath>

#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "machine/cost_model.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const double flops = price_flops(cost_model_from(text, "fuzz"), WorkCount{.rays = 7});
    fuzz::require(std::isfinite(flops) && flops >= 0.0);
  } catch (const InputError&) {
  }
  return 0;
}
