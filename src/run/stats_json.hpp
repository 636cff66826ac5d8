// RUN/stats.json and RUN/history.json: run records as flat JSON.
#pragma once

#include <string>
#include <vector>

#include "base/ids.hpp"
#include "base/run_record.hpp"

namespace enfilade {

/// Returns one JSON object, keys in the record's order; NaN and infinity become null.
std::string to_json(const RunRecord& record);
/// Throws RunError where the file cannot be written; it then keeps its old content.
void write_stats(const RunRecord& record, const std::string& path);
/// Throws InputError where the file is missing or is not a flat JSON object.
RunRecord read_stats(const std::string& path);

/// Returns a list of flat objects, one for each iteration; empty where the file is missing. Throws
/// InputError for other content.
std::vector<RunRecord> read_history(const std::string& path);
/// Reads RUN/assignment.json: a list with the rank of each cluster, in order of their ids; empty
/// where it is missing.
std::vector<Rank> read_owners(const std::string& path);
/// Reads RUN/warnings.json: a list of lines; empty where it is missing.
std::vector<std::string> read_lines(const std::string& path);
/// Returns the scene file's source, licence and attribution: its keys "source", "licence",
/// "license", "attribution", "copyright", "author". Empty where the file is missing or is not JSON.
std::vector<std::string> read_attribution(const std::string& scene_file);

}  // namespace enfilade
