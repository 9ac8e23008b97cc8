// The cost of a scene, known ahead.
#include "scene/estimate.h"

#include <nlohmann/json.hpp>

#include "scene_fixture.h"

namespace brisance {
namespace {

const std::string small =
    "[scene]\nframes = 10\n[gas]\ncells = [20, 10, 5]\n[render.volume]\ncells = [40, 20, 10]\n"
    "[explosion]\nmass = 2e-4\nsoot_threshold = 1e-5\n[[explosion.charges]]\nposition = [0.5, 0.25, 0.125]\n"
    "particles = 100\n[[bodies]]\nname = 'pane'\nshape = 'pane'\nfracture.pieces = 16\n"
    "[[bodies]]\nname = 'box'\nshape = 'box'\n";

TEST(Estimate, CountsWhatASceneHolds) {
  const SceneEstimate cost = estimate(parseScene(small, "s.toml"));
  EXPECT_EQ(cost.frames, 10);
  EXPECT_EQ(cost.cells, 1000);
  EXPECT_EQ(cost.volumeCells, 8000);
  EXPECT_EQ(cost.bodies, 2);
  EXPECT_EQ(cost.pieces, 17);
  EXPECT_NEAR(static_cast<double>(cost.particles), 100 * (1 + 20), 100)
      << "each fuel particle, and 20 of soot from it, but for rounding";
}

TEST(Estimate, GrowsWithTheGridAndTheFilm) {
  const SceneEstimate cost = estimate(parseScene(small, "s.toml"));
  const SceneEstimate finer = estimate(parseScene(small, "s.toml", {"gas.cells=[200, 100, 50]"}));
  const SceneEstimate longer = estimate(parseScene(small, "s.toml", {"scene.frames=20"}));
  EXPECT_EQ(finer.cells, 1000 * cost.cells);
  EXPECT_GT(finer.simulating, cost.simulating + 999000 * 57) << "at least the fields of the state";
  EXPECT_GT(longer.disk, cost.disk);
  EXPECT_LT(longer.disk, 2 * cost.disk);
}

TEST(Check, ReportsCostOrProblemsAsOneJsonObject) {
  const FreshDirectory directory;
  const SceneCheck right = checkScene(directory.write("right.toml", small), {}, directory.path() / "runs/new");
  EXPECT_TRUE(right.ok()) << right.problems.front();
  const nlohmann::json json = nlohmann::json::parse(checkJson(right));
  EXPECT_EQ(json["ok"], true);
  EXPECT_EQ(json["cells"], 1000);
  EXPECT_EQ(json["bytes"], right.cost->disk);
  EXPECT_TRUE(json["problems"].empty());

  const SceneCheck wrong = checkScene(directory.write("wrong.toml", "[gas]\ncourant = 0\n"));
  EXPECT_EQ(wrong.code, ExitCode::badScene);
  const nlohmann::json problems = nlohmann::json::parse(checkJson(wrong));
  EXPECT_EQ(problems["ok"], false);
  EXPECT_EQ(problems["problems"][0],
            (directory.path() / "wrong.toml").string() + ":2: gas.courant: must be from 0.01 to 10, got 0");
}

TEST(Check, SaysWhenTheMachineIsTooSmall) {
  const FreshDirectory directory;
  const SceneCheck check = checkScene(directory.write("s.toml", small), {"gas.cells=[4096, 2048, 1024]"});
  EXPECT_EQ(check.code, ExitCode::noRoom);
  EXPECT_GT(machineMemory(), 0);
  EXPECT_GT(freeMemory(), 0);
  EXPECT_LE(freeMemory(), machineMemory());
}

TEST(Estimate, ReadsAsText) {
  const std::string text = estimateText(estimate(parseScene(small, "s.toml")));
  EXPECT_NE(text.find("1000 gas cells"), std::string::npos);
  EXPECT_NE(text.find("17 pieces"), std::string::npos);
}

}  // namespace
}  // namespace brisance
