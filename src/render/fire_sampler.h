// Places in the fire, drawn by how much they shine, so that fire lights the walls.
#pragma once

#include <array>
#include <vector>

#include "render/gas_medium.h"

namespace brisance {

struct FireSample {
  Vec3f place;       ///< [m]
  Vec3f emission;    ///< [radiance/m]
  float density;     ///< [1/m3]
  float extinction;  ///< [1/m]
};

/// Draws blocks of the gas by the luminance that leaves the gas from there, within a block a cell by what it gives
/// off, and places evenly within a cell. (These cells lie between samples: sample (i, j, k) is the lower corner of cell
/// (i, j, k).)
class FireSampler {
 public:
  explicit FireSampler(const GasMedium& gas);
  bool isDark() const { return upTo_.empty(); }
  /// `choice` of the block and of the cell, `across` and `along` of the place. Not to be called where it is dark.
  FireSample sample(const Vec2<float>& choice, const Vec2<float>& across, float along) const;
  /// With which density [1/m3] sample() draws a place [cells] of a block, by its number.
  /// Beyond the outermost samples none is drawn.
  float density(std::int32_t block, const Vec3f& place) const;

 private:
  static constexpr int side = GasMedium::blockCells, cellsOfBlock = side * side * side;
  struct Block {
    Vec3i block;
    float share = 0;                         ///< of all draws
    std::array<float, cellsOfBlock> upTo{};  ///< of the draws in this block, up to each cell
    float cellShare(int cell) const { return cell == 0 ? upTo[0] : upTo[cell] - upTo[cell - 1]; }
  };
  float weighCells(Block& block) const;
  static Vec3i cornerOf(const Block& block, int cell);

  const GasMedium& gas_;
  std::vector<Block> blocks_;
  std::vector<double> upTo_;  ///< share of the blocks up to each
  Grid3<int> numbers_;        ///< of the blocks, -1: dark
};

}  // namespace brisance
