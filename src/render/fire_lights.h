// The burning gas as a few point lights, so that fire lights the walls.
#pragma once

#include <vector>

#include "render/gas_medium.h"

namespace brisance {

/// A cluster of glowing gas as one point.
struct FirePoint {
  Vec3f position;
  Vec3f intensity;   ///< radiance times area [m2]: at distance r it lights a facing surface with intensity / r^2
  float radius = 0;  ///< [m] root mean square distance of the glow from `position`, of half a block at least
};

/// The share of light that leaves the gas from the middle of each block: the mean over the six directions of the axes.
/// `extinction` [1/m].
Grid3<float> escapeOf(const Grid3<float>& extinction);

/// A block of the gas and what of its glow leaves the gas.
struct GlowingBlock {
  Vec3i block;
  Vec3d place;      ///< [m] its middle
  Vec3d intensity;  ///< as of a FirePoint
  double luminance;
};
std::vector<GlowingBlock> glowingBlocks(const GasMedium& gas);

/// Splits the glow into at most `count` clusters of about equal luminance, by weighted medians along the longest axis.
///
/// In the optically thin limit the radiance of a ray is the integral of extinction times glow along it, so a small
/// volume V of gas has the intensity sum(extinction glow V): the points then light a surface exactly as the seen fire
/// would. In thick gas each block's glow counts by the mean, over the six directions of the axes, of the share that
/// leaves the gas.
std::vector<FirePoint> findFirePoints(const GasMedium& gas, int count);

}  // namespace brisance
