// What the readers of picture files share.
#pragma once

#include "base/check.h"
#include "render/image.h"

namespace brisance {

Picture decodePng(const std::string& bytes, const std::string& fileName);
Picture decodeJpeg(const std::string& bytes, const std::string& fileName);

/// A black picture of the size that a file's header claims. Throws DamagedFile when no honest picture is that large.
Picture emptyPicture(std::uint64_t width, std::uint64_t height, const std::string& fileName);

}  // namespace brisance
