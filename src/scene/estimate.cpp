#include "scene/estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "fluid/donor_sweep.h"
#include "simulation/world.h"

namespace brisance {
namespace {

// Bytes for each thing, from the fields that hold it, in single precision where nothing else is said.
constexpr double field = 4;
constexpr double stateMemory = 10 * field;      // velocity, pressure, temperature, soot, flame, and the three sources
constexpr double solidMemory = 4 * field + 1;   // open shares, regions, what is inside
constexpr double pressureMemory = 2 * field;    // the solver's field and its work
constexpr double sweepMemory = 3.4 * field;     // where a donor-cell step puts the new velocity, and planes of scalars
constexpr double separateMemory = 12 * field;   // padded and new velocity and scalar, and a velocity of the whirls'
constexpr double pathMemory = 3 * field;        // whence semi_lagrangian's gas came
constexpr double multigridMemory = 13 * field;  // six vectors and seven entries of a row, an eighth more in all levels
constexpr double gradientMemory = 8 * field;    // four vectors in double precision
constexpr double movingMemory = 20 * field;     // where moving bodies block gas: what faces and cells are, twice
constexpr double depositMemory = field + 1;     // among solids: what is inside, and the share of a kernel in gas
constexpr double writingMemory = 11 * field;    // the frame's packed file and the transforms' room
constexpr double largeField = 32 << 20;         // [bytes] from here on what is freed goes back at once
constexpr double givenBackMemory = 6 * field;
constexpr double volumeCellMemory = 32;  // density and colour, and their copy while blurring
constexpr double particleMemory = 280;   // fields 83, to sort 83, and deposits or the frame and its file 110, measured
constexpr double pixelMemory = 32;       // colour and weights in single precision, and the encoded picture
constexpr double baseMemory = 45e6;      // the program and its libraries
constexpr double pieceBytes = 20e3;      // a shard's mesh of some hundred triangles, on disk and in memory
constexpr double hullBytes = 40e3;       // where bodies collide: a piece's convex parts, and where they are now
constexpr double gasCellDisk = 24;       // three scalars and a vector, before compression
constexpr double particleDisk = 33;      // position, velocity, mass, temperature, kind
constexpr double posedPieceDisk = 100;   // pose and velocities, per frame
constexpr double checkpointCellDisk = 28;  // velocity, pressure, temperature, soot, flame
constexpr double checkpointParticleDisk = 83;
constexpr double layeredPixelMemory = 700;  // variance, halves, layers, guides, the filter's planes, the encoded file
constexpr double pixelDisk = 3, exrPixelDisk = 6, layersPixelDisk = 90;  // PNG, OpenEXR, its layers, uncompressed
constexpr double filmPixelDisk = 0.5;                                    // of the encoded film, at a good rate factor

std::int64_t clamped(double bytes) { return static_cast<std::int64_t>(std::min(bytes, 9e18)); }
double countOf(const Vec3i& cells) { return static_cast<double>(cells.x) * cells.y * cells.z; }
double gigabytes(std::int64_t bytes) { return static_cast<double>(bytes) / 1e9; }

/// What whole pages of 2 MB take beyond the numbers that lie in them, of nine fields of faces and ten of cells.
double pagesMemory(const Vec3i& cells) {
  constexpr double page = 2 << 20;
  const auto beyond = [&](const Vec3i& samples) {
    const double bytes = countOf(samples) * field;
    return bytes < page ? 0 : std::ceil(bytes / page) * page - countOf(cells) * field;
  };
  return 3 * (beyond({cells.x + 1, cells.y, cells.z}) + beyond({cells.x, cells.y + 1, cells.z}) +
              beyond({cells.x, cells.y, cells.z + 1})) +
         10 * beyond(cells);
}

double gasCellMemory(const SimulationSettings& s) {
  double bytes = stateMemory + solidMemory + writingMemory;
  if (countOf(s.fluid.cells) * field > largeField) bytes -= givenBackMemory;
  bytes += sweepsSuffice(s.fluid, s.fluid.courant) ? sweepMemory : separateMemory;
  if (std::holds_alternative<SemiLagrangian>(s.fluid.advection)) bytes += pathMemory;
  if (std::holds_alternative<MultigridSolver>(s.fluid.pressure)) bytes += multigridMemory;
  bytes += std::holds_alternative<ConjugateGradient>(s.fluid.pressure) ? gradientMemory : pressureMemory;
  if (s.bodiesInGas == BodiesInGas::block) bytes += movingMemory;
  const auto blocks = [](const BodySettings& body) { return body.blocksGas; };
  if (std::any_of(s.bodies.begin(), s.bodies.end(), blocks)) bytes += depositMemory;
  return bytes;
}

double simulatingMemory(const Scene& scene, const SceneEstimate& cost) {
  const bool collide = std::holds_alternative<Contacts>(scene.simulation.rigid.collisions);
  return (collide ? static_cast<double>(cost.pieces) * hullBytes : 0) +
         static_cast<double>(cost.cells) * gasCellMemory(scene.simulation) + pagesMemory(scene.simulation.fluid.cells) +
         static_cast<double>(cost.particles) * particleMemory;
}

double drawingMemory(const Scene& scene, const SceneEstimate& cost) {
  const double pixels = static_cast<double>(scene.render.width) * scene.render.height;
  const bool measures = scene.render.denoise || (scene.render.writeExr && scene.render.layers);
  return static_cast<double>(cost.volumeCells) * volumeCellMemory +
         pixels * (pixelMemory + (measures ? layeredPixelMemory : 0));
}

double bytesPerPixel(const RenderSettings& render) {
  const double exr = exrPixelDisk + (render.layers ? layersPixelDisk : 0);
  return pixelDisk + filmPixelDisk + (render.writeExr ? exr : 0);
}

double diskOf(const Scene& scene, const SceneEstimate& cost) {
  const double cells = static_cast<double>(cost.cells), particles = static_cast<double>(cost.particles);
  const double pixels = static_cast<double>(scene.render.width) * scene.render.height;
  const double frame = cells * gasCellDisk + particles * particleDisk + pixels * bytesPerPixel(scene.render) +
                       static_cast<double>(cost.pieces) * posedPieceDisk;
  constexpr int checkpointsKept = 2;
  return cost.frames * frame + checkpointsKept * (cells * checkpointCellDisk + particles * checkpointParticleDisk) +
         static_cast<double>(cost.pieces) * pieceBytes;
}

/// A number of bytes after `label` in a file of the kernel's; none where there is no such file or line.
std::optional<std::int64_t> kernelNumber(const char* file, const std::string& label, std::int64_t unit) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    std::int64_t number = 0;
    if (label.empty()) return word == "max" ? std::nullopt : std::optional(std::strtoll(word.c_str(), nullptr, 10));
    if (word == label && in >> number) return number * unit;
  }
  return std::nullopt;
}

