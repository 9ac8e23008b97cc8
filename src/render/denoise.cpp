#include "render/denoise.h"

#include <cmath>

#include "base/parallel.h"
#include "render/denoise_window.h"

namespace brisance {
namespace {

/// Added to the albedo by which light is divided: black surfaces may still mirror.
constexpr float darkestAlbedo = 0.005f;
/// Half the width of the squares over which variance and brightness are measured.
constexpr int measuredRadius = 3, measuredPixels = (2 * measuredRadius + 1) * (2 * measuredRadius + 1);
/// A value beyond this many times the mean of its surroundings is a lucky path's: it counts as that much.
constexpr float mostOfSurroundings = 4;

/// Light that chance decides over albedo, of one half of the samples.
ColourPlanes chancePart(const Image& light, const Image& certain, const Image& albedo) {
  ColourPlanes planes;
  for (int c = 0; c < 3; ++c) {
    planes[c] = Plane(light.width, light.height);
    for (int y = 0; y < light.height; ++y)
      for (int x = 0; x < light.width; ++x)
        planes[c].row(y)[x] = (light(x, y)[c] - certain(x, y)[c]) / (albedo(x, y)[c] + darkestAlbedo);
    planes[c].fillRim();
  }
  return planes;
}

/// Limits what is far brighter than all around it.
void limitOutliers(ColourPlanes& planes) {
  constexpr float others = measuredPixels - 1;
  for (Plane& plane : planes) {
    const Plane mean = boxMean(plane, measuredRadius);
    for (int y = 0; y < plane.height(); ++y)
      for (int x = 0; x < plane.width(); ++x) {
        float& value = plane.row(y)[x];
        const float around = (mean.row(y)[x] * (others + 1) - value) / others;
        value = std::min(value, std::max(mostOfSurroundings * around, 0.0f));
      }
    plane.fillRim();
  }
}

/// The variance of a half from how the two differ, smoothed since each difference is a single draw.
ColourPlanes varianceOfHalf(const ColourPlanes& a, const ColourPlanes& b) {
  ColourPlanes variance;
  for (int c = 0; c < 3; ++c) {
    Plane squares(a[c].width(), a[c].height());
    for (int y = 0; y < squares.height(); ++y)
      for (int x = 0; x < squares.width(); ++x) {
        const float difference = a[c].row(y)[x] - b[c].row(y)[x];
        squares.row(y)[x] = 0.5f * difference * difference;
      }
    squares.fillRim();
    variance[c] = boxMean(squares, measuredRadius);
    variance[c].fillRim();
  }
  return variance;
}

/// Mean over the colours and the surroundings.
Plane brightnessOf(const ColourPlanes& light) {
  Plane sum(light[0].width(), light[0].height());
  for (int y = 0; y < sum.height(); ++y)
    for (int x = 0; x < sum.width(); ++x)
      for (int c = 0; c < 3; ++c) sum.row(y)[x] += light[c].row(y)[x] / 3;
  sum.fillRim();
  Plane mean = boxMean(sum, measuredRadius);
  mean.fillRim();
  return mean;
}

/// a + b, times a factor.
Plane sumOf(const Plane& a, const Plane& b, float factor) {
  Plane sum(a.width(), a.height());
  for (int y = 0; y < sum.height(); ++y)
    for (int x = 0; x < sum.width(); ++x) sum.row(y)[x] = factor * (a.row(y)[x] + b.row(y)[x]);
  sum.fillRim();
  return sum;
}

std::vector<Plane> guidePlanes(const PictureGuides& guides) {
  std::vector<Plane> planes;
  const int width = guides.albedo.width, height = guides.albedo.height;
  const auto add = [&](const auto& valueAt) {
    Plane& plane = planes.emplace_back(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) plane.row(y)[x] = valueAt(static_cast<std::size_t>(y) * width + x);
    plane.fillRim();
  };
  for (int c = 0; c < 3; ++c) add([&](std::size_t p) { return guides.albedo.pixels[p][c]; });
  for (int c = 0; c < 3; ++c) add([&](std::size_t p) { return guides.normal.pixels[p][c]; });
  add([&](std::size_t p) { return guides.nearness[p]; });
  add([&](std::size_t p) { return guides.clearness[p]; });
  return planes;
}

/// 1 in the picture, 0 on its rim.
Plane insideOf(int width, int height) {
  Plane inside(width, height);
  for (int y = 0; y < height; ++y) std::fill(inside.row(y), inside.row(y) + width, 1.0f);
  return inside;
}

/// All tiles, in four turns: tiles of one turn are so far apart that their windows do not meet, so that the sums are
/// the same for any number of threads.
ColourPlanes regressed(const FilterInput& input, int width, int height) {
  static_assert(2 * TileFilter::radius <= std::min(Plane::tileWidth, Plane::tileHeight));
  FilterSums sums(width, height);
  const int columns = (width + Plane::tileWidth - 1) / Plane::tileWidth;
  const int rows = (height + Plane::tileHeight - 1) / Plane::tileHeight;
  for (int turn = 0; turn < 4; ++turn) {
    const int firstColumn = turn % 2, firstRow = turn / 2;
    const int across = (columns + 1 - firstColumn) / 2, down = (rows + 1 - firstRow) / 2;
    parallelFor(0, static_cast<std::int64_t>(across) * down, 1, [&](std::int64_t first, std::int64_t last) {
      TileFilter filter(input);
      for (std::int64_t tile = first; tile < last; ++tile)
        filter.run((firstColumn + 2 * static_cast<int>(tile % across)) * Plane::tileWidth,
                   (firstRow + 2 * static_cast<int>(tile / across)) * Plane::tileHeight, sums);
    });
  }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (Plane& plane : sums.light) plane.row(y)[x] /= std::max(sums.weight.row(y)[x], 1e-12f);
  return std::move(sums.light);
}

Image recombined(const PictureGuides& guides, const ColourPlanes& filtered) {
  Image image = guides.certain;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image(x, y)[c] += std::max(filtered[c].row(y)[x], 0.0f) * (guides.albedo(x, y)[c] + darkestAlbedo);
  return image;
}

}  // namespace

Plane boxMean(const Plane& plane, int radius) {
  Plane mean(plane.width(), plane.height());
  const float share = 1.0f / static_cast<float>((2 * radius + 1) * (2 * radius + 1));
  parallelFor(0, plane.height(), 16, [&](std::int64_t first, std::int64_t last) {
    std::vector<float> columns(static_cast<std::size_t>(plane.width()) + 2 * Plane::rim);
    for (int y = static_cast<int>(first); y < last; ++y) {
      std::fill(columns.begin(), columns.end(), 0.0f);
      for (int dy = -radius; dy <= radius; ++dy)
        for (int x = -radius; x < plane.width() + radius; ++x) columns[x + radius] += plane.row(y + dy)[x];
      for (int x = 0; x < plane.width(); ++x) {
        float sum = 0;
        for (int dx = 0; dx <= 2 * radius; ++dx) sum += columns[x + dx];
        mean.row(y)[x] = sum * share;
      }
    }
  });
  return mean;
}

Image denoised(const Exposed& picture, const PictureGuides& guides) {
  const int width = picture.mean.width, height = picture.mean.height;
  FilterInput input;
  for (int half = 0; half < 2; ++half) {
    input.light[half] = chancePart(picture.halves[half], guides.certainOfHalf[half], guides.albedoOfHalf[half]);
    limitOutliers(input.light[half]);
  }
  input.variance = varianceOfHalf(input.light[0], input.light[1]);
  for (int half = 0; half < 2; ++half) input.brightnessOfHalf[half] = brightnessOf(input.light[half]);
  input.brightness = sumOf(input.brightnessOfHalf[0], input.brightnessOfHalf[1], 0.5f);
  const Plane ofOne = brightnessOf(input.variance);
  input.brightnessVariance = sumOf(ofOne, ofOne, 0.5f / measuredPixels);
  input.guides = guidePlanes(guides);
  input.inside = insideOf(width, height);
  const ColourPlanes filtered = regressed(input, width, height);
  return recombined(guides, filtered);
}

}  // namespace brisance
