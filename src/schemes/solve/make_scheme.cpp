#include "schemes/solve/make_scheme.hpp"

#include "base/error.hpp"
#include "schemes/master/cell_dealer.hpp"
#include "schemes/master/group_dealer.hpp"
#include "schemes/master/master_scheme.hpp"
#include "schemes/solve/run_ranks.hpp"
#include "schemes/spmd/spmd_scheme.hpp"

namespace enfilade {
namespace {

std::unique_ptr<Order> order_of(const SchemeParts& p) {
  return make_order(p.config.order, p.config.seed, p.prepared.graph, emitted_powers(p.prepared));
}

std::unique_ptr<ParallelScheme> spmd(const SchemeParts& p) {
  const auto make_tasks = [p] { return TaskList(p.own, p.cost, order_of(p)); };
  return std::make_unique<SpmdScheme>(
      p.store, make_tasks, p.communicator, p.machine,
      SpmdConfig{p.config.steal, p.config.method.coarse_correction});
}

std::unique_ptr<ParallelScheme> with_master(const SchemeParts& p,
                                            std::function<std::unique_ptr<Dealer>()> make_dealer) {
  return std::make_unique<MasterScheme>(p.store, std::move(make_dealer), p.communicator, p.machine,
                                        p.config.method.coarse_correction);
}

}  // namespace

std::unique_ptr<ParallelScheme> make_scheme(const SchemeParts& p) {
  const int slaves = p.communicator.size() - 1;
  switch (slaves > 0 ? p.config.scheme : Scheme::spmd) {
    case Scheme::spmd:
      return spmd(p);
    case Scheme::master_slave:
      return with_master(p, [p, slaves] {
        return std::make_unique<GroupDealer>(p.prepared, slaves, *order_of(p), p.cost,
                                             p.config.steal);
      });
    case Scheme::replicated:
      return with_master(p, [p, slaves] {
        return std::make_unique<CellDealer>(p.prepared, slaves, emitted_powers(p.prepared),
                                            p.config.seed, p.config.steal);
      });
  }
  ENFILADE_CHECK(false, "a scheme that is none");
  return nullptr;
}

}  // namespace enfilade
