// A drawn picture as one OpenEXR file of layers, named as compositors expect.
#pragma once

#include <string>

#include "render/render_frame.h"

namespace brisance {

/// The bytes: R, G, B, A and, where the picture has layers, `albedo`, `CryptoObject00` .. `02`, `depth`, `motion`, `N`,
/// `variance` and `volume` (docs/files.md says what they hold). Without layers R, G and B alone.
std::string encodeLayers(const DrawnPicture& picture);
/// Hash of all that the file says.
std::string contentHash(const DrawnPicture& picture);

}  // namespace brisance
