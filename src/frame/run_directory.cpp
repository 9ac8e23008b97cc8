#include "frame/run_directory.h"

#include <optional>
#include <system_error>

#include "base/check.h"
#include "base/durable_batch.h"
#include "frame/body_file.h"
#include "frame/gas_file.h"
#include "frame/gltf_export.h"
#include "frame/manifest.h"
#include "frame/particle_file.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

enum class Found { nothing, run, something };

/// A directory in which a process was killed before its first manifest holds only hidden files, and counts as nothing.
Found look(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return Found::nothing;
  if (!fs::is_directory(path, error)) return Found::something;
  if (fs::exists(path / manifestName, error)) return Found::run;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const std::string name = entry.path().filename().string();
    if (name != ".lock" && name != ".turn" && !name.starts_with(".tmp.")) return Found::something;
  }
  if (error) throw Error(ExitCode::noRoom, fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  return Found::nothing;
}

void refuseWrongPlace(const fs::path& path, RunDirectory::Mode mode) {
  using Mode = RunDirectory::Mode;
  const Found found = look(path);
  const bool makesNew = mode == Mode::create || mode == Mode::overwrite;
  if (makesNew && found == Found::something)
    throw InputError(fmt::format("{}: is in use and holds no run; choose a new or an empty directory", path.string()));
  if (mode == Mode::create && found == Found::run)
    throw InputError(
        fmt::format("{}: holds a run already; --resume continues it, --overwrite replaces it, or choose another "
                    "directory",
                    path.string()));
  if (mode == Mode::resume && found != Found::run)
    throw InputError(fmt::format("{}: holds no run to resume; leave out --resume to start one", path.string()));
  if ((mode == Mode::open || mode == Mode::share) && found != Found::run)
    throw InputError(fmt::format("{}: holds no run; name a directory that 'brisance run' or 'brisance simulate' made",
                                 path.string()));
}

void removeAllTemporaries(const fs::path& run) {
  removeTemporaries(run);
  for (const std::string& folder : runFolders()) removeTemporaries(run / folder);
}

/// Files of a run in its folders, whether a manifest knows them or not.
std::vector<std::string> runFilesIn(const fs::path& run) {
  std::vector<std::string> names;
  std::error_code error;
  const auto addFrom = [&](const std::string& folder) {
    for (const auto& entry : fs::directory_iterator(run / folder, error)) {
      const std::string name = (fs::path(folder) / entry.path().filename()).generic_string();
      if (name != manifestName && isNameOfRunFile(name)) names.push_back(name);
    }
  };
  addFrom("");
  for (const std::string& folder : runFolders()) addFrom(folder);
  return names;
}

/// Names in the manifest of a run that is about to go; a damaged manifest does not save it.
std::vector<std::string> namesInManifest(const fs::path& run) {
  std::vector<std::string> names;
  try {
    for (const auto& [name, entry] : readManifest(run)) names.push_back(name);
  } catch (const Error&) {
    names.clear();
  }
  return names;
}

void deleteFiles(const fs::path& run, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code error;
    fs::remove(run / name, error);
    if (error)
      throw Error(ExitCode::noRoom, fmt::format("{}: cannot be removed: {}", (run / name).string(), error.message()));
  }
}

/// Those that hold nothing else.
void removeEmptyFolders(const fs::path& run) {
  for (const std::string& folder : runFolders()) {
    std::error_code notEmpty;
    fs::remove(run / folder, notEmpty);
  }
}

/// Bodies that took another shape in this frame.
std::vector<FrameBody> reshapedIn(const Frame& frame) {
  std::vector<FrameBody> bodies;
  for (const FrameBody& body : frame.bodies)
    if (body.shapeFrame == frame.index) bodies.push_back(body);
  return bodies;
}

/// True while it lives.
class OnlyNow {
 public:
  explicit OnlyNow(bool& flag) : flag_(flag) { flag_ = true; }
  ~OnlyNow() { flag_ = false; }
  OnlyNow(const OnlyNow&) = delete;
  OnlyNow& operator=(const OnlyNow&) = delete;

 private:
  bool& flag_;
};

bool hasRecordedSize(const fs::path& path, const ManifestEntry& entry) {
  std::error_code error;
  return fs::file_size(path, error) == entry.file.size && !error;
}

}  // namespace

RunDirectory::RunDirectory(const fs::path& path, Mode mode) : path_(path), shared_(mode == Mode::share) {
  refuseWrongPlace(path_, mode);
  if (mode == Mode::create || mode == Mode::overwrite) makeDirectories(path_);
  takeLock();
  refuseWrongPlace(path_, mode);  // another process may have been first
  if (mode == Mode::create) writeManifest();
  if (mode == Mode::overwrite) replaceOldRun();
  if (mode == Mode::resume) continueOldRun();
  if (mode == Mode::open || mode == Mode::share) manifest_ = readManifest(path_);
}

