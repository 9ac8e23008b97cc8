// Pictures as bytes of files: PNG, JPEG (read only) and OpenEXR.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/image.h"

namespace brisance {

/// The bytes of a PNG file: 8-bit RGB with an sRGB chunk, no date, so that equal pictures are equal files.
std::string encodePng(const Picture& picture);
/// The bytes of an OpenEXR file: scene-linear R, G, B as 16-bit floats, no date. Values beyond 65504 become 65504.
std::string encodeExr(const Image& image);

/// One channel of an OpenEXR file: a value for each pixel, `step` floats apart.
struct ExrChannel {
  std::string name;  ///< "R", "depth.Z"
  const float* values;
  std::size_t step = 1;
  bool whole = false;  ///< 32 bits instead of 16
};
/// The bytes of an OpenEXR file of any channels; `texts` go into its header.
std::string encodeExr(int width, int height, const std::vector<ExrChannel>& channels,
                      const std::map<std::string, std::string>& texts);

/// The picture in the bytes of a PNG or JPEG file; transparent parts are seen before black. `fileName` is for the
/// message. Throws DamagedFile when the bytes are neither or the picture is cut short.
Picture decodePicture(const std::string& bytes, const std::string& fileName);
/// Throws DamagedFile when the bytes are no OpenEXR file with channels R, G and B.
Image decodeExr(const std::string& bytes, const std::string& fileName);

}  // namespace brisance
