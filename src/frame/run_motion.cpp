#include "frame/run_motion.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "frame/body_file.h"
#include "frame/run_directory.h"

namespace brisance {

RunMotion readMotion(const std::filesystem::path& run, const std::vector<int>& frames) {
  const RunReader reader(run);
  std::vector<Frame> read(frames.size());
  parallelFor(0, std::ssize(frames), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last; ++n) reader.readBodies(frames[n], read[n]);
  });
  RunMotion motion{frames, {}};
  std::map<std::string, std::size_t> places;
  for (std::size_t n = 0; n < frames.size(); ++n)
    for (const FrameBody& body : read[n].bodies) {
      const auto [place, isNew] = places.try_emplace(body.name, motion.bodies.size());
      if (isNew) motion.bodies.push_back({body, {}, {}});
      motion.bodies[place->second].frames.push_back(frames[n]);
      motion.bodies[place->second].poses.push_back(body.pose);
      motion.bodies[place->second].shapes.push_back(body.mesh);
    }
  for (BodyMotion& body : motion.bodies)
    if (std::all_of(body.shapes.begin(), body.shapes.end(), [&](const auto& mesh) { return mesh == body.body.mesh; }))
      body.shapes.clear();
  return motion;
}

std::vector<Pose> withContinuousSigns(std::vector<Pose> poses) {
  for (std::size_t n = 1; n < poses.size(); ++n) {
    const Quaternion& before = poses[n - 1].orientation;
    Quaternion& q = poses[n].orientation;
    const double cosine = before.w * q.w + before.x * q.x + before.y * q.y + before.z * q.z;
    if (cosine < 0) q = {-q.w, -q.x, -q.y, -q.z};
  }
  return poses;
}

}  // namespace brisance
