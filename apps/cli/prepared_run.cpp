#include "prepared_run.h"

#include <map>
#include <sstream>

#include "base/check.h"
#include "mesh/mesh_file.h"
#include "render/render_frame.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

constexpr const char* sceneName = "scene.toml";

/// The copy of a file that a run holds already. Throws InputError when it holds another or none.
std::string placeInRun(const RunDirectory& run, const fs::path& source) {
  const std::string hash = recordOf(source).hash;
  for (const auto& [name, entry] : run.manifest())
    if (name.starts_with("inputs/") && entry.file.hash == hash) return name;
  throw InputError(
      fmt::format("{}: is not the file that {} was made with; put it back, or start again with --overwrite",
                  source.string(), run.path().string()));
}

/// The scene's text as it stands in a run, its files named by content.
std::string textInRun(const Scene& scene, const std::function<std::string(const fs::path&)>& placeOf) {
  std::map<fs::path, fs::path> places;
  for (const fs::path& input : scene.inputs) places[input] = placeOf(input);
  return writeScene(withInputs(scene, places));
}

/// Throws unless the run was made from this scene; its number of frames may differ.
void refuseOtherScene(const RunDirectory& run, const Scene& scene) {
  Scene before = readScene(run.path() / sceneName);
  before.simulation.frames = scene.simulation.frames;
  const auto placeOf = [&](const fs::path& input) { return placeInRun(run, input); };
  const std::string key = firstDifference(textInRun(before, placeOf), textInRun(scene, placeOf));
  if (key.empty()) return;
  throw InputError(
      fmt::format("{}: cannot be resumed with another scene: {} differs; set it back, or start again with --overwrite",
                  (run.path() / sceneName).string(), key));
}

RunDirectory::Mode modeFor(const fs::path& path, ExistingRun existing) {
  const bool isRun = fs::exists(path / "manifest.json");
  if (existing == ExistingRun::overwrite) return RunDirectory::Mode::overwrite;
  return existing == ExistingRun::resume && isRun ? RunDirectory::Mode::resume : RunDirectory::Mode::create;
}

/// A scene that lies in the run it replaces would be gone before it is copied.
void refuseOwnInputs(const Scene& scene, const fs::path& run) {
  const fs::path inside = fs::weakly_canonical(run);
  for (const fs::path& input : scene.inputs) {
    const fs::path relative = fs::weakly_canonical(input).lexically_relative(inside);
    if (!relative.empty() && *relative.begin() != "..")
      throw InputError(fmt::format("{}: --overwrite would remove it, and the scene needs it; choose another directory",
                                   input.string()));
  }
}

/// A line of a written scene with the key it belongs to.
struct KeyedLine {
  std::string key, line;
  friend bool operator==(const KeyedLine&, const KeyedLine&) = default;
};

/// "gas.faces" of "[gas.faces]" and "bodies" of "[[bodies]]"; empty: no head of a table.
std::string tableOf(const std::string& line) {
  const std::size_t start = line.find_first_not_of('[');
  return start == 0 || start == std::string::npos ? "" : line.substr(start, line.find(']') - start);
}

std::vector<KeyedLine> keyedLines(const std::string& text) {
  std::vector<KeyedLine> lines;
  std::istringstream stream(text);
  std::string table;
  for (std::string line; std::getline(stream, line);) {
    const std::string head = tableOf(line), name = line.substr(0, line.find(" ="));
    if (!head.empty()) table = head;
    const bool hasKey = head.empty() && name.size() < line.size();
    lines.push_back({hasKey ? fmt::format("{}{}{}", table, table.empty() ? "" : ".", name) : table, line});
  }
  return lines;
}

}  // namespace

void checkInputs(const Scene& scene) {
  for (const BodySettings& body : scene.simulation.bodies)
    if (const auto* mesh = std::get_if<MeshShape>(&body.shape)) readMesh(mesh->file);
  RenderAssets textures(scene.render);
}

RunDirectory prepareRun(const Scene& scene, const fs::path& path, ExistingRun existing) {
  const RunDirectory::Mode mode = modeFor(path, existing);
  if (mode == RunDirectory::Mode::overwrite) refuseOwnInputs(scene, path);
  RunDirectory run(path, mode);
  if (run.manifest().contains(sceneName)) refuseOtherScene(run, scene);
  const std::string text = textInRun(scene, [&](const fs::path& input) { return run.addInput(input); });
  run.add(sceneName, text);
  return run;
}

std::string firstDifference(const std::string& before, const std::string& now) {
  const std::vector<KeyedLine> a = keyedLines(before), b = keyedLines(now);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i >= a.size()) return b[i].key;
    if (i >= b.size() || !(a[i] == b[i])) return a[i].key;
  }
  return "";
}

}  // namespace brisance
