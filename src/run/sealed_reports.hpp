// RUN/reports.json: what the files say that a solve has written about itself, so that none that was
// changed since is shown as the solve's own.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace enfilade {

/// Notes the checksums of stats.json, history.json, warnings.json, assignment.json and
/// pictures/ranks.svg, as far as they are there, and of `more` (paths in RUN), with the run and the
/// iteration that they are of. Throws RunError where one cannot be read, or the note not be
/// written.
void seal_reports(const std::string& run_directory, std::span<const std::string> more = {});

/// True where the reports are of the committed iteration, each file is as it was sealed, and those
/// of `names` are among them.
bool reports_are_whole(const std::string& run_directory, std::span<const std::string> names);

/// Returns the text of such a file (`name` is its path in RUN), none where the solve wrote none.
/// Throws RunError where it is not as it was sealed, or of another run or iteration than the
/// committed one.
std::optional<std::string> read_report(const std::string& run_directory, const std::string& name);

}  // namespace enfilade