constexpr const char* machineFile = "/proc/meminfo";
constexpr std::int64_t kibibyte = 1024;

std::optional<std::int64_t> containerLimit() { return kernelNumber("/sys/fs/cgroup/memory.max", "", 1); }

void checkFreeMemory(const SceneEstimate& cost, SceneCheck& check) {
  if (cost.memory <= freeMemory()) return;
  check.problems.push_back(
      fmt::format("memory: needs {:.1f} GB, free {:.1f} GB; make gas.cells or render.volume.cells smaller",
                  gigabytes(cost.memory), gigabytes(freeMemory())));
  check.code = ExitCode::noRoom;
}

void checkDisk(const SceneEstimate& cost, std::filesystem::path place, SceneCheck& check) {
  std::error_code error;
  place = std::filesystem::absolute(place, error);
  while (!std::filesystem::exists(place, error) && place.has_relative_path()) place = place.parent_path();
  const auto space = std::filesystem::space(place, error);
  if (error || static_cast<double>(cost.disk) <= static_cast<double>(space.available)) return;
  check.problems.push_back(fmt::format("disk: needs up to {:.1f} GB, free {:.1f} GB at {}", gigabytes(cost.disk),
                                       gigabytes(clamped(static_cast<double>(space.available))), place.string()));
  check.code = ExitCode::noRoom;
}

}  // namespace

