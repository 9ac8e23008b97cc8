// The few numbers and names of glTF 2.0 (Khronos 2021) that the writer and the reader share.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "base/check.h"

namespace brisance::gltf {

constexpr std::uint32_t magic = 0x46546C67;  // "glTF"
constexpr std::uint32_t version = 2;
constexpr std::uint32_t jsonChunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binaryChunk = 0x004E4942;  // "BIN"
constexpr std::size_t headerBytes = 12, chunkHeaderBytes = 8;

constexpr int float32 = 5126, uint32 = 5125;              // accessor.componentType
constexpr int vertexBuffer = 34962, indexBuffer = 34963;  // bufferView.target
constexpr char scalar[] = "SCALAR", vec2[] = "VEC2", vec3[] = "VEC3", vec4[] = "VEC4";

/// A whole GLB; both chunks are multiples of four bytes long, and an empty binary chunk is left out.
inline std::string joinChunks(const std::string& json, const std::string& binary) {
  std::string glb;
  const auto put = [&](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    glb.append(reinterpret_cast<const char*>(&word), sizeof word);
  };
  const std::size_t binaryBytes = binary.empty() ? 0 : chunkHeaderBytes + binary.size();
  const std::size_t total = headerBytes + chunkHeaderBytes + json.size() + binaryBytes;
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw Error(ExitCode::failed,
                fmt::format("a binary glTF of {} bytes: must be below 4 GiB; write fewer or coarser pieces", total));
  put(magic), put(version), put(total);
  put(json.size()), put(jsonChunk);
  glb += json;
  if (binary.empty()) return glb;
  put(binary.size()), put(binaryChunk);
  return glb += binary;
}

}  // namespace brisance::gltf
