// brisance fracture: a mesh, or the bodies of a scene, in pieces.
#include <algorithm>
#include <cstdio>

#include "base/check.h"
#include "base/durable_file.h"
#include "broken_body.h"
#include "commands.h"
#include "frame/gltf_export.h"
#include "frame/piece_files.h"
#include "render/picture_file.h"
#include "render/piece_picture.h"

namespace brisance {
namespace {

namespace fs = std::filesystem;

enum class Format { glb, obj, ply, png };

Format formatOf(const fs::path& output) {
  const std::string extension = output.extension();
  if (extension == ".glb") return Format::glb;
  if (extension == ".obj") return Format::obj;
  if (extension == ".ply") return Format::ply;
  if (extension == ".png") return Format::png;
  throw InputError(fmt::format("{}: must end in .glb, .obj, .ply or .png", output.string()));
}

/// What is to be written, with the pictures that belong beside glTF files.
std::vector<fs::path> outputsOf(const FractureOptions& options) {
  std::vector<fs::path> outputs = options.outputs;
  for (const fs::path& output : options.outputs)
    if (formatOf(output) == Format::glb && options.picture)
      outputs.push_back(fs::path(output).replace_extension(".png"));
  std::sort(outputs.begin(), outputs.end());
  outputs.erase(std::unique(outputs.begin(), outputs.end()), outputs.end());
  return outputs;
}

/// Nothing is worked on that could not be written in the end.
void refuseExisting(const std::vector<fs::path>& outputs, const Options& options) {
  std::vector<fs::path> files = outputs;
  if (!options.fracture.labels.empty()) files.push_back(options.fracture.labels);
  for (const fs::path& file : files) {
    if (fs::exists(file) && options.existing != ExistingRun::overwrite)
      throw InputError(fmt::format("{}: is there already; --overwrite replaces it", file.string()));
    const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(directory))
      throw InputError(fmt::format("{}: {} is no directory", file.string(), directory.string()));
  }
}

Picture pictureOf(const std::vector<FrameBody>& pieces, const Options& options) {
  PiecePictureSettings settings;
  settings.explode = options.fracture.explode;
  if (options.size) {
    settings.width = options.size->width;
    settings.height = options.size->height;
  }
  return drawPieces(pieces, settings);
}

void write(const fs::path& output, const std::vector<FrameBody>& pieces, const Options& options) {
  switch (formatOf(output)) {
    case Format::glb:
      writeDurably(output, piecesToGlb(pieces));
      return;
    case Format::obj:
      writeDurably(output, [&](std::ostream& out) { writeObjBodies(out, pieces); });
      return;
    case Format::ply:
      writeDurably(output, [&](std::ostream& out) { writePlyBodies(out, pieces); });
      return;
    case Format::png:
      writeDurably(output, encodePng(pictureOf(pieces, options)));
      return;
  }
}

void writeLabels(const fs::path& file, const std::vector<int>& pieceOfTriangle) {
  std::string text;
  for (const int piece : pieceOfTriangle) text += fmt::format("{}\n", piece);
  writeDurably(file, text);
}

std::vector<BrokenBody> breakAll(const Options& options) {
  if (options.path.extension() == ".toml") return breakScene(options);
  if (!options.overrides.empty()) throw InputError("brisance: --set: belongs to a scene, not to a mesh");
  std::vector<BrokenBody> bodies;
  bodies.push_back(breakMeshFile(options));
  return bodies;
}

}  // namespace

int fractureCommand(const Options& options) {
  const std::vector<fs::path> outputs = outputsOf(options.fracture);
  refuseExisting(outputs, options);
  const std::vector<BrokenBody> bodies = breakAll(options);
  const Stopwatch watch;
  const std::vector<FrameBody> pieces = piecesAtRest(bodies);
  for (const fs::path& output : outputs) write(output, pieces, options);
  if (!options.fracture.labels.empty()) writeLabels(options.fracture.labels, bodies.front().broken.pieceOfTriangle);
  const double writing = watch.seconds();
  if (options.json)
    fmt::print("{}\n", fractureJson(bodies, options, writing));
  else if (!options.quiet)
    fmt::print("{}", fractureText(bodies, outputs, writing));
  return static_cast<int>(ExitCode::done);
}

}  // namespace brisance
