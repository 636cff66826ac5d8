#include "links/terms/error_terms.hpp"

#include <cmath>

namespace enfilade {

double curvature_error(double center, double mean) { return 0.5 * std::abs(center - mean); }

double saddle_error(double saddle) { return 0.7 * std::abs(saddle); }

double slope_error(double slope1, double slope2) { return 0.8 * std::hypot(slope1, slope2); }

double rim_error(double rim, double seen) { return 0.25 * rim * seen; }

double peak_error(double missed, double seen) { return missed * seen; }

double receiver_error(const ReceiverSamples& s, int terms) {
  double error = curvature_error(s.center, s.fit.mean) + saddle_error(s.fit.saddle) +
                 rim_error(s.rim, s.seen) + peak_error(s.missed, s.seen) + s.unfit;
  if (terms == 1) error += slope_error(s.fit.slope1, s.fit.slope2);
  return error;
}

double visibility_error(double area_factor, double uncertainty) {
  return area_factor * uncertainty;
}

}  // namespace enfilade
