// A film of a few bodies: one that flies and spins, one let go late, one that stands.
#pragma once

#include "frame/frame_samples.h"
#include "frame/run_motion.h"

namespace brisance {

constexpr int sampleFrames = 12;
constexpr int releaseFrame = 7;  ///< the last in which the second body rests

/// Orientations with the sign of every other one turned round, which means the same rotation.
inline Pose samplePose(int body, int frame) {
  const Pose rest = sampleBodies().at(body).pose;
  const int moved = body == 0 ? frame - 1 : body == 1 ? std::max(frame - releaseFrame, 0) : 0;
  Quaternion turn = axisAngle({0.6, 0, 0.8}, 0.7 * moved) * rest.orientation;
  if (frame % 2 == 0) turn = {-turn.w, -turn.x, -turn.y, -turn.z};
  return {rest.position + Vec3d(0.1, -0.03 * moved, 0.2) * moved, turn};
}

inline RunMotion sampleMotion() {
  RunMotion motion;
  for (int frame = 1; frame <= sampleFrames; ++frame) motion.frames.push_back(frame);
  const std::vector<FrameBody> bodies = sampleBodies();
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    motion.bodies.push_back({bodies[n], motion.frames, {}});
    for (const int frame : motion.frames) motion.bodies[n].poses.push_back(samplePose(static_cast<int>(n), frame));
    motion.bodies[n].body.pose = motion.bodies[n].poses.front();
  }
  return motion;
}

/// The same, the first body changing its shape in frames 4, 5 and 9.
inline RunMotion swellingMotion() {
  RunMotion motion = sampleMotion();
  auto mesh = motion.bodies[0].body.mesh;
  for (const int frame : motion.frames) {
    if (frame == 4 || frame == 5 || frame == 9) {
      TriangleMesh larger = *mesh;
      for (Vec3d& v : larger.vertices) v = v * 1.5 + Vec3d(.25, 0, 0);
      mesh = std::make_shared<const TriangleMesh>(larger);
    }
    motion.bodies[0].shapes.push_back(mesh);
  }
  return motion;
}

/// How far two rotations are apart, whatever their signs.
inline double apart(const Quaternion& a, const Quaternion& b) {
  const double cosine = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z, sign = cosine < 0 ? -1 : 1;
  return std::max(
      {std::abs(a.w - sign * b.w), std::abs(a.x - sign * b.x), std::abs(a.y - sign * b.y), std::abs(a.z - sign * b.z)});
}

}  // namespace brisance
