// What a PLY file says it holds (Turk 1994).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace brisance {

enum class PlyEncoding { ascii, littleEndian, bigEndian };
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytesOf(PlyType type);
inline bool isInteger(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool isList = false;
  PlyType countType = PlyType::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as promised
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  ///< of the header, from 1
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> materialNames;  ///< lines "comment material NAME"
  std::size_t lines = 0;
  std::size_t bytes = 0;  ///< up to the first value
};

/// Throws DamagedFile("FILE:LINE: ...").
PlyHeader readPlyHeader(std::string_view bytes, const std::string& file);

}  // namespace brisance
