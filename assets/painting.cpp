#include "assets/painting.h"

#include <png.h>

#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"

namespace brisance::assets {

double smoothStep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double cellNoise(int x, int y, std::uint64_t seed) {
  const std::uint64_t place =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32 | static_cast<std::uint32_t>(y);
  return Random(seed, Stream::test).uniform(place);
}

double smoothNoise(const Vec2d& p, std::uint64_t seed, int period) {
  const double floorX = std::floor(p.x), floorY = std::floor(p.y);
  const auto wrapped = [&](double cell) {
    const int remainder = static_cast<int>(cell) % period;
    return remainder < 0 ? remainder + period : remainder;
  };
  const int x0 = wrapped(floorX), x1 = wrapped(floorX + 1), y0 = wrapped(floorY), y1 = wrapped(floorY + 1);
  const double sx = smoothStep(0, 1, p.x - floorX), sy = smoothStep(0, 1, p.y - floorY);
  return mix(mix(cellNoise(x0, y0, seed), cellNoise(x1, y0, seed), sx),
             mix(cellNoise(x0, y1, seed), cellNoise(x1, y1, seed), sx), sy);
}

double cloudNoise(const Vec2d& p, const Octaves& octaves) {
  double sum = 0, weight = 1, total = 0;
  int scale = 1;
  for (int i = 0; i < octaves.count; ++i, weight /= 2, scale *= 2) {
    const int period = octaves.period == noRepeat ? noRepeat : octaves.period * scale;
    sum += weight * smoothNoise(p * scale, octaves.seed + static_cast<std::uint64_t>(i), period);
    total += weight;
  }
  return sum / total;
}

namespace {

constexpr int placesAcrossPixel = 3;

Color pixelColor(const Canvas& canvas, const Painting& painting, int column, int row) {
  Color sum;
  for (int j = 0; j < placesAcrossPixel; ++j)
    for (int i = 0; i < placesAcrossPixel; ++i) {
      const double x = column + (i + 0.5) / placesAcrossPixel, y = row + (j + 0.5) / placesAcrossPixel;
      sum += painting({x * canvas.unitsPerPixel, (canvas.height - y) * canvas.unitsPerPixel});
    }
  return sum / (placesAcrossPixel * placesAcrossPixel);
}

std::vector<png_byte> pixels(const Canvas& canvas, const Painting& painting) {
  std::vector<png_byte> bytes(static_cast<std::size_t>(3 * canvas.width * canvas.height));
  parallelFor(0, canvas.height, 1, [&](std::int64_t begin, std::int64_t end) {
    for (auto row = static_cast<int>(begin); row < end; ++row)
      for (int column = 0; column < canvas.width; ++column) {
        const Color color = pixelColor(canvas, painting, column, row);
        for (int c = 0; c < 3; ++c)
          bytes[static_cast<std::size_t>(3 * (row * canvas.width + column) + c)] =
              static_cast<png_byte>(std::clamp(std::lround(color[c] * 255), 0L, 255L));
      }
  });
  return bytes;
}

}  // namespace

void paint(const std::filesystem::path& path, const Canvas& canvas, const Painting& painting) {
  const std::vector<png_byte> bytes = pixels(canvas, painting);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(canvas.width);
  image.height = static_cast<png_uint_32>(canvas.height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0)
    throw Error(ExitCode::noRoom, fmt::format("{}: {}", path.string(), image.message));
}

}  // namespace brisance::assets
