// The colour of hot things (appendix A.2.1).
#pragma once

#include <vector>

#include "render/render_settings.h"

namespace brisance {

/// Planck's law: spectral exitance [W/m3] of a black body at `wavelength` [m] and `temperature` [K].
double planckExitance(double wavelength, double temperature);

/// CIE 1931 X, Y, Z per wavelength [m] (Wyman, Sloan & Shirley 2013, the multi-lobe fit).
Vec3d colourMatching(double wavelength);

/// Planck's law integrated against the CIE 1931 curves, in linear sRGB without exposure; colours outside sRGB are
/// brought to its edge with their luminance kept. Luminance in W/m2 of exitance weighted by the curve Y.
Vec3d blackbodyLight(double temperature);

/// One of the maps from temperature to colour, tabulated: exact to a percent between 300 and 10000 K, black below and
/// constant above.
class BlackbodyColours {
 public:
  explicit BlackbodyColours(const BlackbodyMap& map);
  Vec3f operator()(float temperature) const;

 private:
  std::vector<Vec3f> table_;
};

}  // namespace brisance
