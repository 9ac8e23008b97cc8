#include "scene/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/check.h"
#include "scene/run_program.h"

namespace brisance {
namespace {

constexpr const char* filmName = "film.mp4";

/// Numbers of the pictures that the manifest holds, rising.
std::vector<int> pictureNumbers(const RunDirectory& run) {
  const std::string prefix = "images/frame.", suffix = ".png";
  std::vector<int> numbers;
  for (const auto& [name, entry] : run.manifest()) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    int number = 0;
    std::from_chars(name.data() + prefix.size(), name.data() + name.size() - suffix.size(), number);
    if (frameFile("images", "frame", number, "png") == name) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Number of pictures 1 .. n. Throws InputError where there are none, or one is missing between others.
int countPictures(const RunDirectory& run) {
  const std::vector<int> numbers = pictureNumbers(run);
  if (numbers.empty())
    throw InputError(fmt::format("{}: must hold pictures, has none; brisance render {} makes them", run.path().string(),
                                 run.path().string()));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int expected = static_cast<int>(i) + 1;
    const std::string name = frameFile("images", "frame", expected, "png");
    std::error_code ignored;
    if (numbers[i] != expected || !std::filesystem::is_regular_file(run.path() / name, ignored))
      throw InputError(
          fmt::format("{}: must hold every picture from 1 to {}, {} is missing; brisance render {} --skip-existing "
                      "makes it",
                      run.path().string(), numbers.back(), name, run.path().string()));
  }
  return numbers.back();
}

/// Before another program trusts them.
void checkPictures(const RunDirectory& run, int count) {
  for (int i = 1; i <= count; ++i) {
    const std::string name = frameFile("images", "frame", i, "png");
    if (recordOf(run.path() / name).hash != run.manifest().at(name).file.hash)
      throw DamagedFile(fmt::format(
          "{}: must be as the manifest has it, has another content; brisance verify {} lists all such files",
          (run.path() / name).string(), run.path().string()));
  }
}

/// A '%' in a path stands for itself when doubled: only the last one is the frame's number.
std::string picturePattern(const std::filesystem::path& run) {
  std::string pattern;
  for (const char c : (run / "images").string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return "file:" + pattern + "/frame.%04d.png";
}

void encode(const RunDirectory& run, const FilmSettings& settings, int count, const std::filesystem::path& target) {
  std::vector<std::string> arguments{"ffmpeg", "-nostdin", "-loglevel", "error", "-y"};
  const auto add = [&](const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  // A picture that cannot be read ends the work, and no picture is shown twice in place of one that is missing.
  add({"-xerror", "-framerate", fmt::format("{}", settings.fps), "-start_number", "1", "-i",
       picturePattern(run.path())});
  add({"-frames:v", fmt::format("{}", count), "-fps_mode", "passthrough"});
  // Even sides, as this chroma format needs them.
  add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"});
  // Colours marked for what they are: players guess by the size otherwise.
  add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"});
  add({"-c:v", "libx264", "-preset", "medium", "-crf", fmt::format("{}", settings.rateFactor)});
  // The header first, so that a browser plays while it loads.
  add({"-movflags", "+faststart", "-f", "mp4", "file:" + target.string()});
  runProgram(arguments);
}

int countFrames(const std::filesystem::path& film) {
  const std::string answer =
      runProgram({"ffprobe", "-v", "error", "-count_packets", "-select_streams", "v:0", "-show_entries",
                  "stream=nb_read_packets", "-of", "csv=p=0", "file:" + film.string()});
  int count = -1;
  std::from_chars(answer.data(), answer.data() + answer.size(), count);
  return count;
}

}  // namespace

Film encodeFilm(RunDirectory& run, const FilmSettings& settings) {
  Film film;
  film.frames = countPictures(run);
  checkPictures(run, film.frames);
  film.file = writeDurablyByName(run.path() / filmName, [&](const std::filesystem::path& temporary) {
    encode(run, settings, film.frames, temporary);
    const int counted = countFrames(temporary);
    if (counted != film.frames)
      throw Error(ExitCode::failed, fmt::format("film: must hold {} frames, ffmpeg made {}", film.frames, counted));
  });
  run.record({{filmName, {film.file, ""}}});
  return film;
}

}  // namespace brisance
