// A rank that fails takes the whole run down, with its exit status and without a hang.
#include "base/error.hpp"
#include "check.hpp"

namespace enfilade::spmd_tests {

void failing_rank(Context& context) {
  Communicator& c = context.communicator;
  if (c.rank().value == c.size() - 1) throw RunError("the disk of this rank has burnt down");
  c.receive(context.machine);  // waits for a message that will never come
}

void failing_root(Context& context) {
  context.communicator.on_root(
      [] { throw InputError("a.json", "surfaces[0]", "is bad", "correct it"); });
  SPMD_CHECK(false, "a rank went on after rank 0 had refused the input");
}

}  // namespace enfilade::spmd_tests
