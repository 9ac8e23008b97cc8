// brisance export: a run in files that other tools open.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "base/durable_folder.h"
#include "base/stopwatch.h"
#include "commands.h"
#include "export_looks.h"
#include "export_place.h"
#include "frame/gas_file.h"
#include "frame/gltf_export.h"
#include "frame/manifest.h"
#include "frame/particle_file.h"
#include "frame/piece_files.h"
#include "frame/point_file.h"
#include "frame/usd_export.h"
#include "interruption.h"
#include "player_page.h"
#include "progress_bar.h"
#include "scene/scene_file.h"
#include "view/standalone_page.h"

namespace brisance {

namespace {

namespace fs = std::filesystem;

/// What an export came to.
struct ExportFacts {
  std::size_t bodies = 0, moving = 0;
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  void count(const FileRecord& file) {
    ++files;
    bytes += file.size;
  }
};

/// One export's work.
struct ExportWork {
  const Options& options;
  const RunReader& reader;
  const Scene& scene;
  std::vector<int> frames;
  ProgressBar& bar;
  ExportFacts facts;
};

std::vector<int> framesOf(const Options& options, const RunReader& reader) {
  const FrameRange range = options.frames.value_or(FrameRange{});
  const int last = range.last > 0 ? range.last : std::max(reader.lastFrame(), 1);
  reader.requireFrame(range.first);
  reader.requireFrame(last);
  std::vector<int> frames;
  for (int frame = range.first; frame <= last; frame += range.step) frames.push_back(frame);
  return frames;
}

RunMotion motionOf(ExportWork& work) {
  RunMotion motion = readMotion(work.options.path, work.frames);
  work.facts.bodies = motion.bodies.size();
  work.facts.moving =
      static_cast<std::size_t>(std::count_if(motion.bodies.begin(), motion.bodies.end(), [](const BodyMotion& body) {
        return !body.shapes.empty() || std::any_of(body.poses.begin(), body.poses.end(),
                                                   [&](const Pose& pose) { return !(pose == body.poses.front()); });
      }));
  return motion;
}

void exportGltf(ExportWork& work) {
  const RunMotion motion = motionOf(work);
  const std::string bytes = motionToGlb(motion, work.scene.film.fps, looksOf(work.scene.render));
  work.facts.count(writeDurably(work.options.output, bytes));
}

/// The layer lies in `folder`. USD looks for what begins with a dot beside the layer, and elsewhere for what does not.
std::string pathFrom(const fs::path& folder, const fs::path& file) {
  const std::string path = fs::proximate(fs::weakly_canonical(file), fs::weakly_canonical(folder)).generic_string();
  return path.starts_with(".") || path.starts_with("/") ? path : "./" + path;
}

UsdSettings usdSettings(const ExportWork& work) {
  const fs::path folder = fs::absolute(work.options.output).parent_path();
  UsdSettings settings;
  settings.fps = work.scene.film.fps;
  settings.looks = looksOf(work.scene.render);
  for (auto& [name, look] : settings.looks)
    if (!look.picture.empty()) look.picture = pathFrom(folder, look.picture);
  for (const int frame : work.frames)
    settings.gas.push_back({frame, pathFrom(folder, work.options.path / FrameFileNames(frame).gas)});
  const FluidSettings& gas = work.scene.simulation.fluid;
  settings.gasBox = {gas.corner, gas.corner + Vec3d(gas.cells) * gas.cellSize};
  return settings;
}

void exportUsd(ExportWork& work) {
  const std::string text = motionToUsda(motionOf(work), usdSettings(work));
  work.facts.count(writeDurably(work.options.output, text));
}

std::string gasBytes(const ExportWork& work, int frame) {
  const std::string name = FrameFileNames(frame).gas;
  std::string bytes = work.reader.bytes(name);
  if (work.options.profile == ExportProfile::ours) return bytes;
  return gasToVdb(gasFromVdb(bytes, (work.options.path / name).string()), {"velocity", true});
}

/// As wide as pictures draw them: fire and smoke spread by the volume's blur, sparks and grains by their own sizes.
PointFileSettings pointSettings(const Scene& scene) {
  const FluidSettings& gas = scene.simulation.fluid;
  const auto fire = static_cast<float>(scene.render.volume.blur);
  const auto spark = static_cast<float>(scene.render.bits.sparkWidth / 2);
  const auto grain = static_cast<float>(scene.render.bits.grainSize / 2);
  return {gas.corner + Vec3d(0.5, 0.5, 0.5) * gas.cellSize, gas.cellSize, {fire, fire, fire, spark, grain}};
}

std::string pointBytes(const ExportWork& work, int frame) {
  const std::string name = FrameFileNames(frame).particles;
  const FrameParticles particles = particlesFromPly(work.reader.bytes(name), (work.options.path / name).string());
  return particlesToVdb(particles, pointSettings(work.scene));
}

std::string objText(const ExportWork& work, int frame) {
  Frame read;
  work.reader.readBodies(frame, read);
  std::ostringstream text;
  writeObjBodies(text, read.bodies);
  return std::move(text).str();
}

/// A file per frame, in a folder that is there when all of them are.
void exportFolder(ExportWork& work, std::string (*bytesOf)(const ExportWork&, int)) {
  DurableFolder folder(work.options.output);
  int done = 0;
  for (const int frame : work.frames) {
    if (interruptionRequested()) return;
    work.facts.count(folder.add(exportedName(work.options.format, frame), bytesOf(work, frame)));
    work.bar.show("export", ++done, static_cast<int>(work.frames.size()));
  }
  folder.finish();
}

void exportHtml(ExportWork& work) {
  const PlayerRun run(work.options.path, playerSceneOf(work.scene, work.options.path));
  const auto told = [&](int done, int total) { work.bar.show("export", done, total); };
  const std::string page = standalonePage(playerPage(), run, work.frames, told, interruptionRequested);
  if (!interruptionRequested()) work.facts.count(writeDurably(work.options.output, page));
}

void doExport(ExportWork& work) {
  switch (work.options.format) {
    case ExportFormat::gltf:
      return exportGltf(work);
    case ExportFormat::usd:
      return exportUsd(work);
    case ExportFormat::vdb:
      return exportFolder(work, gasBytes);
    case ExportFormat::vdbPoints:
      return exportFolder(work, pointBytes);
    case ExportFormat::obj:
      return exportFolder(work, objText);
    case ExportFormat::html:
      return exportHtml(work);
  }
}

void tell(const ExportWork& work, double seconds) {
  const ExportFacts& facts = work.facts;
  const bool hasMotion = facts.bodies > 0;
  nlohmann::json told = {
      {"output", work.options.output.string()},
      {"frames", {{"first", work.frames.front()}, {"last", work.frames.back()}, {"count", work.frames.size()}}},
      {"files", facts.files},
      {"bytes", facts.bytes},
      {"seconds", seconds}};
  if (hasMotion) told["bodies"] = {{"count", facts.bodies}, {"moving", facts.moving}};
  if (work.options.json) return fmt::print("{}\n", told.dump());
  if (work.options.quiet) return;
  constexpr double bytesPerMegabyte = 1e6;
  fmt::print("{}: {} frames{}, {:.1f} MB in {:.1f} s\n", work.options.output.string(), work.frames.size(),
             hasMotion ? fmt::format(", {} bodies ({} move)", facts.bodies, facts.moving) : "",
             static_cast<double>(facts.bytes) / bytesPerMegabyte, seconds);
}

}  // namespace

int exportCommand(const Options& options) {
  const Stopwatch watch;
  const RunReader reader(options.path);
  const Scene scene = sceneOfRun(options.path);
  ProgressBar bar(ProgressBar::styleFor(options.quiet));
  ExportWork work{options, reader, scene, framesOf(options, reader), bar, {}};
  refuseExportPlace(options);
  doExport(work);
  bar.endLine();
  if (interruptionRequested()) return interruptionExitCode();
  tell(work, watch.seconds());
  return static_cast<int>(ExitCode::done);
}

}  // namespace brisance
