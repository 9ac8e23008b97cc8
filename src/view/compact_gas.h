// The gas that the picture draws, small enough for a browser: two bytes a cell on a lattice of bounded size.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/drawn_volume.h"
#include "view/heat_scale.h"

namespace brisance {

struct CompactGas {
  Vec3i size;                         ///< [cells]
  Vec3d origin;                       ///< [m] centre of the first cell
  double cellSize = 0;                ///< [m]
  std::vector<std::uint8_t> density;  ///< root of the share of the full density, 0 .. densityLevels - 1; x fastest
  std::vector<std::uint8_t> heat;     ///< of HeatScale, 0 .. heatLevels - 1; where there is no density it says nothing
};

/// As few as eyes need: a ray's sum over cells hides the steps.
constexpr int densityLevels = 64, heatLevels = 32;
constexpr int mostCells = 96;  ///< along each axis

/// Nothing where the picture would draw none. Cells are as fine as the picture's, as the blur makes sensible, and as
/// fit into the box that the gas fills at this moment, `cells` along each axis.
std::optional<CompactGas> compactGas(const Frame& frame, const VolumeSettings& settings, const BlackbodyColours& heat,
                                     const HeatScale& scale, int cells = mostCells);

/// Values less what their neighbours foretell, slice by slice along z: the median of left, below, and left + below -
/// lower left (Weinberger, Seroussi & Sapiro 2000, LOCO-I); on the rims the neighbour that there is. Smooth fields
/// become small numbers.
std::vector<std::uint8_t> residuals(const std::vector<std::uint8_t>& values, const Vec3i& size);
/// The same for values that count only where `mask` is not 0: elsewhere the residual is 0.
std::vector<std::uint8_t> residuals(const std::vector<std::uint8_t>& values, const std::vector<std::uint8_t>& mask,
                                    const Vec3i& size);

}  // namespace brisance
