#include "frame/gltf_export.h"

#include <array>
#include <map>

#include "frame/gltf_writer.h"

namespace brisance {

namespace {

using gltf::Json;

using Turn = std::array<float, 4>;  // x, y, z, w

Turn turnOf(const Quaternion& orientation) {
  const Quaternion q = normalized(orientation);
  return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

/// Tracks of one animation, those with keys at the same frames sharing their times.
class Animation {
 public:
  Animation(gltf::GlbWriter& writer, double fps) : writer_(writer), fps_(fps) {}

  void add(int node, const BodyMotion& motion) {
    std::vector<Vec3f> places;
    std::vector<Turn> turns;
    for (const Pose& pose : withContinuousSigns(motion.poses)) {
      places.emplace_back(pose.position);
      turns.push_back(turnOf(pose.orientation));
    }
    addTrack({{"node", node}, {"path", "translation"}}, motion.frames, places, gltf::vec3);
    addTrack({{"node", node}, {"path", "rotation"}}, motion.frames, turns, gltf::vec4);
  }

  void finish() {
    if (!channels_.empty())
      writer_.addAnimation({{"name", "film"}, {"samplers", std::move(samplers_)}, {"channels", std::move(channels_)}});
  }

 private:
  template <class T>
  void addTrack(const Json& target, const std::vector<int>& frames, const std::vector<T>& values, const char* type) {
    std::vector<int> keyFrames;
    std::vector<T> keys;
    for (const std::size_t n : neededKeys(values)) {
      keyFrames.push_back(frames[n]);
      keys.push_back(values[n]);
    }
    if (keys.empty()) return;
    samplers_.push_back({{"input", times(keyFrames)},
                         {"interpolation", "LINEAR"},
                         {"output", writer_.addAccessor(keys, type, gltf::float32)}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", target}});
  }

  int times(const std::vector<int>& frames) {
    const auto [place, isNew] = times_.try_emplace(frames, 0);
    if (!isNew) return place->second;
    std::vector<float> seconds;
    for (const int frame : frames) seconds.push_back(static_cast<float>((frame - 1) / fps_));
    const int number = place->second = writer_.addAccessor(seconds, gltf::scalar, gltf::float32);
    writer_.accessor(number)["min"] = {seconds.front()};
    writer_.accessor(number)["max"] = {seconds.back()};
    return number;
  }

  gltf::GlbWriter& writer_;
  double fps_;
  Json samplers_ = Json::array(), channels_ = Json::array();
  std::map<std::vector<int>, int> times_;
};

}  // namespace

std::string piecesToGlb(const std::vector<FrameBody>& bodies) {
  gltf::GlbWriter writer;
  for (const FrameBody& body : bodies) writer.addNode(body);
  return writer.finish();
}

std::string motionToGlb(const RunMotion& motion, double fps, const SurfaceLooks& looks) {
  gltf::GlbWriter writer(&looks);
  Animation animation(writer, fps);
  for (const BodyMotion& body : motion.bodies) animation.add(writer.addNode(body.body), body);
  animation.finish();
  return writer.finish();
}

}  // namespace brisance
