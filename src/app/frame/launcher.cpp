#include "app/frame/launcher.hpp"

#include <cstdlib>
#include <initializer_list>

namespace enfilade {

bool started_as_rank() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "SMPI_GLOBAL_SIZE"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

}  // namespace enfilade
