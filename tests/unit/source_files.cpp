#include "unit/source_files.hpp"

namespace enfilade {

// The one object that knows the checkout's folder: what a compiler cache keeps of all others serves
// any checkout.
std::string source_file(const std::string& name) {
  return std::string(ENFILADE_SOURCE_DIR "/") + name;
}

}  // namespace enfilade
