#include "render/denoise_window.h"

#include "base/vector_path.h"

namespace brisance {
namespace {

constexpr int tilePixels = Plane::tileWidth * Plane::tileHeight;
/// How far apart in deviations of the noise surroundings may be and still count.
constexpr float tolerance = 0.6f;
/// Differences of this share of the brightness count as none.
constexpr float indistinct = 0.01f;
/// The same of means over surroundings.
constexpr float meanTolerance = 2, meanIndistinct = 0.1f;
/// By how much of the brightness the light is expected to change over the window, and along each guide from 0 to 1.
constexpr float placeSlope = 0.3f, guideSlope = 1;
/// Keeps the normal equations of a single neighbour solvable.
constexpr float leastRestraint = 1e-4f;

/// (1 - d / 4)^4 instead of e^-d.
inline float fading(float difference) {
  const float rest = std::clamp(1 - 0.25f * difference, 0.0f, 1.0f), squared = rest * rest;
  return squared * squared;
}

}  // namespace

TileFilter::TileFilter(const FilterInput& input)
    : input_(input),
      weights_(static_cast<std::size_t>(neighbours) * tilePixels),
      compared_(comparedWidth * comparedHeight) {}

void TileFilter::run(int left, int top, FilterSums& sums) {
  for (int half = 0; half < 2; ++half) {
    runWide([&] { weigh(1 - half, left, top); });
    for (int row = 0; row < Plane::tileHeight; ++row) runWide([&] { regress(half, left, top + row, row, sums); });
  }
}

void TileFilter::weigh(int half, int left, int top) {
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      compare(half, left, top, dx, dy);
      const int neighbour = (dy + radius) * windowWidth + dx + radius;
      weighByPatches(neighbour, left, top, dx, dy);
      weighByMeans(half, neighbour, left, top, dx, dy);
    }
}

/// The squared difference of each pixel to its neighbour, less what noise makes of it, over what noise may make.
void TileFilter::compare(int half, int left, int top, int dx, int dy) {
  std::fill(compared_.begin(), compared_.end(), 0.0f);
  for (int row = 0; row < comparedHeight; ++row) {
    const int y = top + row - patchRadius, x = left - patchRadius;
    const float* brightness = input_.brightness.row(y) + x;
    float* to = compared_.data() + row * comparedWidth;
    for (int c = 0; c < 3; ++c) {
      const float *here = input_.light[half][c].row(y) + x, *there = input_.light[half][c].row(y + dy) + x + dx;
      const float *noiseHere = input_.variance[c].row(y) + x, *noiseThere = input_.variance[c].row(y + dy) + x + dx;
      for (int n = 0; n < comparedWidth; ++n) {
        const float difference = here[n] - there[n], least = indistinct * brightness[n];
        const float noise = noiseHere[n] + std::min(noiseHere[n], noiseThere[n]);
        const float allowed = tolerance * tolerance * (noiseHere[n] + noiseThere[n]) + least * least + 1e-12f;
        to[n] += (difference * difference - noise) / allowed;
      }
    }
  }
}

/// By the mean difference over a patch.
void TileFilter::weighByPatches(int neighbour, int left, int top, int dx, int dy) {
  constexpr float share = 1.0f / (3 * (2 * patchRadius + 1) * (2 * patchRadius + 1));
  for (int row = 0; row < Plane::tileHeight; ++row) {
    float columns[comparedWidth] = {};
    for (int r = row; r <= row + 2 * patchRadius; ++r)
      for (int n = 0; n < comparedWidth; ++n) columns[n] += compared_[r * comparedWidth + n];
    float* to = weights_.data() + neighbour * tilePixels + row * Plane::tileWidth;
    const float *inside = input_.inside.row(top + row) + left,
                *insideThere = input_.inside.row(top + row + dy) + left + dx;
    for (int n = 0; n < Plane::tileWidth; ++n) {
      float sum = 0;
      for (int d = 0; d <= 2 * patchRadius; ++d) sum += columns[n + d];
      to[n] = fading(sum * share) * inside[n] * insideThere[n];
    }
  }
}

/// Means over the surroundings have little noise: they tell a shadow from the light beside it where single pixels do
/// not.
void TileFilter::weighByMeans(int half, int neighbour, int left, int top, int dx, int dy) {
  for (int row = 0; row < Plane::tileHeight; ++row) {
    const int y = top + row;
    const Plane &means = input_.brightnessOfHalf[half], &noises = input_.brightnessVariance;
    const float *mean = means.row(y) + left, *meanThere = means.row(y + dy) + left + dx;
    const float *noise = noises.row(y) + left, *noiseThere = noises.row(y + dy) + left + dx;
    float* to = weights_.data() + neighbour * tilePixels + row * Plane::tileWidth;
    for (int n = 0; n < Plane::tileWidth; ++n) {
      const float difference = mean[n] - meanThere[n], least = meanIndistinct * mean[n];
      const float allowed = meanTolerance * meanTolerance * (noise[n] + noiseThere[n]) + least * least + 1e-12f;
      to[n] *= fading(difference * difference / allowed);
    }
  }
}

void TileFilter::regress(int half, int left, int y, int rowInTile, FilterSums& sums) {
  for (int x = 0; x < Plane::tileWidth; x += lanes) {
    const float* weights = weights_.data() + rowInTile * Plane::tileWidth + x;
    gather(half, left + x, y, weights, fit_);
    restrain(left + x, y, fit_);
    solve(fit_);
    spread(left + x, y, weights, fit_, sums);
  }
}

