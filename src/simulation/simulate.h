// A whole simulation into a run directory: frames, checkpoints, resuming.
#pragma once

#include "base/progress.h"
#include "frame/run_directory.h"
#include "simulation/simulation_settings.h"

namespace brisance {

struct SimulateOptions {
  int lastFrame = 0;  ///< 0: to the scene's end
  ProgressSink progress;
  StopRequested stopRequested;
};

/// What a run adds up to, for run.json.
struct SimulationSummary {
  int frames = 0;  ///< that are in the run now
  bool interrupted = false;
  Balance volume, heat;  ///< over all frames
  double courant = 0, divergence = 0;
  int substeps = 0;
  bool fireWentOut = false;  ///< the fuel that was lit at the start has burnt, and lit no other
  std::map<std::string, double> stageSeconds;
};

/// Continues from the newest checkpoint whose hash holds, else from frame 1. Writes pieces.glb, gas, bodies, particles,
/// reports and checkpoints; ends early, resumable, when a stop is requested.
SimulationSummary simulate(const SimulationSettings& settings, RunDirectory& run, const SimulateOptions& options);

}  // namespace brisance
