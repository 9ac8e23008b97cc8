// How a run's bodies move: their poses over its frames, without gas or particles.
#pragma once

#include <filesystem>
#include <vector>

#include "frame/frame.h"

namespace brisance {

/// A body and where it is in the frames that have it.
struct BodyMotion {
  FrameBody body;           ///< as in the first of them
  std::vector<int> frames;  ///< ascending
  std::vector<Pose> poses;  ///< one for each
  std::vector<std::shared_ptr<const TriangleMesh>>
      shapes{};  ///< one for each, of the same triangles; none if it keeps its own
};

struct RunMotion {
  std::vector<int> frames;  ///< ascending, from 1
  std::vector<BodyMotion> bodies;
};

/// Reads the poses of some frames, every file's hash checked. Throws InputError for a frame that is not there,
/// DamagedFile.
RunMotion readMotion(const std::filesystem::path& run, const std::vector<int>& frames);

/// The poses with the sign of each orientation chosen so that it goes on from the one before: q and -q turn alike, but
/// what lies between them does not.
std::vector<Pose> withContinuousSigns(std::vector<Pose> poses);

/// Which keys of a track say all: those inside a run of equal values are left out, and so are all keys of a track whose
/// value never changes. Between keys goes a straight line, before and after them the nearest one holds.
template <class T>
std::vector<std::size_t> neededKeys(const std::vector<T>& values) {
  std::vector<std::size_t> keys;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const bool likeBefore = n > 0 && values[n] == values[n - 1];
    const bool likeAfter = n + 1 < values.size() && values[n] == values[n + 1];
    if (!likeBefore || !likeAfter) keys.push_back(n);
  }
  const bool changes = keys.size() > 2 || (keys.size() == 2 && !(values[keys[0]] == values[keys[1]]));
  return changes ? keys : std::vector<std::size_t>();
}

}  // namespace brisance
