#include "render/gas_bricks.h"

#include <algorithm>

namespace brisance {
namespace {

constexpr float largestCode = 65535;

}  // namespace

void GasBrick::encode(const GasSample* samples) {
  GasSample::Vector largest{};
  for (int n = 0; n < count; ++n) largest = samples[n].values > largest ? samples[n].values : largest;
  const GasSample::Vector none{};
  scale = largest / largestCode;
  const GasSample::Vector perScale = largest > none ? largestCode / largest : none;
  for (int n = 0; n < count; ++n)
    for (int c = 0; c < 4; ++c) codes[n][c] = static_cast<std::uint16_t>(samples[n].values[c] * perScale[c] + 0.5f);
}

void GasBrick::decode(GasSample* samples) const {
  for (int n = 0; n < count; ++n)
    for (int c = 0; c < 4; ++c) samples[n].values[c] = static_cast<float>(codes[n][c]) * scale[c];
}

GasSample GasBrick::at(const Vec3f& cellsIn) const {
  const auto cell = [](float place) { return std::clamp(static_cast<int>(place), 0, cells - 1); };
  const auto share = [](float place, int first) { return std::clamp(place - static_cast<float>(first), 0.0f, 1.0f); };
  const int x = cell(cellsIn.x), y = cell(cellsIn.y), z = cell(cellsIn.z);
  return between(index(x, y, z), share(cellsIn.x, x), share(cellsIn.y, y), share(cellsIn.z, z));
}

void BrickMemory::reserve(std::int64_t count) {
  if (room >= count) return;
  bricks.reset();
  room = count + count / 2;  // a growing cloud needs more in the next frame; untouched pages cost nothing
  bricks = std::make_unique_for_overwrite<GasBrick[]>(static_cast<std::size_t>(room));
}

}  // namespace brisance
