// Gas as OpenVDB: density, temperature [K], flame, vel [m/s] as fog volumes, cell centres as index points.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/durable_file.h"
#include "base/raw_bytes.h"
#include "frame/frame.h"
#include "grid/brick_source.h"

namespace brisance {

/// What another program wants otherwise.
struct GasConventions {
  std::string velocityName = "vel";
  bool zUp = false;  ///< (x, y, z) lies and points at (x, -z, y)
  friend bool operator==(const GasConventions&, const GasConventions&) = default;
};

/// What FrameGas holds, made brick by brick when it is written.
struct GasSource {
  BrickSource<float> density, temperature, flame;
  BrickSource<Vec3f> velocity;
};
/// Reads from the gas, which must outlive it.
GasSource sourceOf(const FrameGas& gas);

/// A VDB file in pieces, one after the other, and the hash of what it means.
struct PackedGas {
  std::vector<RawBytes> pieces;
  std::string content;  ///< contentHash of the gas
  void writeTo(std::ostream& out) const;
};
PackedGas packGas(const GasSource& gas, const GasConventions& conventions = {});

/// The bytes of a VDB file that `openvdb::io::File` opens, with a UUID made from the content: equal gas, equal bytes.
std::string gasToVdb(const FrameGas& gas, const GasConventions& conventions = {});
/// Reads what gasToVdb made. Throws DamagedFile. Check the bytes' hash first: the library trusts its input.
FrameGas gasFromVdb(const std::string& bytes, const std::string& fileName);

/// Durable, with a UUID made from the content, so that equal gas is an equal file.
FileRecord writeGas(const std::filesystem::path& path, const GasSource& gas);
/// Throws DamagedFile when it is no such file. Check its hash first: the library trusts its input.
FrameGas readGas(const std::filesystem::path& path);
/// Hash of the grids' values and places.
std::string contentHash(const FrameGas& gas);

}  // namespace brisance
