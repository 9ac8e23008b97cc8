// Frame -> image.
#pragma once

#include <memory>

#include "base/progress.h"
#include "frame/frame.h"
#include "render/blackbody.h"
#include "render/camera_rays.h"
#include "render/environment.h"
#include "render/gas_medium.h"
#include "render/picture_layers.h"
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
  BrickMemory bricks;
};

/// Light, and what else is known of each pixel.
struct DrawnPicture {
  Image light;           ///< scene-linear
  Image variance;        ///< of `light`; empty without layers
  PictureLayers layers;  ///< empty unless the settings ask for an OpenEXR file with layers
};

/// Draws a frame: the same bits for any number of threads. Throws InputError naming the body and the material when the
/// settings do not know a body's material; Interrupted when it is asked to stop, which any thread may do. `assets` were
/// made from the same settings.
DrawnPicture drawPicture(const Frame& frame, const RenderSettings& settings, const RenderAssets& assets,
                         const PictureTime& time, RenderScratch& scratch, const StopRequested& stopRequested = {});
/// Likewise a frame of a film, its pieces painted and its flow shown as the settings ask for.
DrawnPicture drawFilmFrame(Frame frame, const RenderSettings& settings, const RenderAssets& assets,
                           const PictureTime& time, RenderScratch& scratch, const StopRequested& stopRequested = {});
/// The light of one frame alone, camera at film time `frame.time`.
Image renderFrame(const Frame& frame, const RenderSettings& settings);

}  // namespace brisance
