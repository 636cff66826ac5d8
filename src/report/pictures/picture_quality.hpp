// How good a picture of a solution need be.
#pragma once

#include "report/pictures/render.hpp"

namespace enfilade {

/// Returns how to render a solution whose light was asked for with this relative error. Up to the
/// default target error (2 %) it is the default of RenderConfig; a rougher solution gets fewer
/// pixels, samples, places and rays, down to what 10 % and more gets: two thirds of the width, and
/// a quarter of the rays at places that lie half as far again from each other.
RenderConfig picture_quality(double asked_error);

}  // namespace enfilade