/// What killed processes left goes while nobody else can be at work. One after the other where several may come: the
/// first has the lock alone for that moment.
void RunDirectory::takeLock() {
  using Kind = DirectoryLock::Kind;
  std::optional<DirectoryTurn> turn;
  if (shared_) turn.emplace(path_);
  lock_ = std::make_unique<DirectoryLock>(path_, shared_ ? Kind::together : Kind::alone);
  if (lock_->foundAlone()) removeAllTemporaries(path_);
  lock_->letOthersIn();
}

void RunDirectory::inTurn(const std::function<void()>& work) {
  if (!shared_ || turn_) return work();
  const DirectoryTurn turn(path_);
  const OnlyNow ours(turn_);
  manifest_ = readManifest(path_);
  work();
}

/// The empty manifest comes first: killed in between, the directory holds a new run and some files that it ignores.
void RunDirectory::replaceOldRun() {
  const std::vector<std::string> old = namesInManifest(path_);
  writeManifest();
  deleteFiles(path_, old);
  deleteFiles(path_, runFilesIn(path_));
  removeEmptyFolders(path_);
}

/// Files that somebody deleted or cut off since are made again. Checkpoints that the manifest does not know go: a
/// process was killed between forgetting and deleting them.
void RunDirectory::continueOldRun() {
  manifest_ = readManifest(path_);
  if (std::erase_if(manifest_, [&](const auto& item) { return !hasRecordedSize(path_ / item.first, item.second); }) > 0)
    writeManifest();
  std::vector<std::string> forgotten = runFilesIn(path_);
  std::erase_if(forgotten,
                [&](const auto& name) { return !name.starts_with("checkpoints/") || manifest_.contains(name); });
  deleteFiles(path_, forgotten);
}

void RunDirectory::writeManifest() { writeDurably(path_ / manifestName, manifestToJson(manifest_)); }

/// Of a file that is to be written; its folder is there.
fs::path RunDirectory::placeOf(const std::string& name) const {
  CHECK(isNameInRun(name), "{}", name);
  fs::path path = path_ / name;
  makeDirectories(path.parent_path());
  return path;
}

void RunDirectory::add(const std::string& name, const std::string& bytes, const std::string& content) {
  inTurn([&] { record({{name, {writeDurably(placeOf(name), bytes), content}}}); });
}

StagedFile RunDirectory::stage(const std::string& name, const std::function<void(std::ostream&)>& write) const {
  StagedFile file{name, std::make_unique<DurableBatch>(), {}};
  file.record = file.batch->add(placeOf(name), write);
  return file;
}

void RunDirectory::add(StagedFile file) {
  file.batch->finish();
  record({{file.name, {file.record, ""}}});
}

void RunDirectory::add(const std::vector<NewFile>& files) {
  inTurn([&] {
    DurableBatch batch;
    std::map<std::string, ManifestEntry> entries;
    for (const NewFile& file : files) entries[file.name] = {batch.add(placeOf(file.name), file.write), file.content};
    batch.finish();
    record(entries);
  });
}

void RunDirectory::record(const std::map<std::string, ManifestEntry>& entries) {
  inTurn([&] {
    for (const auto& [name, entry] : entries) {
      CHECK(isNameInRun(name), "{}", name);
      manifest_[name] = entry;
    }
    writeManifest();
  });
}

void RunDirectory::remove(const std::vector<std::string>& names) {
  inTurn([&] {
    for (const std::string& name : names) {
      CHECK(isNameInRun(name), "{}", name);
      manifest_.erase(name);
    }
    writeManifest();
    deleteFiles(path_, names);
  });
}

std::string RunDirectory::addInput(const fs::path& source) {
  const std::string bytes = readFile(source);
  ContentHash hash;
  hash.add(bytes);
  std::string name = "inputs/" + hash.hex() + source.extension().string();
  if (!manifest_.contains(name)) add(name, bytes);
  return name;
}

namespace {
/// The function is copied with whatever it holds: the bytes are shared.
NewFile newFile(const std::string& name, std::string bytes, const std::string& content = "") {
  const auto shared = std::make_shared<const std::string>(std::move(bytes));
  return {name, [shared](std::ostream& out) { out << *shared; }, content};
}
NewFile newFile(const std::string& name, PackedGas gas) {
  const auto shared = std::make_shared<const PackedGas>(std::move(gas));
  return {name, [shared](std::ostream& out) { shared->writeTo(out); }, shared->content};
}
}  // namespace

std::vector<NewFile> filesOf(const Frame& frame, const GasSource& source) {
  const FrameFileNames names(frame.index);
  std::vector<NewFile> files{newFile(names.gas, packGas(source)),
                             newFile(names.bodies, bodiesToJson(frame), contentHash(frame.bodies)),
                             newFile(names.particles, particlesToPly(frame.particles), contentHash(frame.particles)),
                             newFile(names.report, reportToJson(frame))};
  const std::vector<FrameBody> reshaped = reshapedIn(frame);
  if (!reshaped.empty()) files.push_back(newFile(names.shapes, piecesToGlb(reshaped)));
  return files;
}

int RunDirectory::lastFrame() const { return lastWholeFrame(manifest_); }

}  // namespace brisance
