// Broken bodies for the eye: each piece in a colour of its own, pulled apart.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "render/image.h"

namespace brisance {

struct PiecePictureSettings {
  int width = 960, height = 720;
  int samples = 3;                  ///< n x n rays for a pixel
  double explode = 0.3;             ///< each piece moves away from the middle by this share of its distance to it
  Vec3d toViewer{0.55, 0.35, 1.0};  ///< from the middle towards the camera, any length
};

/// The pieces from the outside, so that all of them are in the picture. Triangles whose material is called "inside" are
/// paler than the rest of their piece. Throws InputError when there is nothing to see.
Picture drawPieces(const std::vector<FrameBody>& pieces, const PiecePictureSettings& settings);

/// Colour of a piece, scene-linear: neighbours in number are far apart in hue (steps of the golden angle).
Vec3f pieceColour(std::size_t piece);

}  // namespace brisance
