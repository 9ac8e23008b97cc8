// Draws the pictures that scenes put on walls and planes: make_pictures DIRECTORY
#include <cmath>
#include <cstdio>

#include "assets/sky.h"
#include "assets/street.h"
#include "assets/walls.h"
#include "base/check.h"
#include "base/durable_file.h"
#include "render/picture_file.h"

namespace {

using namespace brisance::assets;

/// All directions, as the scene key render.environment has them: longitude from behind over -z, latitude from above.
brisance::Image sky(int width) {
  brisance::Image image(width, width / 2);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) {
      const double polar = brisance::pi * (y + 0.5) / image.height;
      const double around = 2 * brisance::pi * ((x + 0.5) / width - 0.5);
      const double ring = std::sin(polar);
      image(x, y) = skyLight({ring * std::sin(around), std::cos(polar), -ring * std::cos(around)});
    }
  return image;
}

void drawAll(const std::filesystem::path& directory) {
  const Canvas brick{1024, 1024, brickTextureSize / 1024};
  const Canvas plaster{512, 512, plasterTextureSize / 512};
  const Canvas street{1536, 1024, streetWidth / 1536};
  paint(directory / "brick.png", brick, brickTexture);
  paint(directory / "plaster.png", plaster, plasterTexture);
  paint(directory / "street.png", street, streetColor);
  brisance::writeDurably(directory / "sky.exr", brisance::encodeExr(sky(128)));
}

}  // namespace

int main(int argumentCount, char** arguments) {
  if (argumentCount != 2) {
    std::fputs("usage: make_pictures DIRECTORY\n", stderr);
    return static_cast<int>(brisance::ExitCode::badScene);
  }
  try {
    drawAll(arguments[1]);
  } catch (const brisance::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code);
  }
  return 0;
}
