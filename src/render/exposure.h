// Pixels from samples.
#pragma once

#include <functional>
#include <span>

#include "render/camera_rays.h"
#include "render/image.h"

namespace brisance {

/// An integrator: the light along each ray of a packet.
using Follow = std::function<void(std::span<CameraRay> rays, std::span<Vec3f> light)>;

/// The weighted mean of each pixel's samples: the same bits for any number of threads.
Image expose(const CameraRays& rays, int width, int height, const Follow& follow);

}  // namespace brisance
