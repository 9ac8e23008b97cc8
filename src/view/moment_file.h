// A moment of a run as the player reads it: a JSON header, and arrays that it names, packed.
#pragma once

#include <cstring>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace brisance {

/// Arrays one after the other, each from a multiple of four bytes on.
class MomentArrays {
 public:
  /// Where it begins, in bytes after the header.
  template <class T>
  std::size_t add(const std::vector<T>& values) {
    const std::size_t place = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return place;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Little-endian: the number of bytes of the header (32 bits, a multiple of four), the header, the arrays. All of it
/// as one zlib stream (RFC 1950), which browsers unpack by themselves.
std::string packMoment(const nlohmann::json& header, const MomentArrays& arrays);

/// A zlib stream of some bytes.
std::string deflated(const std::string& bytes);

}  // namespace brisance
