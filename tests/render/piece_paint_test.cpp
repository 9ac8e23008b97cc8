#include "render/piece_paint.h"

#include <gtest/gtest.h>

#include "small_pictures.h"

namespace brisance {
namespace {

const BlackbodyColours heat{PhysicalBlackbody{1500}};

std::vector<FrameBody> threePieces() {
  std::vector<FrameBody> bodies;
  for (const char* name : {"cow.001", "cow.002", "ground"}) bodies.push_back(bodyOf(name, rectangleMesh(1, 1), "hide"));
  bodies[2].material = "grass";
  bodies[0].temperature = 1600;
  bodies[1].temperature = 300;
  return bodies;
}

std::map<std::string, Material> hideAndGrass(double tint, double glow) {
  Material hide;
  hide.diffuse = SolidColour{{.4f, .3f, .2f}};
  hide.pieceTint = tint;
  hide.glow = glow;
  return {{"hide", hide}, {"grass", Material{}}};
}

Vec3f colourOf(const Material& material) { return std::get<SolidColour>(material.diffuse).colour; }

TEST(PiecePaint, NothingChangesWhereNoMaterialAsks) {
  std::vector<FrameBody> bodies = threePieces();
  auto materials = hideAndGrass(0, 0);
  paintPieces(bodies, materials, heat);
  EXPECT_EQ(materials.size(), 2u);
  EXPECT_EQ(bodies[0].material, "hide");
}

TEST(PiecePaint, TintedPiecesHaveHuesOfTheirOwnAndTheSameLuminance) {
  std::vector<FrameBody> bodies = threePieces();
  auto materials = hideAndGrass(.5, 0);
  paintPieces(bodies, materials, heat);
  EXPECT_EQ(bodies[2].material, "grass");
  const Vec3f first = colourOf(materials.at(bodies[0].material)), second = colourOf(materials.at(bodies[1].material));
  EXPECT_GT(length(first - second), .1f);
  const Vec3f weights(.2126f, .7152f, .0722f);
  for (const Vec3f& colour : {first, second})
    EXPECT_NEAR(dot(colour, weights), dot(Vec3f(.4f, .3f, .2f), weights), 1e-6);
}

TEST(PiecePaint, APieceShinesByItsTemperature) {
  std::vector<FrameBody> bodies = threePieces();
  auto materials = hideAndGrass(0, 2);
  paintPieces(bodies, materials, heat);
  EXPECT_EQ(materials.at(bodies[0].material).emission, heat(1600) * 2);
  EXPECT_EQ(materials.at(bodies[1].material).emission, heat(300) * 2);
  EXPECT_GT(materials.at(bodies[0].material).emission.x, 1);
  EXPECT_LT(materials.at(bodies[1].material).emission.x, 1e-6);
}

}  // namespace
}  // namespace brisance
