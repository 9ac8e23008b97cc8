#include "render/piece_picture.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "base/check.h"
#include "small_pictures.h"

namespace brisance {
namespace {

PiecePictureSettings small() {
  PiecePictureSettings settings;
  settings.width = 64;
  settings.height = 48;
  settings.samples = 1;
  return settings;
}

std::vector<FrameBody> twoBalls() {
  return {bodyOf("left", sphereMesh(0.5), "", {{-0.5, 0, 0}, {}}),
          bodyOf("right", sphereMesh(0.5), "", {{0.5, 0, 0}, {}})};
}

/// Pixels that are not background, by column.
std::vector<int> coverage(const Picture& picture) {
  std::vector<int> columns(picture.width, 0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* pixel = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
      columns[x] += std::memcmp(pixel, picture.rgb.data(), 3) != 0;
    }
  return columns;
}

TEST(PiecePicture, HoldsEveryPieceWithAirAround) {
  PiecePictureSettings settings = small();
  for (const double explode : {0.0, 1.0, 5.0}) {
    settings.explode = explode;
    const std::vector<int> columns = coverage(drawPieces(twoBalls(), settings));
    EXPECT_EQ(columns.front(), 0) << explode;
    EXPECT_EQ(columns.back(), 0) << explode;
    EXPECT_GT(*std::max_element(columns.begin(), columns.end()), 0) << explode;
  }
}

TEST(PiecePicture, PullsPiecesApart) {
  PiecePictureSettings settings = small();
  settings.toViewer = {0, 0, 1};
  settings.explode = 1;
  const std::vector<int> columns = coverage(drawPieces(twoBalls(), settings));
  const auto middle = columns.begin() + settings.width / 2;
  EXPECT_EQ(*middle, 0);
  EXPECT_GT(*std::max_element(columns.begin(), middle), 5);
  EXPECT_GT(*std::max_element(middle, columns.end()), 5);
}

TEST(PiecePicture, GivesManyPiecesColoursOfTheirOwn) {
  std::set<std::array<int, 3>> seen;
  for (std::size_t n = 0; n < 64; ++n) {
    const Vec3f colour = pieceColour(n);
    seen.insert({static_cast<int>(colour.x * 64), static_cast<int>(colour.y * 64), static_cast<int>(colour.z * 64)});
    EXPECT_GT(std::max({colour.x, colour.y, colour.z}), 0.2f);
  }
  EXPECT_GE(seen.size(), 60u);
}

TEST(PiecePicture, RefusesToDrawNothing) { EXPECT_THROW(drawPieces({}, small()), InputError); }

}  // namespace
}  // namespace brisance
