#include "render/render_run.h"

#include <gtest/gtest.h>

#include "base/check.h"
#include "frame/gltf_export.h"
#include "render/picture_file.h"
#include "scratch_directory.h"
#include "small_pictures.h"

using namespace brisance;

namespace {

constexpr int frames = 3;

RenderSettings runPicture() {
  RenderSettings settings = smallPicture();
  settings.materials = {{"lamp", lamp({0.25f, 0.5f, 2})}};
  return settings;
}

/// A lamp that moves to the right frame by frame.
RunDirectory smallRun(const std::filesystem::path& path) {
  RunDirectory run(path, RunDirectory::Mode::create);
  Frame frame;
  frame.bodies = {bodyOf("lamp", rectangleMesh(0.5, 0.5), "lamp")};
  run.add("pieces.glb", piecesToGlb(frame.bodies));
  for (frame.index = 1; frame.index <= frames; ++frame.index) {
    frame.bodies[0].pose.position.x = 0.3 * frame.index;
    run.addFrame(frame);
  }
  return run;
}

}  // namespace

TEST(RenderRun, AddsAPngAndAnExrOfEveryFrameWithTheirContent) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  const RenderSummary summary = renderRun(run, runPicture(), {});
  EXPECT_EQ(summary.rendered, frames);
  EXPECT_FALSE(summary.interrupted);
  for (const char* name : {"images/frame.0001.png", "images/frame.0003.exr"}) {
    ASSERT_TRUE(run.manifest().contains(name)) << name;
    EXPECT_EQ(run.manifest().at(name).content.size(), 32u);
  }
  const Image exr = decodeExr(readFile(run.path() / "images/frame.0001.exr"), "frame.0001.exr");
  EXPECT_EQ(exr(18, 16), Vec3f(0.25f, 0.5f, 2));  // scene-linear, as it shines
  const Picture png = decodePicture(readFile(run.path() / "images/frame.0001.png"), "frame.0001.png");
  EXPECT_EQ(png.width, 32);
  EXPECT_TRUE(verifyRun(run.path()).empty());
}

TEST(RenderRun, AnyFrameAloneIsTheSamePicture) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  renderRun(run, runPicture(), {});
  const std::string content = run.manifest().at("images/frame.0002.png").content;
  run.remove({"images/frame.0002.png"});
  RenderRunOptions alone;
  alone.firstFrame = alone.lastFrame = 2;
  EXPECT_EQ(renderRun(run, runPicture(), alone).rendered, 1);
  EXPECT_EQ(run.manifest().at("images/frame.0002.png").content, content);
}

TEST(RenderRun, LeavesExistingPicturesAloneOnRequest) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  renderRun(run, runPicture(), {});
  run.remove({"images/frame.0003.exr"});
  RenderRunOptions options;
  options.skipExisting = true;
  const RenderSummary summary = renderRun(run, runPicture(), options);
  EXPECT_EQ(summary.skipped, 2);
  EXPECT_EQ(summary.rendered, 1);
}

TEST(RenderRun, WritesNoExrWhenNoneIsWanted) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  RenderSettings settings = runPicture();
  settings.writeExr = false;
  RenderRunOptions odd;
  odd.step = 2;
  EXPECT_EQ(renderRun(run, settings, odd).rendered, 2);
  EXPECT_TRUE(run.manifest().contains("images/frame.0003.png"));
  EXPECT_FALSE(run.manifest().contains("images/frame.0002.png"));
  EXPECT_FALSE(run.manifest().contains("images/frame.0001.exr"));
}

TEST(RenderRun, StopsBetweenTwoFramesWhenAsked) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  int done = 0;
  RenderRunOptions options;
  options.progress = [&](const std::string& stage, int now, int total) {
    EXPECT_EQ(stage, "render");
    EXPECT_EQ(total, frames);
    done = now;
  };
  options.stopRequested = [&] { return done >= 2; };
  const RenderSummary summary = renderRun(run, runPicture(), options);
  EXPECT_TRUE(summary.interrupted);
  EXPECT_EQ(summary.rendered, 2);
}

TEST(RenderRun, TheCameraRidesInFilmTime) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  RenderSettings settings = runPicture();
  // Rides along with the lamp: 0.3 m per frame of 1/10 s, which is at 0.3 m in frame 1.
  settings.camera.keys = {{0, {0.3, 0, 5}, {0.3, 0, 0}, {0, 1, 0}, 40}, {1, {3.3, 0, 5}, {3.3, 0, 0}, {0, 1, 0}, 40}};
  RenderRunOptions options;
  options.fps = 10;
  renderRun(run, settings, options);
  for (int index = 1; index <= frames; ++index) {
    const std::string name = frameFile("images", "frame", index, "exr");
    const Image image = decodeExr(readFile(run.path() / name), name);
    EXPECT_EQ(image(16, 16).z, 2) << name;
    EXPECT_EQ(image(12, 16).z, 0) << name;
    EXPECT_EQ(image(20, 16).z, 0) << name;
  }
}

TEST(RenderRun, FramesThatTheRunDoesNotHaveAreTheUsersMistake) {
  const ScratchDirectory scratch;
  RunDirectory run = smallRun(scratch / "run");
  RenderRunOptions beyond;
  beyond.lastFrame = frames + 1;
  EXPECT_THROW(renderRun(run, runPicture(), beyond), InputError);
  RenderRunOptions backwards;
  backwards.firstFrame = 3;
  backwards.lastFrame = 2;
  EXPECT_THROW(renderRun(run, runPicture(), backwards), InputError);
  RunDirectory empty(scratch / "empty", RunDirectory::Mode::create);
  EXPECT_THROW(renderRun(empty, runPicture(), {}), InputError);
}