SceneEstimate estimate(const Scene& scene) {
  SceneEstimate cost;
  cost.frames = scene.simulation.frames;
  cost.cells = clamped(countOf(scene.simulation.fluid.cells));
  cost.volumeCells = scene.render.volume.drawn ? clamped(countOf(scene.render.volume.cells)) : 0;
  cost.bodies = static_cast<std::int64_t>(scene.simulation.bodies.size());
  for (const BodySettings& body : scene.simulation.bodies) cost.pieces += body.fracture.pieces;
  cost.particles = predictedParticles(scene.simulation);
  const double always = baseMemory + static_cast<double>(cost.pieces) * pieceBytes;
  cost.simulating = clamped(always + simulatingMemory(scene, cost));
  cost.drawing = clamped(always + drawingMemory(scene, cost));
  cost.memory = std::max(cost.simulating, cost.drawing);
  cost.disk = clamped(diskOf(scene, cost));
  return cost;
}

std::int64_t machineMemory() {
  const std::int64_t machine =
      kernelNumber(machineFile, "MemTotal:", kibibyte).value_or(std::numeric_limits<std::int64_t>::max());
  return std::min(machine, containerLimit().value_or(machine));
}

std::int64_t freeMemory() {
  const std::int64_t available = kernelNumber(machineFile, "MemAvailable:", kibibyte).value_or(machineMemory());
  const auto limit = containerLimit();
  const auto used = kernelNumber("/sys/fs/cgroup/memory.current", "", 1);
  return limit && used ? std::min(available, *limit - *used) : available;
}

void requireMemory(const Scene& scene, const std::string& name) {
  const SceneEstimate cost = estimate(scene);
  if (cost.memory <= machineMemory()) return;
  throw Error(
      ExitCode::noRoom,
      fmt::format("{}: gas of {} cells, a volume of {} cells and {} particles need {:.1f} GB of memory, this machine "
                  "has {:.1f} GB; make gas.cells or render.volume.cells smaller",
                  name, cost.cells, cost.volumeCells, cost.particles, gigabytes(cost.memory),
                  gigabytes(machineMemory())));
}

SceneCheck checkScene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                      const std::filesystem::path& run) {
  SceneCheck check;
  try {
    check.cost = estimate(readScene(file, overrides));
    checkFreeMemory(*check.cost, check);
    checkDisk(*check.cost, run, check);
  } catch (const Error& error) {
    check.problems.emplace_back(error.what());
    check.code = error.code;
  }
  return check;
}

std::string estimateText(const SceneEstimate& cost) {
  return fmt::format(
      "{} frames\n{} gas cells, {} volume cells\n{} bodies in {} pieces\n{} particles at most\n"
      "{:.2f} GB of memory to simulate, {:.2f} GB to draw, {:.2f} GB of disk at most\n",
      cost.frames, cost.cells, cost.volumeCells, cost.bodies, cost.pieces, cost.particles, gigabytes(cost.simulating),
      gigabytes(cost.drawing), gigabytes(cost.disk));
}

std::string checkJson(const SceneCheck& check) {
  nlohmann::ordered_json json{{"ok", check.ok()}};
  if (check.cost) {
    const SceneEstimate& cost = *check.cost;
    json.update({{"frames", cost.frames},
                 {"cells", cost.cells},
                 {"volume_cells", cost.volumeCells},
                 {"bodies", cost.bodies},
                 {"pieces", cost.pieces},
                 {"particles", cost.particles},
                 {"memory_bytes", cost.memory},
                 {"simulating_bytes", cost.simulating},
                 {"drawing_bytes", cost.drawing},
                 {"bytes", cost.disk}});
  }
  json["problems"] = check.problems;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace brisance
