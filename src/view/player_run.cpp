#include "view/player_run.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "frame/body_file.h"
#include "frame/gas_file.h"
#include "frame/gltf_export.h"
#include "frame/manifest.h"
#include "frame/particle_file.h"
#include "view/moment_file.h"
#include "view/moment_parts.h"
#include "view/scene_json.h"

namespace brisance {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {
constexpr int fewestCells = 32;  // of the gas along an axis, however many bytes that takes

/// The start of each file's hash: of what it means, or of its bytes.
std::string versionOf(const std::map<std::string, ManifestEntry>& manifest, int frame) {
  constexpr std::size_t letters = 8;
  std::string version;
  std::vector<std::string> names = FrameFileNames(frame).all();
  names.push_back("pieces.glb");
  for (const std::string& name : names) {
    const auto entry = manifest.find(name);
    if (entry == manifest.end()) return {};
    const std::string& content = entry->second.content;
    version += (content.empty() ? entry->second.file.hash : content).substr(0, letters);
  }
  return version;
}
}  // namespace

/// The run by one look at its manifest.
struct PlayerRun::Look {
  explicit Look(const fs::path& run)
      : written(fs::last_write_time(run / manifestName)), reader(run), manifest(readManifest(run)) {
    bodies = piecesFromGlb(reader.bytes("pieces.glb"), (run / "pieces.glb").string());
    for (std::size_t n = 0; n < bodies.size(); ++n) places.emplace(bodies[n].name, n);
  }
  fs::file_time_type written;
  RunReader reader;
  std::map<std::string, ManifestEntry> manifest;
  std::vector<FrameBody> bodies;  ///< at rest
  std::map<std::string, std::size_t> places;
};

PlayerRun::PlayerRun(fs::path run, PlayerScene scene)
    : path_(std::move(run)), scene_(std::move(scene)), heat_(scene_.render.volume.blackbody), scale_(heat_) {}

/// Looks again when the manifest is another one.
std::shared_ptr<const PlayerRun::Look> PlayerRun::look() const {
  const std::lock_guard lock(guard_);
  std::error_code error;
  const auto written = fs::last_write_time(path_ / manifestName, error);
  if (!look_ || error || look_->written != written) look_ = std::make_shared<const Look>(path_);
  return look_;
}

int PlayerRun::lastFrame() const { return look()->reader.lastFrame(); }

std::string PlayerRun::version(int frame) const { return versionOf(look()->manifest, frame); }

std::string PlayerRun::state() const {
  const auto run = look();
  const int frames = run->reader.lastFrame();
  json versions = json::array();
  for (int frame = 1; frame <= frames; ++frame) versions.push_back(versionOf(run->manifest, frame));
  return json{{"frames", frames}, {"planned", std::max(frames, scene_.frames)}, {"versions", versions}}.dump();
}

std::string PlayerRun::description() const {
  const auto run = look();
  json told = sceneToJson(scene_.render, scale_);
  told.update({{"title", scene_.title},
               {"version", scene_.version},
               {"fps", scene_.fps},
               {"timeScale", scene_.timeScale},
               {"planned", std::max(run->reader.lastFrame(), scene_.frames)},
               {"film", run->manifest.contains("film.mp4")}});
  told["bodies"] = json::array();
  for (const FrameBody& body : run->bodies) told["bodies"].push_back({{"name", body.name}, {"moves", body.moves}});
  return told.dump();
}

std::string PlayerRun::glb(const std::vector<FrameBody>& bodies) const {
  RunMotion still{{1}, {}};
  for (const FrameBody& body : bodies) still.bodies.push_back({body, {1}, {body.pose}});
  return motionToGlb(still, scene_.fps, scene_.looks);
}

std::string PlayerRun::pieces() const { return glb(look()->bodies); }

std::string PlayerRun::shapes(int frame) const {
  const auto run = look();
  const std::string name = FrameFileNames(frame).shapes;
  return glb(piecesFromGlb(run->reader.bytes(name), (path_ / name).string()));
}

std::string PlayerRun::moment(int index) const {
  const auto run = look();
  const FrameFileNames names(index);
  const auto pathOf = [&](const std::string& name) { return (path_ / name).string(); };
  Frame frame;
  run->reader.requireFrame(index);
  bodiesFromJson(run->reader.bytes(names.bodies), pathOf(names.bodies), frame);
  frame.particles = particlesFromPly(run->reader.bytes(names.particles), pathOf(names.particles));
  frame.report = reportFromJson(run->reader.bytes(names.report), pathOf(names.report));
  if (const VolumeSettings& volume = scene_.render.volume; volume.drawn && volume.source == VolumeSource::gas)
    frame.gas = gasFromVdb(run->reader.bytes(names.gas), pathOf(names.gas));

  return packed(frame);
}

/// With the gas as fine as fits into the bytes that a moment may have.
std::string PlayerRun::packed(const Frame& frame) const {
  constexpr std::size_t mostBytes = 150000;  // 240 frames: 36 MB
  for (int cells = mostCells;;) {
    std::string moment = packed(frame, cells);
    if (moment.size() <= mostBytes || cells <= fewestCells) return moment;
    const double share = static_cast<double>(mostBytes) / static_cast<double>(moment.size());
    cells = static_cast<int>(cells * std::min(0.97, 0.98 * std::cbrt(share)));
  }
}

std::string PlayerRun::packed(const Frame& frame, int cells) const {
  MomentArrays arrays;
  json header = {{"frame", frame.index},
                 {"time", frame.time},
                 {"camera", cameraToJson(scene_.render.camera, (frame.index - 1) / scene_.fps)},
                 {"report", reportOf(frame.report)}};
  header["poses"] = addPoses(frame.bodies, look()->places, arrays);
  header["points"] = addPoints(frame.particles, scale_, arrays);
  if (const auto gas = compactGas(frame, scene_.render.volume, heat_, scale_, cells))
    header["gas"] = addGas(*gas, arrays);
  return packMoment(header, arrays);
}

bool PlayerRun::knowsFile(const std::string& name) const { return look()->manifest.contains(name); }

}  // namespace brisance
