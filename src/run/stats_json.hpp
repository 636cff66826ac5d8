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

/// The records of RUN, none where the file is missing. They throw RunError where it is not as the
/// solve wrote it (sealed_reports.hpp).
/// stats.json:
RunRecord read_stats(const std::string& run_directory);
/// history.json: a record for each iteration.
std::vector<RunRecord> read_history(const std::string& run_directory);
/// assignment.json: the rank of each cluster, in order of their ids.
std::vector<Rank> read_owners(const std::string& run_directory);
/// warnings.json: a list of lines.
std::vector<std::string> read_warnings(const std::string& run_directory);
/// Returns the source, licence and attribution of a scene file's text: its keys "source",
/// "licence", "license", "attribution", "copyright", "author". Empty where it is not JSON.
std::vector<std::string> read_attribution(const std::string& scene_text);

/// The parts of these, on the text of the file at `path`. Throw InputError for other content.
RunRecord record_from(const std::string& text, const std::string& path);
std::vector<RunRecord> history_from(const std::string& text, const std::string& path);
std::vector<Rank> owners_from(const std::string& text, const std::string& path);
std::vector<std::string> lines_from(const std::string& text, const std::string& path);

}  // namespace enfilade
