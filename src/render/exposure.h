// Pixels from samples: their mean, how far it may be off, and two halves that know nothing of one another.
#pragma once

#include <array>
#include <functional>
#include <span>

#include "render/camera_rays.h"
#include "render/image.h"

namespace brisance {

/// An integrator: the light along each ray of a packet.
using Follow = std::function<void(std::span<CameraRay> rays, std::span<Vec3f> light)>;

/// A picture and its noise.
struct Exposed {
  Image mean;                   ///< weighted mean of each pixel's samples
  Image variance;               ///< of that mean, by the spread of the samples; 0 where there is only one
  std::array<Image, 2> halves;  ///< means of the samples on the fields of a checkerboard: white, black
};

enum class Noise { ignored, measured };
/// Whether each pixel has the same samples, weighed as appendix A.1.3 says; or, after some for each, more where light
/// varies more, all counting alike.
enum class Sampling { even, byNoise };
/// Of the picture alone when the noise is `ignored`; that picture is the same in both cases. The same bits for any
/// number of threads.
Exposed expose(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise,
               Sampling sampling = Sampling::even);

}  // namespace brisance
