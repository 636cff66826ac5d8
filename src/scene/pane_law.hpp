// How much of the light a pane of glass passes, by the angle at which the light meets it.
#pragma once

namespace enfilade {

/// Returns the transmittance of a pane for light whose direction makes an angle of this cosine with
/// its normal, relative to that at normal incidence (1 there, 0 at grazing incidence, in between
/// falling). A single clear glazing: Fresnel's equations for a slab of refractive index 1.52 with
/// all reflections between its two faces, T = (1 - r) / (1 + r), the mean over both polarizations
/// (Born and Wolf, Principles of Optics). A pane's given normal transmittance scales it, for each
/// band alike. CIE 171:2006, sections 5.10 and 5.12, tabulate such a pane.
double pane_share(double cosine);

/// Normal transmittance of a clear pane without absorption by the same equations: 0.918. More than
/// this no real single pane has.
double clear_pane_transmittance();

}  // namespace enfilade
