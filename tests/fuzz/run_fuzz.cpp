// The files of a RUN, as if their checksums were right: any bytes give what was kept, or an error.
// The first byte says which file the others are.
#include <string_view>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "cells/partition/cell_complex.hpp"
#include "clusters/cluster.hpp"
#include "fuzz_target.hpp"
#include "json/json_text.hpp"
#include "json/sealed_json.hpp"
#include "run/history.hpp"
#include "run/run_mark.hpp"
#include "run/stats_json.hpp"
#include "visibility/cluster_graph.hpp"

namespace {

using namespace enfilade;

struct RunDirectory {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("enfilade-run-fuzz-" + std::to_string(::getpid()));
  RunDirectory() { std::filesystem::create_directories(path / "common"); }
  ~RunDirectory() { std::filesystem::remove_all(path); }
};

/// The document with a right checksum, in place of RUN's file `name`.
std::string sealed(const std::string& text, const char* format, int version, const char* name) {
  static const RunDirectory run;
  nlohmann::ordered_json document = parse_ordered_json(text, "fuzz");
  if (!document.is_object()) document = nlohmann::ordered_json::object();
  for (const char* key : {"format", "version", "checksum"}) document.erase(key);
  replace_file((run.path / name).string(), seal({format, version, ""}, document));
  return run.path.string();
}

void read_one(std::uint8_t kind, const std::string& text) {
  const std::string_view bytes(text);
  switch (kind % 8) {
    case 0:
      complex_from_bytes(bytes);
      break;
    case 1:
      clusters_from_bytes(bytes);
      break;
    case 2:
      graph_from_bytes(bytes);
      break;
    case 3:
      record_from(text, "fuzz");
      break;
    case 4:
      history_from(text, "fuzz");
      break;
    case 5:
      committed_iterations(
          sealed(text, "enfilade-manifest", manifest_version, "common/manifest.json"));
      break;
    case 6:
      read_run_mark(sealed(text, "enfilade-run", mark_version, "run.json"));
      break;
    default:
      owners_from(text, "fuzz");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  enfilade::fuzz::tells_what_was_read = true;
  enfilade::fuzz::was_read = false;
  if (size == 0) return 0;
  try {
    read_one(data[0], std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    enfilade::fuzz::was_read = true;
  } catch (const enfilade::InputError&) {
  } catch (const enfilade::RunError&) {
  }
  return 0;
}
