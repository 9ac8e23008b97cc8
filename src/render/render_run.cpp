#include "render/render_run.h"

#include <chrono>

#include "base/check.h"
#include "render/layer_file.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

struct FrameRange {
  int first, last, step;
  int count() const { return (last - first) / step + 1; }
};

FrameRange checkedRange(const RunDirectory& run, const RenderRunOptions& options) {
  const int held = run.lastFrame();
  const FrameRange range{options.firstFrame, options.lastFrame == 0 ? held : options.lastFrame, options.step};
  if (held == 0)
    throw InputError(fmt::format("{}: holds no frame to draw; `brisance simulate` makes them", run.path().string()));
  if (range.first < 1 || range.last > held || range.first > range.last || range.step < 1)
    throw InputError(fmt::format("{}: frames {}-{}:{}: must lie within the run's frames 1-{} in steps of at least 1",
                                 run.path().string(), range.first, range.last, range.step, held));
  return range;
}

std::string pictureFile(int index, const std::string& extension) {
  return frameFile("images", "frame", index, extension);
}

bool holds(const std::filesystem::path& run, const std::map<std::string, ManifestEntry>& manifest,
           const std::string& name) {
  const auto entry = manifest.find(name);
  std::error_code trouble;
  return entry != manifest.end() && std::filesystem::file_size(run / name, trouble) == entry->second.file.size &&
         !trouble;
}

/// Another process may have drawn it by now.
bool isDrawnByNow(RunDirectory& run, int frame, const RenderSettings& settings) {
  run.inTurn([] {});
  return hasPicture(run.path(), run.manifest(), frame, settings);
}

void addPictures(RunDirectory& run, int index, const DrawnPicture& drawn, const RenderSettings& settings) {
  if (settings.writeExr) run.add(pictureFile(index, "exr"), encodeLayers(drawn), contentHash(drawn));
  const Picture picture = developed(drawn.light, settings.exposureStops);
  run.add(pictureFile(index, "png"), encodePng(picture), contentHash(picture));
}

}  // namespace

bool hasPicture(const std::filesystem::path& run, const std::map<std::string, ManifestEntry>& manifest, int frame,
                const RenderSettings& settings) {
  return holds(run, manifest, pictureFile(frame, "png")) &&
         (!settings.writeExr || holds(run, manifest, pictureFile(frame, "exr")));
}

RenderSummary renderRun(RunDirectory& run, const RenderSettings& settings, const RenderRunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const FrameRange range = checkedRange(run, options);
  const RenderAssets assets(settings);
  const bool drawsCells = settings.volume.drawn && settings.volume.source == VolumeSource::gas;
  const bool readsGas = drawsCells || settings.flow.drawn;
  RenderScratch scratch;
  RenderSummary summary;
  for (int n = 0; n < range.count(); ++n) {
    if (options.stopRequested && options.stopRequested()) {
      summary.interrupted = true;
      break;
    }
    const int index = range.first + n * range.step;
    if (options.skipExisting && isDrawnByNow(run, index, settings)) {
      ++summary.skipped;
    } else {
      const PictureTime time{options.startTime + (index - 1) / options.fps, 1 / options.fps, options.timeScale};
      Frame frame = readFrame(run.path(), index, readsGas);
      addPictures(run, index, drawFilmFrame(std::move(frame), settings, assets, time, scratch), settings);
      ++summary.rendered;
    }
    if (options.progress) options.progress("render", n + 1, range.count());
  }
  summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return summary;
}

}  // namespace brisance
