#include "frame/run_motion.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "frame/gltf_export.h"
#include "frame/run_directory.h"
#include "frame/sample_motion.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

using Keys = std::vector<std::size_t>;

TEST(NeededKeys, ATrackThatNeverChangesHasNone) {
  EXPECT_EQ(neededKeys(std::vector<int>{}), Keys());
  EXPECT_EQ(neededKeys(std::vector{5}), Keys());
  EXPECT_EQ(neededKeys(std::vector{5, 5, 5, 5}), Keys());
}

TEST(NeededKeys, OnlyTheInsideOfARunOfEqualValuesIsLeftOut) {
  EXPECT_EQ(neededKeys(std::vector{1, 2, 3}), Keys({0, 1, 2}));
  EXPECT_EQ(neededKeys(std::vector{1, 1, 1, 1, 2}), Keys({0, 3, 4}));
  EXPECT_EQ(neededKeys(std::vector{1, 2, 2, 2, 3, 3, 3}), Keys({0, 1, 3, 4, 6}));
  EXPECT_EQ(neededKeys(std::vector{1, 2, 2, 1}), Keys({0, 1, 2, 3}));
}

TEST(ContinuousSigns, NeighboursLieOnOneSideAndTurnAsBefore) {
  const std::vector<Pose> before = sampleMotion().bodies[0].poses, after = withContinuousSigns(before);
  for (std::size_t n = 0; n < after.size(); ++n) {
    const Quaternion& q = after[n].orientation;
    EXPECT_EQ(apart(q, before[n].orientation), 0);
    if (n == 0) continue;
    const Quaternion& p = after[n - 1].orientation;
    EXPECT_GE(p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z, 0);
  }
}

/// Bodies of frames 1 to 4, the second one away in frame 3.
class MotionOfARun : public ::testing::Test {
 protected:
  MotionOfARun() {
    RunDirectory directory(run_, RunDirectory::Mode::create);
    directory.add("pieces.glb", piecesToGlb(sampleBodies()));
    for (int index = 1; index <= 4; ++index) {
      Frame frame = sampleFrame(index);
      if (index == 3) frame.bodies.erase(frame.bodies.begin() + 1);
      directory.addFrame(frame);
    }
  }
  ScratchDirectory scratch_;
  std::filesystem::path run_ = scratch_ / "run";
};

TEST_F(MotionOfARun, HasEveryBodyInTheFramesThatHaveIt) {
  const RunMotion motion = readMotion(run_, {1, 3, 4});
  ASSERT_EQ(motion.bodies.size(), 3u);
  EXPECT_EQ(motion.bodies[0].frames, std::vector<int>({1, 3, 4}));
  EXPECT_EQ(motion.bodies[1].frames, std::vector<int>({1, 4}));
  EXPECT_EQ(motion.bodies[0].poses[1], sampleFrame(3).bodies[0].pose);
  EXPECT_EQ(motion.bodies[1].poses[1], sampleFrame(4).bodies[1].pose);
  EXPECT_EQ(motion.bodies[0].body.mesh, motion.bodies[1].body.mesh) << "shared as it was";
  EXPECT_EQ(motion.bodies[2].body.material, "stone");
}

TEST_F(MotionOfARun, RefusesAFrameThatIsNotThereAndNamesThoseThatAre) {
  try {
    readMotion(run_, {4, 5});
    FAIL();
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("has no frame 5; it has frames 1 to 4"), std::string::npos);
  }
}

TEST_F(MotionOfARun, WantsNeitherGasNorParticles) {
  for (const char* name : {"gas/gas.0002.vdb", "particles/particles.0002.ply"}) std::filesystem::remove(run_ / name);
  EXPECT_EQ(readMotion(run_, {2}).bodies.size(), 3u);
}

TEST_F(MotionOfARun, RefusesADamagedPose) {
  std::filesystem::resize_file(run_ / "bodies/bodies.0002.json", 100);
  EXPECT_THROW(readMotion(run_, {1, 2}), DamagedFile);
}

}  // namespace
}  // namespace brisance
