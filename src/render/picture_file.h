// Pictures as bytes of files: PNG, JPEG (read only) and OpenEXR.
#pragma once

#include <string>

#include "render/image.h"

namespace brisance {

/// The bytes of a PNG file: 8-bit RGB with an sRGB chunk, no date, so that equal pictures are equal files.
std::string encodePng(const Picture& picture);
/// The bytes of an OpenEXR file: scene-linear R, G, B as 16-bit floats, no date. Values beyond 65504 become 65504.
std::string encodeExr(const Image& image);

/// The picture in the bytes of a PNG or JPEG file; transparent parts are seen before black. `fileName` is for the
/// message. Throws DamagedFile when the bytes are neither or the picture is cut short.
Picture decodePicture(const std::string& bytes, const std::string& fileName);
/// Throws DamagedFile when the bytes are no OpenEXR file with channels R, G and B.
Image decodeExr(const std::string& bytes, const std::string& fileName);

}  // namespace brisance
