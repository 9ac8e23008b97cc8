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
    if (!motion.shapes.empty()) addShapes(node, motion);
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

  /// One target a shape; at each change of shape the weight of the new one is 1, in the frame before that of the old.
  void addShapes(int node, const BodyMotion& motion) {
    std::vector<std::size_t> changes;  // to shapes other than the first
    std::vector<std::vector<Vec3f>> displacements;
    const std::vector<Vec3d>& first = motion.body.mesh->vertices;
    for (std::size_t n = 1; n < motion.shapes.size(); ++n) {
      if (motion.shapes[n] == motion.shapes[n - 1]) continue;
      changes.push_back(n);
      std::vector<Vec3f>& moved = displacements.emplace_back();
      for (std::size_t v = 0; v < first.size(); ++v) moved.emplace_back(motion.shapes[n]->vertices[v] - first[v]);
    }
    writer_.addShapes(node, displacements);
    std::vector<int> keyFrames;
    std::vector<float> weights;
    const auto addKey = [&](std::size_t frame, std::size_t shape) {  // shape 0: the first
      keyFrames.push_back(motion.frames[frame]);
      for (std::size_t target = 1; target <= changes.size(); ++target) weights.push_back(target == shape ? 1.f : 0.f);
    };
    for (std::size_t c = 0; c < changes.size(); ++c) {
      if (c == 0 || changes[c - 1] + 1 < changes[c]) addKey(changes[c] - 1, c);
      addKey(changes[c], c + 1);
    }
    samplers_.push_back({{"input", times(keyFrames)},
                         {"interpolation", "LINEAR"},
                         {"output", writer_.addAccessor(weights, gltf::scalar, gltf::float32)}});
    channels_.push_back({{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", "weights"}}}});
  }

  int times(const std::vector<int>& frames) {
    const auto [place, isNew] = times_.try_emplace(frames, 0);
    if (!isNew) return place->second;
    std::vector<float> seconds;
    seconds.reserve(frames.size());
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
  std::vector<FrameBody> nodes;  // their meshes must stay while the writer tells them apart by their addresses
  for (const BodyMotion& body : motion.bodies) {
    nodes.push_back(body.body);
    if (!body.shapes.empty()) nodes.back().mesh = std::make_shared<const TriangleMesh>(*body.body.mesh);  // not shared
    animation.add(writer.addNode(nodes.back()), body);
  }
  animation.finish();
  return writer.finish();
}

}  // namespace brisance
