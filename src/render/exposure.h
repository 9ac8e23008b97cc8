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
  Image variance;               ///< of that mean, by the spread of the samples
  std::array<Image, 2> halves;  ///< means of even samples on the fields of a checkerboard: white, black
};

enum class Noise { ignored, measured };
/// Each pixel has the same samples, weighed as appendix A.1.3 says; of a single one the variance is said to be 0. The
/// picture alone when the noise is `ignored`; it is the same in both cases. The same bits for any number of threads.
Exposed expose(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise);
/// The same of `samples` a pixel in the mean, at least 1, all counting alike: some for each, then more where light
/// varies more. A single one has the variance of those around, too little where light is rare; there are no halves.
Exposed exposeByNoise(const CameraRays& rays, int width, int height, const Follow& follow, Noise noise, double samples);

}  // namespace brisance
