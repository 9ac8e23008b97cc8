#include "export_place.h"

#include <algorithm>

#include "base/check.h"
#include "frame/manifest.h"

namespace brisance {

namespace {

namespace fs = std::filesystem;

bool makesFolder(ExportFormat format) {
  return format == ExportFormat::vdb || format == ExportFormat::vdbPoints || format == ExportFormat::obj;
}

/// Of a format that makes one file.
const char* endingOf(ExportFormat format) {
  if (format == ExportFormat::html) return ".html";
  return format == ExportFormat::gltf ? ".glb" : ".usda";
}

void refuseEnding(const Options& options) {
  const std::string ending = endingOf(options.format);
  if (!makesFolder(options.format) && options.output.extension() != ending)
    throw InputError(fmt::format("{}: must end in {}", options.output.string(), ending));
}

fs::path resolved(const fs::path& path) {
  const fs::path whole = fs::weakly_canonical(path);
  return whole.has_filename() ? whole : whole.parent_path();
}

/// A run's own files are not for others to replace; only the place of a finished animation is kept for one.
void refuseInsideRun(const Options& options) {
  const std::string name = resolved(options.output).lexically_relative(resolved(options.path)).generic_string();
  const auto& folders = runFolders();
  const bool isFolder = std::find(folders.begin(), folders.end(), name) != folders.end();
  if (name == "." || isFolder || (isNameOfRunFile(name) && name != "bodies/animation.glb"))
    throw InputError(fmt::format("{}: belongs to the run; choose another place", options.output.string()));
}

/// True for a folder with nothing in it but files of the format.
bool isEarlierExport(const Options& options) {
  const std::string like = exportedName(options.format, 1);
  const std::string lead = like.substr(0, like.find('.') + 1), ending = fs::path(like).extension();
  return std::all_of(fs::directory_iterator(options.output), {}, [&](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename();
    return entry.is_regular_file() && name.starts_with(lead) && name.ends_with(ending);
  });
}

void refuseExisting(const Options& options) {
  const fs::path& output = options.output;
  if (!fs::exists(output)) return;
  const bool folder = makesFolder(options.format);
  if (fs::is_directory(output) != folder)
    throw InputError(fmt::format("{}: is {} directory; choose another name", output.string(), folder ? "no" : "a"));
  if (folder && fs::is_empty(output)) return;
  if (options.existing != ExistingRun::overwrite)
    throw InputError(fmt::format("{}: is there already; --overwrite replaces it", output.string()));
  if (folder && !isEarlierExport(options))
    throw InputError(fmt::format("{}: holds more than {} files; choose another folder", output.string(),
                                 fs::path(exportedName(options.format, 1)).extension().string()));
}

void refuseMissingParent(const fs::path& output) {
  const fs::path parent = fs::absolute(output.has_filename() ? output : output.parent_path()).parent_path();
  if (!fs::is_directory(parent))
    throw InputError(fmt::format("{}: {} is no directory", output.string(), parent.string()));
}

}  // namespace

std::string exportedName(ExportFormat format, int frame) {
  if (format == ExportFormat::vdb) return fmt::format("gas.{:04}.vdb", frame);
  if (format == ExportFormat::vdbPoints) return fmt::format("particles.{:04}.vdb", frame);
  return fmt::format("bodies.{:04}.obj", frame);
}

void refuseExportPlace(const Options& options) {
  refuseEnding(options);
  refuseMissingParent(options.output);
  refuseInsideRun(options);
  refuseExisting(options);
}

}  // namespace brisance
