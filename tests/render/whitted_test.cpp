#include "render/whitted.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

constexpr float rounding = 2e-5f;
/// Twice the share below which the tracer follows no ray: a pane's two fainter families of rays end there.
constexpr float cutOff = 2.0f / 512;

const Vec3f fireColour{2, 1, 0.5f};

/// Gas of 1.5 per metre between z = -0.5 and 0.5, 4 m wide, with the light of fireColour.
GasMedium fireSlab() {
  VolumeSettings settings;
  settings.blur = 0;
  settings.fullDensity = 1;
  settings.opacity = 1.5;
  settings.smokeColour = {0, 0, 0};
  const Vec3d first(-1.95, -1.95, -0.45);
  return {{Grid3<float>({40, 40, 10}, first, 0.1, 1), Grid3<Vec3f>({40, 40, 10}, first, 0.1, fireColour)}, settings};
}
const float through = std::exp(-1.5f);

FrameBody wallAt(double z, const std::string& material) {
  return bodyOf("wall", rectangleMesh(3, 3), material, {{0, 0, z}, {}});
}
FrameBody paneAt(double z) { return bodyOf("pane", boxMesh({2, 2, 0.1}), "glass", {{0, 0, z}, {}}); }

std::map<std::string, Material> fewMaterials() {
  return {{"glass", clearGlass()}, {"lamp", lamp({0.3f, 0.6f, 0.9f})}, {"white", whitePaint()}};
}

struct View {
  std::vector<LightSource> lights{};
  const GasMedium* gas = nullptr;
  Vec3f background{0, 0, 0};
  int maxDepth = 16;

  Vec3f along(const SmallWorld& world, const Vec3f& origin, const Vec3f& direction) const {
    return radiance({world.geometry(), world.materials(), lights, gas, background, {0, 0, 0}, maxDepth},
                    {origin, normalized(direction)}, 0.37f);
  }
  Vec3f ahead(const SmallWorld& world) const { return along(world, {0.13f, 0.21f, 5}, {0, 0, -1}); }
};

void expectNear(const Vec3f& seen, const Vec3f& expected, float tolerance) {
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(seen[channel], expected[channel], tolerance) << channel;
}

/// Of a pane seen head on, all rays between its two surfaces summed: 2 r / (1 + r) return, the rest passes.
constexpr float paneReturns = 2 * 0.04f / 1.04f;

}  // namespace

TEST(Radiance, EmptySpaceShowsTheBackground) {
  const SmallWorld world({}, fewMaterials());
  View view;
  view.background = {0.1f, 0.2f, 0.3f};
  EXPECT_EQ(view.ahead(world), view.background);
}

TEST(Blending, FireCoversTheWallBehindItByItsOpacity) {
  const GasMedium gas = fireSlab();
  View view;
  view.gas = &gas;
  const SmallWorld behind({wallAt(-2, "lamp")}, fewMaterials());
  expectNear(view.ahead(behind), fireColour * (1 - through) + Vec3f(0.3f, 0.6f, 0.9f) * through, rounding);
  const SmallWorld before({wallAt(2, "lamp")}, fewMaterials());
  expectNear(view.ahead(before), {0.3f, 0.6f, 0.9f}, rounding);
  const SmallWorld amid({wallAt(0.2, "lamp")}, fewMaterials());  // 0.3 m of gas before it
  const float half = std::exp(-1.5f * 0.3f);
  expectNear(view.ahead(amid), fireColour * (1 - half) + Vec3f(0.3f, 0.6f, 0.9f) * half, rounding);
}

TEST(Blending, GlassBeforeFireReturnsTheBackgroundAndShowsTheFireThrough) {
  const GasMedium gas = fireSlab();
  View view;
  view.gas = &gas;
  view.background = {0.5f, 0.5f, 0.5f};
  const SmallWorld world({paneAt(2)}, fewMaterials());
  const Vec3f fire = fireColour * (1 - through) + view.background * through;
  expectNear(view.ahead(world), fire * (1 - paneReturns) + view.background * paneReturns, cutOff * 2);
}

TEST(Blending, FireBeforeGlassIsSeenAgainInItsMirror) {
  const GasMedium gas = fireSlab();
  View view;
  view.gas = &gas;
  view.background = {0.5f, 0.5f, 0.5f};
  const SmallWorld world({paneAt(-2)}, fewMaterials());
  const Vec3f fire = fireColour * (1 - through), mirrored = fire + view.background * through;
  const Vec3f pane = view.background * (1 - paneReturns) + mirrored * paneReturns;
  expectNear(view.ahead(world), fire + pane * through, cutOff * 2);
}

TEST(Mirror, ReturnsItsShareOfWhatItFaces) {
  Material mirror = whitePaint();
  mirror.reflection = {0.5f, 0.25f, 1};
  auto materials = fewMaterials();
  materials["mirror"] = mirror;
  const FrameBody behindEye = bodyOf("sky", rectangleMesh(30, 30), "lamp", {{0, 0, 8}, axisAngle({0, 1, 0}, pi)});
  const SmallWorld world({wallAt(0, "mirror"), behindEye}, materials);
  expectNear(View{}.ahead(world), {0.15f, 0.15f, 0.9f}, rounding);
}

// A furnace: whatever enters glass that loses nothing comes out of it again.
TEST(Furnace, ASmoothGlassBallCannotBeSeenBeforeAUniformBackground) {
  const SmallWorld world({bodyOf("ball", sphereMesh(1, 48, false), "smooth")}, {{"smooth", clearGlass(true)}});
  for (const int maxDepth : {0, 1, 4, 16}) {
    View view;
    view.background = {0.7f, 0.7f, 0.7f};
    view.maxDepth = maxDepth;
    for (float x = -1.2f; x <= 1.2f; x += 0.0517f)
      expectNear(view.along(world, {x, 0.31f, 4}, {0, 0, -1}), view.background, rounding);
  }
}

