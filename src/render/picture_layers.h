// What else is known of each pixel of a picture: for compositing, and to guide the removal of noise.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/camera_rays.h"
#include "render/first_sight.h"
#include "render/image.h"

namespace brisance {

/// A body and how much of a pixel it covers.
struct BodyShare {
  std::uint32_t body = 0;
  float share = 0;
};
constexpr int rankedBodies = 6;                            ///< of a pixel at most: three channels of four, as is usual
using RankedBodies = std::array<BodyShare, rankedBodies>;  ///< largest share first; share 0: no more

/// For compositing. Means over the samples of each pixel, but for depth and motion.
struct PictureLayers {
  int width = 0, height = 0;
  std::vector<float> alpha;         ///< share that is neither sky nor seen through gas before the sky
  Image volume;                     ///< light of the gas before the first surfaces
  std::vector<float> volumeAlpha;   ///< and its opacity
  std::vector<float> depth;         ///< [m] along the camera's view, of the nearest sample's surface; 1e10: none
  Image normal;                     ///< of the first surfaces, towards the camera, in the scene's axes
  Image albedo;                     ///< what is returned of light from all around, through glass and in mirrors
  std::vector<Vec2<float>> motion;  ///< [pixels] right and up, from this frame to the next, of the nearest sample
  std::vector<RankedBodies> bodies;
  std::vector<std::string> bodyNames;  ///< by the numbers in `bodies`

  bool isEmpty() const { return width == 0; }
};

/// For the removal of noise. Means over the samples of each pixel.
struct PictureGuides {
  Image certain;                ///< the part of the picture without chance
  Image albedo;                 ///< as of the layers
  Image normal;                 ///< of the first surface behind clear glass and mirrors, times the share that has one
  std::vector<float> nearness;  ///< 1 at the camera, 0 at the sky: m / (m + way), m the way to what the camera looks at
  std::vector<float> clearness;                      ///< the share of light from behind glass and gas that arrives
  std::array<Image, 2> certainOfHalf, albedoOfHalf;  ///< of the halves of the samples
};

/// Draws both, along the very rays that the picture is made of.
struct LayersTask {
  const SightWorld& world;
  const CameraRays& rays;
  const RenderSettings& settings;
  const PictureTime& time;
  const std::vector<FrameBody>& bodies;
};
void drawLayers(const LayersTask& task, PictureLayers& layers, PictureGuides& guides);

}  // namespace brisance
