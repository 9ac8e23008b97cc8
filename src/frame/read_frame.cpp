#include <algorithm>
#include <mutex>

#include "base/check.h"
#include "frame/body_file.h"
#include "frame/gas_file.h"
#include "frame/gltf_export.h"
#include "frame/manifest.h"
#include "frame/particle_file.h"
#include "frame/run_directory.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

using Manifest = std::map<std::string, ManifestEntry>;

/// Of bytes that are in memory: what was checked is what is parsed.
FileRecord recordOfBytes(const std::string& bytes) {
  ContentHash hash;
  hash.add(bytes);
  return {bytes.size(), hash.hex()};
}

/// How a file differs from what was written; empty if it does not.
std::string difference(const FileRecord& found, const FileRecord& written) {
  if (found.size != written.size) return fmt::format("has {} bytes, {} were written", found.size, written.size);
  if (found.hash != written.hash) return "is damaged: its hash is not the manifest's";
  return "";
}

std::string problemWith(const fs::path& path, const ManifestEntry& entry) {
  std::error_code error;
  if (!fs::exists(path, error)) return "is missing";
  if (const auto size = fs::file_size(path, error); !error && size != entry.file.size)
    return difference({size, entry.file.hash}, entry.file);
  try {
    return difference(recordOf(path), entry.file);
  } catch (const DamagedFile&) {
    return "cannot be read";
  }
}

/// Number of the last frame of which the manifest knows any result; pictures may be of any frames.
int lastFrameMentioned(const Manifest& manifest) {
  int last = 0;
  for (const auto& [name, entry] : manifest) {
    const int number = frameNumberIn(name);
    const auto names = FrameFileNames(number).all();
    if (std::find(names.begin(), names.end(), name) != names.end()) last = std::max(last, number);
  }
  return last;
}

void addMissingOfFrames(const Manifest& manifest, std::vector<std::string>& problems) {
  const int last = lastFrameMentioned(manifest);
  for (int index = 1; index <= last; ++index)
    for (const std::string& name : FrameFileNames(index).all())
      if (!manifest.contains(name)) problems.push_back(fmt::format("{}: is missing in the manifest", name));
}

std::string shapeFileOf(int frame) { return frame > 0 ? FrameFileNames(frame).shapes : "pieces.glb"; }

}  // namespace

/// The bodies of a file by name, read when the first wants one.
struct RunReader::Shapes {
  std::once_flag read;
  std::map<std::string, FrameBody> bodies;
};

/// Shapes at rest under 0, others under the frame in which bodies took them; those last asked for.
struct RunReader::ShapeFiles {
  std::mutex guard;
  std::map<int, std::shared_ptr<Shapes>> byFrame;
};

RunReader::RunReader(const fs::path& run)
    : run_(run), manifest_(readManifest(run)), shapeFiles_(std::make_unique<ShapeFiles>()) {}
RunReader::~RunReader() = default;

int RunReader::lastFrame() const { return lastWholeFrame(manifest_); }

void RunReader::requireFrame(int index) const {
  if (manifest_.contains(FrameFileNames(index).bodies)) return;
  const int last = lastFrame();
  throw InputError(fmt::format("{}: has no frame {}; it has {}", run_.string(), index,
                               last > 0 ? fmt::format("frames 1 to {}", last) : "none yet"));
}

std::string RunReader::bytes(const std::string& name) const {
  const auto entry = manifest_.find(name);
  const std::string path = (run_ / name).string();
  if (entry == manifest_.end()) throw DamagedFile(fmt::format("{}: is not in the manifest; simulate again", path));
  std::string bytes = readFile(run_ / name);
  const std::string wrong = difference(recordOfBytes(bytes), entry->second.file);
  if (!wrong.empty()) throw DamagedFile(fmt::format("{}: {}; simulate this run again", path, wrong));
  return bytes;
}

/// The shapes that bodies took in a frame, or have at rest; keeps those of a few frames.
std::shared_ptr<const RunReader::Shapes> RunReader::shapesOf(int frame) const {
  constexpr std::size_t fewFrames = 8;
  std::shared_ptr<Shapes> shapes;
  {
    const std::lock_guard lock(shapeFiles_->guard);
    auto& byFrame = shapeFiles_->byFrame;
    if (byFrame.size() > fewFrames && !byFrame.contains(frame))
      std::erase_if(byFrame, [](const auto& item) { return item.first > 0; });
    auto& slot = byFrame[frame];
    if (!slot) slot = std::make_shared<Shapes>();
    shapes = slot;
  }
  std::call_once(shapes->read, [&] {
    const std::string name = shapeFileOf(frame);
    for (FrameBody& body : piecesFromGlb(bytes(name), (run_ / name).string()))
      shapes->bodies.emplace(body.name, std::move(body));
  });
  return shapes;
}

/// Meshes, materials and whether they move, from the pieces at rest or the shapes that they took later; by name, since
/// scenery and pieces may come and go.
void RunReader::readBodies(int index, Frame& frame) const {
  requireFrame(index);
  const std::string name = FrameFileNames(index).bodies;
  bodiesFromJson(bytes(name), (run_ / name).string(), frame);
  std::map<int, std::shared_ptr<const Shapes>> used;
  for (FrameBody& body : frame.bodies) {
    auto& shapes = used[body.shapeFrame];
    if (!shapes) shapes = shapesOf(body.shapeFrame);
    const auto found = shapes->bodies.find(body.name);
    if (found == shapes->bodies.end())
      throw DamagedFile(fmt::format("{}: has no piece named '{}'; simulate again",
                                    (run_ / shapeFileOf(body.shapeFrame)).string(), body.name));
    body.mesh = found->second.mesh;
    body.material = found->second.material;
    body.moves = found->second.moves;
  }
}

Frame readFrame(const fs::path& run, int index, bool withGas) {
  const RunReader reader(run);
  const FrameFileNames names(index);
  const auto pathOf = [&](const std::string& name) { return (run / name).string(); };
  Frame frame;
  reader.readBodies(index, frame);
  frame.particles = particlesFromPly(reader.bytes(names.particles), pathOf(names.particles));
  frame.report = reportFromJson(reader.bytes(names.report), pathOf(names.report));
  if (withGas) frame.gas = gasFromVdb(reader.bytes(names.gas), pathOf(names.gas));
  return frame;
}

std::vector<std::string> verifyRun(const fs::path& run) {
  std::vector<std::string> problems;
  Manifest manifest;
  try {
    manifest = readManifest(run);
  } catch (const DamagedFile& damaged) {
    return {damaged.what()};
  }
  for (const auto& [name, entry] : manifest)
    if (const std::string problem = problemWith(run / name, entry); !problem.empty())
      problems.push_back(fmt::format("{}: {}", name, problem));
  addMissingOfFrames(manifest, problems);
  return problems;
}

}  // namespace brisance