TEST(Furnace, GlassThatAbsorbsIsSeen) {
  Material tinted = clearGlass(true);
  tinted.absorption = {1, 0, 0};
  const SmallWorld world({bodyOf("ball", sphereMesh(1, 48, false), "tinted")}, {{"tinted", tinted}});
  View view;
  view.background = {1, 1, 1};
  const Vec3f seen = view.along(world, {0, 0, 4}, {0, 0.001f, -1});
  // Straight through 2 m; what is reflected once inside goes 6 m, twice: 4 % of 96 % each.
  const double expected = 0.04 + 0.96 * 0.96 * std::exp(-2) + 0.96 * 0.04 * 0.96 * std::exp(-4);
  EXPECT_NEAR(seen.x, expected, cutOff);
  EXPECT_NEAR(seen.y, 1, rounding);
}

TEST(Glass, TouchingPiecesLookLikeOneAndPartedOnesDoNot) {
  View view;
  view.background = {0.2f, 0.2f, 0.2f};
  Material tinted = clearGlass();
  tinted.absorption = {3, 2, 1};
  auto materials = fewMaterials();
  materials["tinted"] = tinted;
  // Between parted pieces the ray is totally reflected, and leaves to the side where no wall is.
  const FrameBody halfWall = bodyOf("wall", rectangleMesh(3, 3), "lamp", {{1.5, 0, -2}, {}});
  const auto cut = [&](double gap) {
    return SmallWorld({bodyOf("left", boxMesh({1, 2, 0.4}), "tinted", {{-0.5 - gap / 2, 0, 0}, {}}),
                       bodyOf("right", boxMesh({1, 2, 0.4}), "tinted", {{0.5 + gap / 2, 0, 0}, {}}), halfWall},
                      materials);
  };
  const SmallWorld whole({bodyOf("pane", boxMesh({2, 2, 0.4}), "tinted"), halfWall}, materials);
  const Vec3f origin{-1, 0.1f, 2}, direction{0.5f, 0, -1};  // crosses the plane between the pieces inside them
  expectNear(view.along(cut(0), origin, direction), view.along(whole, origin, direction), rounding);
  const Vec3f parted = view.along(cut(0.01), origin, direction);
  EXPECT_GT(length(parted - view.along(whole, origin, direction)), 0.05f);
}

TEST(Phong, AWhiteWallReturnsTheCosineOverTheSquareOfTheDistance) {
  View view;
  view.lights = {{LightSource::Kind::point, {0.13f, 1.21f, 1}, {8, 8, 8}, 2, 0}};  // 45 degrees, sqrt(2) m away
  const SmallWorld world({wallAt(0, "white")}, fewMaterials());
  const float expected = 8 / 2.0f * std::sqrt(0.5f);
  expectNear(view.ahead(world), {expected, expected, expected}, 4 * rounding);
  view.lights[0].place.z = -1;  // behind the wall
  expectNear(view.ahead(world), {0, 0, 0}, 0);
}

TEST(Phong, TheHighlightIsBrightestInTheMirrorDirection) {
  const Phong surface{{}, {0.8f, 0.8f, 0.8f}, 20};
  const Axes axes({0, 1, 0}, {});
  const auto share = [&](const Vec3f& toLight) {
    return value(surface, axes.toLocal(normalized(Vec3f(1, 1, 0))), axes.toLocal(normalized(toLight))) *
           static_cast<float>(pi);
  };
  EXPECT_NEAR(share(Vec3f(-1, 1, 0)).x, 0.8, rounding);
  EXPECT_LT(share(Vec3f(-1, 0.5f, 0)).x, 0.5f);
  EXPECT_EQ(share(Vec3f(1, 0.1f, 0)), Vec3f{});  // away from the mirror direction: clamped
  EXPECT_EQ(share(Vec3f(-1, -1, 0)), Vec3f{});   // from below: clamped
}

TEST(ShadowOnAWall, IsDarkBehindABodyAndDimBehindGlass) {
  View view;
  view.lights = {{LightSource::Kind::point, {0.13f, 0.21f, 4}, {16, 16, 16}, 2, 0}};
  const auto seen = [&](const std::string& material) {
    std::vector<FrameBody> bodies{wallAt(0, "white")};
    if (!material.empty()) bodies.push_back(bodyOf("screen", boxMesh({0.5, 0.5, 0.1}), material, {{0, 0, 2}, {}}));
    return view.along(SmallWorld(bodies, fewMaterials()), {3, 0.21f, 3}, {-2.87f, 0, -3}).x;  // past the screen
  };
  EXPECT_NEAR(seen(""), 1, 4 * rounding);
  EXPECT_EQ(seen("lamp"), 0);
  EXPECT_NEAR(seen("glass"), 0.96 * 0.96, 4 * rounding);
}

TEST(ShadowOnAWall, GasDimsAPointLight) {
  const GasMedium gas = fireSlab();
  View view;
  view.gas = &gas;
  view.lights = {{LightSource::Kind::point, {0.13f, 0.21f, 2}, {16, 16, 16}, 2, 0}};
  const SmallWorld world({wallAt(-2, "white")}, fewMaterials());
  const Vec3f seen = view.along(world, {2.5f, 0.21f, -1}, {-2.37f, 0, -1});  // past the gas
  EXPECT_NEAR(seen.x, through, 4 * rounding);
}
