#include "render/textures.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "base/durable_file.h"
#include "render/picture_file.h"
#include "scratch_directory.h"

using namespace brisance;

namespace {

/// Upper row red, green; lower row blue, white.
Picture fourColours() { return {2, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}}; }

}  // namespace

TEST(Texture, UGoesRightAndVGoesUp) {
  const PictureTexture texture(fourColours());
  EXPECT_EQ(texture.at(0.25, 0.25), Vec3f(0, 0, 1));  // the centre of the lower left pixel
  EXPECT_EQ(texture.at(0.75, 0.25), Vec3f(1, 1, 1));
  EXPECT_EQ(texture.at(0.25, 0.75), Vec3f(1, 0, 0));
  EXPECT_EQ(texture.at(0.75, 0.75), Vec3f(0, 1, 0));
}

TEST(Texture, RepeatsInAllDirections) {
  const PictureTexture texture(fourColours());
  for (const double shift : {-3.0, -1.0, 1.0, 7.0}) {
    EXPECT_EQ(texture.at(0.25 + shift, 0.75), Vec3f(1, 0, 0));
    EXPECT_EQ(texture.at(0.25, 0.75 + shift), Vec3f(1, 0, 0));
  }
}

TEST(Texture, MixesLightBetweenPixelsNotCodes) {
  const PictureTexture texture(Picture{2, 1, {0, 0, 0, 255, 255, 255}});
  EXPECT_NEAR(texture.at(0.5, 0.5).x, 0.5, 1e-6);
  EXPECT_NEAR(texture.at(0.375, 0.5).x, 0.25, 1e-6);
}

TEST(TextureLibrary, AFileThatIsNotThereNamesItselfAndItsMaterial) {
  TextureLibrary library;
  try {
    library.load("/no/such/wall.png", "brick");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"brick\""), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("/no/such/wall.png"), std::string::npos);
  }
}

TEST(TextureLibrary, ReadsWhatWasWrittenAndRejectsWhatIsDamaged) {
  const ScratchDirectory scratch;
  const auto whole = scratch.path() / "whole.png", damaged = scratch.path() / "damaged.png";
  writeDurably(whole, encodePng(fourColours()));
  writeDurably(damaged, "\x89PNG and then nothing of the kind");
  TextureLibrary library;
  library.load(whole, "wall");
  EXPECT_EQ(library.at(whole).at(0.25, 0.75), Vec3f(1, 0, 0));
  EXPECT_THROW(library.load(damaged, "wall"), DamagedFile);
}
