// Draws the pictures that scenes put on walls and planes: make_pictures DIRECTORY
#include <cstdio>

#include "assets/street.h"
#include "assets/walls.h"
#include "base/check.h"

namespace {

using namespace brisance::assets;

void drawAll(const std::filesystem::path& directory) {
  const Canvas brick{1024, 1024, brickTextureSize / 1024};
  const Canvas plaster{512, 512, plasterTextureSize / 512};
  const Canvas street{1536, 1024, streetWidth / 1536};
  paint(directory / "brick.png", brick, brickTexture);
  paint(directory / "plaster.png", plaster, plasterTexture);
  paint(directory / "street.png", street, streetColor);
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
