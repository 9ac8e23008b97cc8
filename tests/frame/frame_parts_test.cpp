#include <gtest/gtest.h>

#include "base/check.h"
#include "frame/body_file.h"
#include "frame/frame_samples.h"
#include "frame/particle_file.h"

namespace brisance {
namespace {

TEST(ParticleFile, ReadsBackTheSameBits) {
  for (const std::size_t count : {0, 1, 1000}) {
    const FrameParticles particles = sampleParticles(count);
    EXPECT_EQ(particlesFromPly(particlesToPly(particles), "a.ply"), particles);
  }
}

TEST(ParticleFile, HasTheHeaderThatOtherToolsRead) {
  const std::string ply = particlesToPly(sampleParticles(3));
  EXPECT_EQ(ply.find("ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"),
            0u);
  const std::string end = "end_header\n";
  EXPECT_EQ(ply.size(), ply.find(end) + end.size() + 3 * (8 * 4 + 1));
}

TEST(ParticleFile, EveryTruncationIsRefused) {
  const std::string ply = particlesToPly(sampleParticles(5));
  for (std::size_t length = 0; length < ply.size(); ++length)
    ASSERT_THROW(particlesFromPly(ply.substr(0, length), "a.ply"), DamagedFile) << length;
  EXPECT_THROW(particlesFromPly(ply + "x", "a.ply"), DamagedFile);
}

TEST(ParticleFile, DoesNotTrustTheCount) {
  std::string ply = particlesToPly(sampleParticles(5));
  ply.replace(ply.find("vertex 5"), 8, "vertex 99999999999999999999");
  EXPECT_THROW(particlesFromPly(ply, "a.ply"), DamagedFile);
}

TEST(BodyFile, ReadsBackPosesToTheLastBit) {
  const Frame frame = sampleFrame(12);
  Frame read;
  bodiesFromJson(bodiesToJson(frame), "a.json", read);
  EXPECT_EQ(read.index, 12);
  EXPECT_EQ(read.time, frame.time);
  ASSERT_EQ(read.bodies.size(), frame.bodies.size());
  for (std::size_t n = 0; n < frame.bodies.size(); ++n) {
    EXPECT_EQ(read.bodies[n].name, frame.bodies[n].name);
    EXPECT_EQ(read.bodies[n].pose, frame.bodies[n].pose);
    EXPECT_EQ(read.bodies[n].linearVelocity, frame.bodies[n].linearVelocity);
    EXPECT_EQ(read.bodies[n].angularVelocity, frame.bodies[n].angularVelocity);
    EXPECT_EQ(read.bodies[n].temperature, frame.bodies[n].temperature);
  }
  EXPECT_EQ(contentHash(read.bodies), contentHash(frame.bodies));
}

TEST(BodyFile, ContentChangesWithAnyValue) {
  const auto bodies = sampleBodies();
  auto moved = bodies, turned = bodies, warmed = bodies, renamed = bodies;
  moved[1].pose.position.y += 1e-15;
  turned[1].angularVelocity.z += 1e-15;
  warmed[2].temperature += 1e-9;
  renamed[0].name += "x";
  for (const auto& other : {moved, turned, warmed, renamed}) EXPECT_NE(contentHash(other), contentHash(bodies));
}

TEST(BodyFile, AValueThatIsNotFiniteIsOurOwnBug) {
  Frame frame = sampleFrame(1);
  frame.bodies[0].pose.position.x = NAN;
  EXPECT_THROW(bodiesToJson(frame), std::logic_error);
}

TEST(BodyFile, EveryTruncationIsRefused) {
  const std::string text = bodiesToJson(sampleFrame(1));
  Frame read;
  for (std::size_t length = 0; length + 1 < text.size(); ++length)
    ASSERT_THROW(bodiesFromJson(text.substr(0, length), "a.json", read), DamagedFile) << length;
}

TEST(ReportFile, ReadsBackTheSameReport) {
  const Frame frame = sampleFrame(1);
  const StepReport read = reportFromJson(reportToJson(frame), "a.json");
  EXPECT_EQ(read.substeps, 7);
  EXPECT_EQ(read.courant, 0.93);
  EXPECT_EQ(read.divergence, 1e-7);
  EXPECT_EQ(read.pressure.iterations, 41);
  EXPECT_EQ(read.pressure.residual, 3e-7);
  EXPECT_TRUE(read.pressure.converged);
  EXPECT_EQ(read.heat.in, -1e6);
  EXPECT_EQ(read.heat.lost, 1.0 / 3);
  EXPECT_EQ(read.volume.gained, 0.5);
  EXPECT_EQ(read.stageSeconds, frame.report.stageSeconds);
}

}  // namespace
}  // namespace brisance
