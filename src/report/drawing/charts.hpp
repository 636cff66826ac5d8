// Charts of the report as inline SVG; their colours follow the page.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace enfilade {

struct Series {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;
};

/// Lines over a linear x axis and a logarithmic y axis; values that are not positive are left out.
/// Empty text where nothing can be drawn.
std::string line_chart(const std::vector<Series>& series, const std::string& x_label,
                       const std::string& y_label);

/// One part of every bar.
struct Layer {
  std::string name, colour;
  std::vector<double> values;  ///< a value a bar
};

/// Returns horizontal bars, one per label, of stacked layers.
std::string stacked_bars(const std::vector<std::string>& labels, const std::vector<Layer>& layers,
                         const std::string& unit);

/// Returns the text with &, <, >, " and ' escaped for HTML and SVG, and safe (base/safe_text.hpp).
std::string escaped(const std::string& text);

}  // namespace enfilade
