// What counted work and bytes cost on a simulated host: the one place where they are priced.
#pragma once

#include <cstdint>
#include <string>

#include "base/work_count.hpp"
#include "machine/machine.hpp"

namespace enfilade {

/// Flops of one operation, by the kinds of WorkCount. The defaults are those of
/// platforms/cost_model.json.
struct FlopCosts {
  double ray = 3000.0;
  double form_factor = 300.0;
  double kernel = 40.0;
  double link_refined = 400.0;
  double link_gathered = 30.0;
  double patch = 300.0;
  double push_pull = 40.0;
  double shaft = 1500.0;
  double byte_read = 4.0;  ///< of a byte: decoding, checksum, copy out of the network
  double byte_written = 4.0;
};

/// Costs of one request at a disk: it waits for the arm, seeks, and transfers at the platform's
/// bandwidth.
struct DiskCosts {
  double seek_s = 0.012;
  double request_s =
      0.001;  ///< of a client on another host: call and answer, without the wire's latency
  std::uint64_t request_bytes = 1 << 20;  ///< a longer transfer is several requests
};

/// Sizes of the modelled program's records; all 0 = the true size of this program's sections.
struct RecordSizes {
  std::uint64_t surface_bytes = 0, patch_bytes = 0, link_bytes = 0;
};

struct CostModel {
  FlopCosts flops;
  DiskCosts disk;
  RecordSizes records;
};

/// Returns the text of a cost model's file. Throws InputError where it cannot be read or is none.
std::string cost_model_text(const std::string& path);
/// Takes the text of file `path`. Throws InputError, naming the key, for an unknown, missing or
/// negative figure.
CostModel cost_model_from(const std::string& text, const std::string& path);

/// Returns the flops that counted work costs.
double price_flops(const CostModel& model, const WorkCount& work);
/// Returns the bytes that a section counts for.
std::uint64_t price_record(const CostModel& model, const RecordCount& count);

/// "256M" -> bytes; suffixes K, M, G (powers of 1024). Throws InputError(file, where, ...).
std::uint64_t parse_bytes(const std::string& text, const std::string& file,
                          const std::string& where);

}  // namespace enfilade
