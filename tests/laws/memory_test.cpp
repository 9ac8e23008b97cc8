// What `brisance check` says of memory is what `brisance simulate` takes.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace brisance::test {
namespace {

struct SceneOf {
  int cells;
  int particles;
};

class Memory : public testing::TestWithParam<SceneOf> {};

/// Moving air everywhere and a charge, for a sub-step or two.
std::string text(const SceneOf& scene) {
  return fmt::format(
      "[scene]\nframes = 2\ntime_scale = 0.01\n[gas]\ncells = [{0}, {0}, {0}]\nstart_velocity = 0.1\n"
      "[explosion]\nmass = 1e-6\nburn_rate = 1e-5\nsoot_threshold = 1\n"
      "[[explosion.charges]]\nposition = [0.5, 0.5, 0.5]\nradius = 0.2\nparticles = {1}\nignited = 30\n",
      scene.cells, scene.particles);
}

TEST_P(Memory, IsPredictedWithinATenth) {
  const ScratchDirectory place;
  writeText(place / "scene.toml", text(GetParam()));
  const Outcome checked = runProgram({"check", place / "scene.toml", "--json"});
  ASSERT_EQ(checked.exitCode, 0) << checked.err;
  const double predicted = nlohmann::json::parse(checked.out)["simulating_bytes"];
  const Outcome ran =
      runProgram({"simulate", place / "scene.toml", "-o", place / "run", "--threads", "2", "--json", "--quiet"});
  ASSERT_EQ(ran.exitCode, 0) << ran.err;
  const double taken = 1e6 * double(nlohmann::json::parse(ran.out)["peak_memory_mb"]);
  EXPECT_NEAR(predicted / taken, 1, 0.1) << predicted / 1e6 << " MB predicted, " << taken / 1e6 << " MB taken";
}

INSTANTIATE_TEST_SUITE_P(Simulations, Memory,
                         testing::Values(SceneOf{48, 100}, SceneOf{96, 100}, SceneOf{48, 300'000},
                                         SceneOf{80, 300'000}),
                         [](const auto& of) {
                           return fmt::format("{}Cells{}Particles", of.param.cells, of.param.particles);
                         });

}  // namespace
}  // namespace brisance::test
