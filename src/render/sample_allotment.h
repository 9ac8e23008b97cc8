// More samples for pixels whose light varies more, so that as many samples make less noise.
#pragma once

#include <vector>

#include "base/random.h"
#include "render/image.h"

namespace brisance {

/// How many more samples each pixel gets after `drawn` of them each, so that pixels have `samples` in the mean.
///
/// The sum over pixels of variance / samples is least where the samples go with the deviation of one. The light counts
/// as a screen shows it: what is far beyond white may vary more. A pixel's deviation is taken from those around it, not
/// from its own samples: else a pixel that happened to look even would be left alone, and be biased.
/// `light`: mean of the drawn samples; `variance`: of that mean, not looked at if there was only one: then the light
/// around tells. `chance` rounds, addressed by pixel.
std::vector<int> allotSamples(const Image& light, const Image& variance, int drawn, double samples,
                              const Random& chance);

/// The variance of the light around each pixel, but for its own.
Image varianceAround(const Image& light);

}  // namespace brisance
