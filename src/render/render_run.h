// The pictures of a run: images/frame.0001.png and .exr, recorded in its manifest.
#pragma once

#include "base/progress.h"
#include "frame/run_directory.h"
#include "render/render_settings.h"

namespace brisance {

struct RenderRunOptions {
  int firstFrame = 1;
  int lastFrame = 0;  ///< 0: the last frame that the run holds
  int step = 1;
  bool skipExisting = false;  ///< leave pictures alone that the manifest holds and the disk has
  double fps = 24;            ///< frames of film per second: frame N is seen at startTime + (N - 1) / fps
  double startTime = 0;       ///< [s] of film at frame 1
  double timeScale = 1;       ///< simulated seconds per second of film (for motion blur)
  ProgressSink progress;      ///< stage "render"
  StopRequested stopRequested;
};

/// What was done, for run.json.
struct RenderSummary {
  int rendered = 0;
  int skipped = 0;
  bool interrupted = false;
  double seconds = 0;
};

/// Whether the pictures of a frame are there: the manifest names them, and the disk has them in that size.
bool hasPicture(const std::filesystem::path& run, const std::map<std::string, ManifestEntry>& manifest, int frame,
                const RenderSettings& settings);

/// Reads frames one by one and adds their pictures. Ends early, between two frames, when a stop is requested.
/// Throws InputError when the range holds no frame or a frame that the run does not have.
RenderSummary renderRun(RunDirectory& run, const RenderSettings& settings, const RenderRunOptions& options);

}  // namespace brisance
