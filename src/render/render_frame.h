// Frame -> image.
#pragma once

#include <memory>

#include "frame/frame.h"
#include "render/blackbody.h"
#include "render/environment.h"
#include "render/gas_medium.h"
#include "render/image.h"
#include "render/render_settings.h"
#include "render/textures.h"

namespace brisance {

/// What pictures of one run share: its picture files, read once, and its colours of heat.
struct RenderAssets {
  /// Throws InputError for a picture file that is not there, naming its material, DamagedFile for one that is damaged.
  explicit RenderAssets(const RenderSettings& settings);

  TextureLibrary textures;
  BlackbodyColours heat;
  Environment environment;
};

/// Memory that one picture after another may use; its content means nothing.
struct RenderScratch {
  ParticleVolume volume;
  SplatScratch splat;
  SampleMemory samples;
};

/// When a picture is taken. The shutter opens half of its time before `filmTime` and closes half after.
struct PictureTime {
  double filmTime = 0;              ///< [s] of film: where the camera's keys are
  double frameDuration = 1.0 / 24;  ///< [s] of film per frame
  double simulatedPerFilm = 1;  ///< simulated seconds per second of film: how far bodies move while the shutter is open
};

/// Draws a frame: the same bits for any number of threads. Throws InputError naming the body and the material when the
/// settings do not know a body's material. `assets` were made from the same settings.
Image renderFrame(const Frame& frame, const RenderSettings& settings, const RenderAssets& assets,
                  const PictureTime& time, RenderScratch& scratch);
/// One frame alone, camera at film time `frame.time`.
Image renderFrame(const Frame& frame, const RenderSettings& settings);

}  // namespace brisance
