#include "render/denoise_window.h"

#include "base/vector_path.h"
#include <cstdlib>

namespace brisance {
namespace {

constexpr int tilePixels = Plane::tileWidth * Plane::tileHeight;
/// How far apart in deviations of the noise surroundings may be and still count.
const float tolerance = getenv("XT") ? float(atof(getenv("XT"))) : 0.6f;
const float XA = getenv("XA") ? float(atof(getenv("XA"))) : 1;
/// Differences of this share of the brightness count as none.
constexpr float indistinct = 0.01f;
/// By how much of the brightness the light is expected to change over the window, and along each guide from 0 to 1.
constexpr float placeSlope = 0.3f, guideSlope = 1;
/// Keeps the normal equations of a single neighbour solvable.
constexpr float leastRestraint = 1e-4f;

}  // namespace

TileFilter::TileFilter(const FilterInput& input)
    : input_(input),
      weights_(static_cast<std::size_t>(neighbours) * tilePixels),
      compared_(comparedWidth * comparedHeight) {}

void TileFilter::run(int left, int top, ColourPlanes& filtered) {
  for (int half = 0; half < 2; ++half) {
    runWide([&] { weigh(1 - half, left, top); });
    for (int row = 0; row < Plane::tileHeight; ++row) runWide([&] { regress(half, left, top + row, row, filtered); });
  }
}

void TileFilter::weigh(int half, int left, int top) {
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      compare(half, left, top, dx, dy);
      weighByPatches((dy + radius) * windowWidth + dx + radius, left, top, dx, dy);
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

/// (1 - d / 4)^4 instead of e^-d of the mean difference d over a patch.
void TileFilter::weighByPatches(int neighbour, int left, int top, int dx, int dy) {
  constexpr float share = 1.0f / (3 * (2 * patchRadius + 1) * (2 * patchRadius + 1));
  for (int row = 0; row < Plane::tileHeight; ++row) {
    float columns[comparedWidth] = {};
    for (int r = row; r <= row + 2 * patchRadius; ++r)
      for (int n = 0; n < comparedWidth; ++n) columns[n] += compared_[r * comparedWidth + n];
    float* to = weights_.data() + neighbour * tilePixels + row * Plane::tileWidth;
    const float* inside = input_.inside.row(top + row + dy) + left + dx;
    for (int n = 0; n < Plane::tileWidth; ++n) {
      float sum = 0;
      for (int d = 0; d <= 2 * patchRadius; ++d) sum += columns[n + d];
      const float rest = std::clamp(1 - 0.25f * sum * share, 0.0f, 1.0f);
      to[n] = rest * rest * rest * rest * inside[n];
    }
  }
}

void TileFilter::regress(int half, int left, int y, int rowInTile, ColourPlanes& filtered) {
  for (int x = 0; x < Plane::tileWidth; x += lanes) {
    gather(half, left + x, y, weights_.data() + rowInTile * Plane::tileWidth + x, fit_);
    restrain(left + x, y, fit_);
    solve(fit_);
    for (int c = 0; c < 3; ++c) {
      float* to = filtered[c].row(y) + left + x;
      for (int n = 0; n < lanes; ++n) to[n] += 0.5f * fit_.right[c][0][n];
    }
  }
}

/// The sums of the normal equations: of products of the unknowns' factors, and of those with the light.
void TileFilter::gather(int half, int x, int y, const float* weights, Fit& fit) const {
  std::fill_n(&fit.matrix[0][0], products * lanes, 0.0f);
  std::fill_n(&fit.right[0][0][0], 3 * unknowns * lanes, 0.0f);
  float factors[unknowns][lanes], weighed[lanes];
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx, weights += tilePixels) {
      std::fill_n(factors[0], lanes, 1.0f);
      std::fill_n(factors[1], lanes, static_cast<float>(dx) / radius);
      std::fill_n(factors[2], lanes, static_cast<float>(dy) / radius);
      for (int g = 0; g < guideCount; ++g) {
        const float *here = input_.guides[g].row(y) + x, *there = input_.guides[g].row(y + dy) + x + dx;
        for (int n = 0; n < lanes; ++n) factors[3 + g][n] = there[n] - here[n];
      }
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

/// Slopes are held to what is likely, the more the noisier the light (ridge regression).
void TileFilter::restrain(int x, int y, Fit& fit) const {
  for (int n = 0; n < lanes; ++n) {
    float noise = 0;
    for (int c = 0; c < 3; ++c) noise += input_.variance[c].row(y)[x + n] / 3;
    const float brightness = input_.brightness.row(y)[x + n];
    const float relative = noise / (brightness * brightness + 1e-12f);
    fit.matrix[0][n] += 1e-6f;
    for (int i = 1; i < unknowns; ++i) {
      const float slope = i < 3 ? placeSlope : i < 6 ? XA : guideSlope;
      fit.matrix[i * (i + 3) / 2][n] += relative / (slope * slope) + leastRestraint;
    }
  }
}

/// Cholesky's decomposition of all lanes, and both substitutions; the values end in right[c][0].
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
