// Pictures as functions of place: colours, noise, and how a function becomes a PNG.
#pragma once

#include <filesystem>
#include <functional>

#include "base/math.h"

namespace brisance::assets {

using Color = Vec3d;  ///< red, green, blue as shown on a screen, 0 to 1

inline double mix(double a, double b, double share) { return a + (b - a) * share; }
inline Color mix(const Color& a, const Color& b, double share) { return a + (b - a) * share; }
/// 0 below `from`, 1 above `to`, smooth between; falls if to < from.
double smoothStep(double from, double to, double x);
/// 1 inside the interval, 0 outside.
inline double within(double x, double from, double to) { return x >= from && x < to ? 1.0 : 0.0; }
inline double fraction(double x) { return x - std::floor(x); }

/// In [0, 1), its own for each lattice point and each `seed`.
double cellNoise(int x, int y, std::uint64_t seed);

/// Smooth noise of cell size 1, in [0, 1]; repeats every `period` cells in both directions.
constexpr int noRepeat = 1 << 20;
double smoothNoise(const Vec2d& p, std::uint64_t seed, int period = noRepeat);
/// Octaves of smooth noise, each twice as fine and half as strong; mean 0.5.
struct Octaves {
  int count = 4;
  std::uint64_t seed = 1;
  int period = noRepeat;
};
double cloudNoise(const Vec2d& p, const Octaves& octaves);

/// Colour at a place: x to the right, y up, in the painting's own units.
using Painting = std::function<Color(const Vec2d&)>;
struct Canvas {
  int width, height;     ///< [pixels]
  double unitsPerPixel;  ///< of the painting
};
/// Writes a PNG; each pixel is the mean of 3 x 3 places in it.
void paint(const std::filesystem::path& path, const Canvas& canvas, const Painting& painting);

}  // namespace brisance::assets
