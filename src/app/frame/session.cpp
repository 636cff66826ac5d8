#include "app/frame/session.hpp"

#include "base/error.hpp"

namespace enfilade {

int Session::fail(const std::exception& error) {
  console_.error(error.what());
  return dynamic_cast<const InputError*>(&error) != nullptr ? bad_input_status : broken_run_status;
}

}  // namespace enfilade
