// Noise taken from a path-traced picture: each pixel becomes a weighted regression over its neighbours.
#pragma once

#include "render/exposure.h"
#include "render/picture_layers.h"

namespace brisance {

/// The picture with less noise, the same for any number of threads.
///
/// Light that no chance decides stays as it is; the rest is divided by the albedo, filtered, and multiplied again. A
/// pixel's new value is the value at that pixel of a function that is linear in the place and in the guides, fitted to
/// the neighbours (after Bitterli et al. 2016, "Nonlinearly weighted first-order regression for denoising Monte Carlo
/// renderings"), each weighed by how alike its surroundings are, noise apart (Rousselle, Knaus & Zwicker 2012). One
/// half of the samples decides how the other is weighed, so that no sample is judged by its own noise. Each fit tells
/// the light of all its neighbours, and their means are the picture.
Image denoised(const Exposed& picture, const PictureGuides& guides);

}  // namespace brisance