/// What the unknowns are multiplied by at a neighbour.
void TileFilter::factorsAt(int x, int y, int dx, int dy, Factors& factors) const {
  std::fill_n(factors[0], lanes, 1.0f);
  std::fill_n(factors[1], lanes, static_cast<float>(dx) / radius);
  std::fill_n(factors[2], lanes, static_cast<float>(dy) / radius);
  for (int g = 0; g < guideCount; ++g) {
    const float *here = input_.guides[g].row(y) + x, *there = input_.guides[g].row(y + dy) + x + dx;
    for (int n = 0; n < lanes; ++n) factors[3 + g][n] = there[n] - here[n];
  }
}

/// The sums of the normal equations: of products of the unknowns' factors, and of those with the light.
void TileFilter::gather(int half, int x, int y, const float* weights, Fit& fit) const {
  std::fill_n(&fit.matrix[0][0], products * lanes, 0.0f);
  std::fill_n(&fit.right[0][0][0], 3 * unknowns * lanes, 0.0f);
  Factors factors;
  float weighed[lanes];
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx, weights += tilePixels) {
      factorsAt(x, y, dx, dy, factors);
      const float* light[3];
      for (int c = 0; c < 3; ++c) light[c] = input_.light[half][c].row(y + dy) + x + dx;
      int product = 0;
      for (int i = 0; i < unknowns; ++i) {
        for (int n = 0; n < lanes; ++n) weighed[n] = weights[n] * factors[i][n];
        for (int j = 0; j <= i; ++j, ++product)
          for (int n = 0; n < lanes; ++n) fit.matrix[product][n] += weighed[n] * factors[j][n];
        for (int c = 0; c < 3; ++c)
          for (int n = 0; n < lanes; ++n) fit.right[c][i][n] += weighed[n] * light[c][n];
      }
    }
}

/// Each fit tells the light of all neighbours that count for it (collaborative regression, Bitterli et al. 2016).
void TileFilter::spread(int x, int y, const float* weights, const Fit& fit, FilterSums& sums) const {
  Factors factors;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx, weights += tilePixels) {
      factorsAt(x, y, dx, dy, factors);
      for (int c = 0; c < 3; ++c) {
        float value[lanes] = {};
        for (int i = 0; i < unknowns; ++i)
          for (int n = 0; n < lanes; ++n) value[n] += fit.right[c][i][n] * factors[i][n];
        float* to = sums.light[c].row(y + dy) + x + dx;
        for (int n = 0; n < lanes; ++n) to[n] += weights[n] * value[n];
      }
      float* to = sums.weight.row(y + dy) + x + dx;
      for (int n = 0; n < lanes; ++n) to[n] += weights[n];
    }
}

/// Slopes are held to what is likely, the more the noisier the light (ridge regression).
void TileFilter::restrain(int x, int y, Fit& fit) const {
  for (int n = 0; n < lanes; ++n) {
    float noise = 0;
    for (int c = 0; c < 3; ++c) noise += input_.variance[c].row(y)[x + n] / 3;
    const float brightness = input_.brightness.row(y)[x + n];
    const float relative = noise / (brightness * brightness + 1e-12f);
    fit.matrix[0][n] += 1e-6f;
    for (int i = 1; i < unknowns; ++i) {
      const float slope = i < 3 ? placeSlope : guideSlope;
      fit.matrix[i * (i + 3) / 2][n] += relative / (slope * slope) + leastRestraint;
    }
  }
}

/// Cholesky's decomposition of all lanes, and both substitutions; the unknowns end in right[c].
void TileFilter::solve(Fit& fit) {
  const auto at = [&fit](int i, int j) { return fit.matrix[i * (i + 1) / 2 + j]; };
  float* right[3][unknowns];
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < unknowns; ++i) right[c][i] = fit.right[c][i];
  for (int j = 0; j < unknowns; ++j) {
    float* pivot = at(j, j);
    for (int n = 0; n < lanes; ++n) pivot[n] = 1 / std::sqrt(std::max(pivot[n], 1e-12f));
    for (int i = j + 1; i < unknowns; ++i)
      for (int n = 0; n < lanes; ++n) at(i, j)[n] *= pivot[n];
    for (int i = j + 1; i < unknowns; ++i)
      for (int k = j + 1; k <= i; ++k)
        for (int n = 0; n < lanes; ++n) at(i, k)[n] -= at(i, j)[n] * at(k, j)[n];
  }
  for (auto& side : right) {
    for (int i = 0; i < unknowns; ++i) {
      for (int j = 0; j < i; ++j)
        for (int n = 0; n < lanes; ++n) side[i][n] -= at(i, j)[n] * side[j][n];
      for (int n = 0; n < lanes; ++n) side[i][n] *= at(i, i)[n];
    }
    for (int i = unknowns - 1; i >= 0; --i) {
      for (int j = i + 1; j < unknowns; ++j)
        for (int n = 0; n < lanes; ++n) side[i][n] -= at(j, i)[n] * side[j][n];
      for (int n = 0; n < lanes; ++n) side[i][n] *= at(i, i)[n];
    }
  }
}

}  // namespace brisance
