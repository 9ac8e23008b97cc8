#include "frame/manifest.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/check.h"

namespace brisance {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int formatVersion = 1;

ManifestEntry entryFrom(const Json& json) {
  return {{json.at("size").get<std::uint64_t>(), json.at("hash").get<std::string>()}, json.value("content", "")};
}

std::map<std::string, ManifestEntry> manifestFromJson(const std::string& text, const std::string& fileName) {
  std::map<std::string, ManifestEntry> manifest;
  const Json root = Json::parse(text);
  if (const int version = root.at("version").get<int>(); version != formatVersion)
    throw DamagedFile(fmt::format("{}: has version {}, this program reads {}", fileName, version, formatVersion));
  for (const auto& [name, entry] : root.at("files").items()) {
    if (!isNameInRun(name)) throw DamagedFile(fmt::format("{}: names '{}', which is not in the run", fileName, name));
    manifest.emplace(name, entryFrom(entry));
  }
  return manifest;
}

}  // namespace

FrameFileNames::FrameFileNames(int index)
    : gas(frameFile("gas", "gas", index, "vdb")),
      bodies(frameFile("bodies", "bodies", index, "json")),
      particles(frameFile("particles", "particles", index, "ply")),
      report(frameFile("reports", "report", index, "json")),
      shapes(frameFile("bodies", "shapes", index, "glb")) {}

std::string frameFile(const std::string& folder, const std::string& stem, int index, const std::string& extension) {
  return fmt::format("{}/{}.{:04}.{}", folder, stem, index, extension);
}

std::string manifestToJson(const std::map<std::string, ManifestEntry>& manifest) {
  Json files = Json::object();
  for (const auto& [name, entry] : manifest) {
    Json& json = files[name] = {{"size", entry.file.size}, {"hash", entry.file.hash}};
    if (!entry.content.empty()) json["content"] = entry.content;
  }
  const Json root{{"version", formatVersion}, {"hash", "xxh3-128"}, {"files", std::move(files)}};
  return root.dump(1) + "\n";
}

std::map<std::string, ManifestEntry> readManifest(const fs::path& run) {
  const fs::path path = run / manifestName;
  if (std::error_code error; !fs::exists(path, error))
    throw InputError(
        fmt::format("{}: holds no run (no {}); name a directory that 'brisance run' or 'brisance simulate' made",
                    run.string(), manifestName));
  try {
    return manifestFromJson(readFile(path), path.string());
  } catch (const Json::exception& error) {
    throw DamagedFile(fmt::format("{}: is damaged ({}); run again with --overwrite", path.string(), error.what()));
  }
}

int lastWholeFrame(const std::map<std::string, ManifestEntry>& manifest) {
  const auto isWhole = [&](int index) {
    const auto names = FrameFileNames(index).all();
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) { return manifest.contains(name); });
  };
  int last = 0;
  while (isWhole(last + 1)) ++last;
  return last;
}

bool isNameInRun(const std::string& name) {
  const fs::path path(name);
  if (name.empty() || name == manifestName || path.is_absolute() || path.lexically_normal() != path) return false;
  return std::none_of(path.begin(), path.end(),
                      [](const fs::path& part) { return part.empty() || part.string().starts_with("."); });
}

namespace {

/// Files with a frame's number between `lead` and the extension.
struct NumberedFiles {
  std::string_view lead, extension;
};
constexpr NumberedFiles numberedFiles[] = {
    {"gas/gas.", ".vdb"},       {"reports/report.", ".json"},       {"bodies/bodies.", ".json"},
    {"bodies/shapes.", ".glb"}, {"particles/particles.", ".ply"},   {"images/frame.", ".png"},
    {"images/frame.", ".exr"},  {"checkpoints/checkpoint.", ".bin"}};
constexpr std::string_view singleFiles[] = {"scene.toml", "run.json", manifestName,
                                            "pieces.glb", "film.mp4", "bodies/animation.glb"};

std::size_t countLeading(std::string_view text, std::string_view characters) {
  return std::min(text.find_first_not_of(characters), text.size());
}

int numberBetween(std::string_view name, const NumberedFiles& files) {
  constexpr std::size_t fewest = 4, most = 9;  // digits
  if (!name.starts_with(files.lead) || !name.ends_with(files.extension)) return 0;
  const std::string_view rest = name.substr(files.lead.size());
  const std::size_t digits = countLeading(rest, "0123456789");
  if (digits < fewest || digits > most || rest.substr(digits) != files.extension) return 0;
  return std::stoi(std::string(rest.substr(0, digits)));
}

/// inputs/HASH or inputs/HASH.EXTENSION
bool isInput(std::string_view name) {
  constexpr std::string_view lead = "inputs/";
  constexpr std::size_t hashDigits = 32;
  if (!name.starts_with(lead)) return false;
  const std::string_view rest = name.substr(lead.size());
  if (countLeading(rest, "0123456789abcdef") != hashDigits) return false;
  return rest.size() == hashDigits || (rest[hashDigits] == '.' && rest.find('/') == rest.npos);
}

}  // namespace

int frameNumberIn(const std::string& name) {
  for (const NumberedFiles& files : numberedFiles)
    if (const int number = numberBetween(name, files); number > 0) return number;
  return 0;
}

bool isNameOfRunFile(const std::string& name) {
  return std::find(std::begin(singleFiles), std::end(singleFiles), name) != std::end(singleFiles) || isInput(name) ||
         frameNumberIn(name) > 0;
}

const std::vector<std::string>& runFolders() {
  static const std::vector<std::string> folders{"inputs",    "gas",         "reports", "bodies",
                                                "particles", "checkpoints", "images"};
  return folders;
}

}  // namespace brisance
