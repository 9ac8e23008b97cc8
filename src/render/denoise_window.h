// The windows of the noise filter: how alike neighbours are, and the regression over them.
#pragma once

#include <vector>

#include "render/denoise_planes.h"

namespace brisance {

struct FilterInput {
  std::array<ColourPlanes, 2> light;      ///< of two independent halves of the samples
  ColourPlanes variance;                  ///< of either
  Plane brightness;                       ///< mean of the light around each pixel
  std::array<Plane, 2> brightnessOfHalf;  ///< the same of each half,
  Plane brightnessVariance;               ///< and the variance of those means
  std::vector<Plane> guides;              ///< what the light may depend on
  Plane inside;                           ///< 1 in the picture, 0 around it
};

/// What all regressions say of a pixel: the weighed sum of their values there, and of their weights.
struct FilterSums {
  ColourPlanes light;
  Plane weight;
  FilterSums(int width, int height) : weight(width, height) { light.fill(Plane(width, height)); }
};

/// Filters tile after tile with the same memory.
class TileFilter {
 public:
  static constexpr int guideCount = 8;

  explicit TileFilter(const FilterInput& input);
  static constexpr int radius = 8;  ///< of the window [pixels]: so far around a tile its regressions add to the sums
  /// The tile whose upper left pixel is (left, top).
  void run(int left, int top, FilterSums& sums);

 private:
  static constexpr int patchRadius = 3;  // of what is compared [pixels]
  static constexpr int windowWidth = 2 * radius + 1, neighbours = windowWidth * windowWidth;
  static constexpr int lanes = 16;                 // pixels that are fitted side by side
  static constexpr int unknowns = 3 + guideCount;  // value, slopes in x and y and along the guides
  static constexpr int products = unknowns * (unknowns + 1) / 2;
  static_assert(radius + patchRadius <= Plane::rim);

  using Factors = float[unknowns][lanes];
  void factorsAt(int x, int y, int dx, int dy, Factors& factors) const;

  struct Fit {
    float matrix[products][lanes];
    float right[3][unknowns][lanes];
  };

  void weigh(int half, int left, int top);
  void compare(int half, int left, int top, int dx, int dy);
  void weighByPatches(int neighbour, int left, int top, int dx, int dy);
  void weighByMeans(int half, int neighbour, int left, int top, int dx, int dy);
  void regress(int half, int left, int y, int rowInTile, FilterSums& sums);
  void gather(int half, int x, int y, const float* weights, Fit& fit) const;
  void spread(int x, int y, const float* weights, const Fit& fit, FilterSums& sums) const;
  void restrain(int x, int y, Fit& fit) const;
  static void solve(Fit& fit);

  static constexpr int comparedWidth = Plane::tileWidth + 2 * patchRadius,
                       comparedHeight = Plane::tileHeight + 2 * patchRadius;
  const FilterInput& input_;
  std::vector<float> weights_;  // [neighbour][row][column] of the tile
  std::vector<float> compared_;
  Fit fit_;
};

}  // namespace brisance
