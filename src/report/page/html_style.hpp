// The style sheet of report.html.
#pragma once

namespace enfilade {

/// CSS for light and dark; no external resource.
extern const char* const report_style;

}  // namespace enfilade
