// Pictures become a film that holds every one of them.
#include "scene/film.h"

#include <cstdlib>

#include "scene/run_program.h"
#include "scene_fixture.h"

namespace brisance {
namespace {

bool haveEncoder() { return std::system("ffmpeg -version >/dev/null 2>&1 && ffprobe -version >/dev/null 2>&1") == 0; }

/// A run with pictures `first` .. `last` of 9 x 7 pixels, without those in `missing`.
void makePictures(RunDirectory& run, int first, int last, int missing = 0) {
  const FreshDirectory scratch;
  for (int i = first; i <= last; ++i) {
    if (i == missing) continue;
    const auto file = scratch.path() / "p.png";
    const std::string colour = "color=c=0x" + std::to_string(10 + i) + "4080:s=10x8";
    runProgram({"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "lavfi", "-i", colour, "-vf",
                "format=rgb24,crop=9:7", "-frames:v", "1", file.string()});
    run.add(frameFile("images", "frame", i, "png"), readFile(file));
  }
}

class FilmTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!haveEncoder()) GTEST_SKIP() << "ffmpeg is not installed";
  }
  std::string lineOf(RunDirectory& run) {
    try {
      encodeFilm(run, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing";
  }
  FreshDirectory directory_;
};

TEST_F(FilmTest, EveryPictureIsInTheFilm) {
  const auto path = directory_.path() / "a %d run";
  RunDirectory run(path, RunDirectory::Mode::create);
  makePictures(run, 1, 5);
  const Film film = encodeFilm(run, {});
  EXPECT_EQ(film.frames, 5);
  ASSERT_EQ(run.manifest().count("film.mp4"), 1u);
  EXPECT_EQ(run.manifest().at("film.mp4").file.hash, recordOf(path / "film.mp4").hash);
  const std::string shape =
      runProgram({"ffprobe", "-v", "error", "-show_entries", "stream=width,height,pix_fmt,codec_name", "-of", "csv=p=0",
                  (path / "film.mp4").string()});
  EXPECT_EQ(shape, "h264,10,8,yuv420p\n") << "odd sides are padded to even ones";
  EXPECT_TRUE(verifyRun(path).empty());
}

TEST_F(FilmTest, AGapInThePicturesIsRefused) {
  const auto path = directory_.path() / "run";
  RunDirectory run(path, RunDirectory::Mode::create);
  EXPECT_EQ(lineOf(run),
            path.string() + ": must hold pictures, has none; brisance render " + path.string() + " makes them");
  makePictures(run, 1, 4, 3);
  EXPECT_EQ(lineOf(run), path.string() +
                             ": must hold every picture from 1 to 4, images/frame.0003.png is missing; "
                             "brisance render " +
                             path.string() + " --skip-existing makes it");
  EXPECT_FALSE(std::filesystem::exists(path / "film.mp4"));
}

TEST_F(FilmTest, PicturesMustBeginAtOne) {
  RunDirectory run(directory_.path() / "run", RunDirectory::Mode::create);
  makePictures(run, 2, 3);
  EXPECT_NE(lineOf(run).find("images/frame.0001.png is missing"), std::string::npos);
}

TEST_F(FilmTest, ADamagedPictureLeavesNoFilmBehind) {
  const auto path = directory_.path() / "run";
  RunDirectory run(path, RunDirectory::Mode::create);
  makePictures(run, 1, 3);
  run.add("images/frame.0002.png", "no picture");
  const std::string line = lineOf(run);
  EXPECT_EQ(line.find("film: "), 0u) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path / "film.mp4"));
}

TEST_F(FilmTest, APictureThatChangedSinceItWasMadeIsRefused) {
  const auto path = directory_.path() / "run";
  RunDirectory run(path, RunDirectory::Mode::create);
  makePictures(run, 1, 2);
  std::ofstream(path / "images/frame.0002.png", std::ios::app) << "x";
  EXPECT_EQ(lineOf(run), (path / "images/frame.0002.png").string() +
                             ": must be as the manifest has it, has another content; brisance verify " + path.string() +
                             " lists all such files");
}

TEST(RunProgram, AMissingProgramIsNamedWithItsRemedy) {
  try {
    runProgram({"brisance-no-such-encoder"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::failed);
    EXPECT_STREQ(error.what(),
                 "film: there is no program brisance-no-such-encoder; install ffmpeg (apt-get install ffmpeg)");
  }
}

TEST(RunProgram, ReturnsTheOutputAndNamesTheLastErrorLine) {
  EXPECT_EQ(runProgram({"printf", "%s", "a b; c"}), "a b; c");
  try {
    runProgram({"sh", "-c", "echo first >&2; echo last >&2; exit 3"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "film: sh failed with code 3: last");
  }
}

}  // namespace
}  // namespace brisance
