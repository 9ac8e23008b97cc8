// The files of a run (docs/files.md): every finished one in the manifest with its hash.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/durable_batch.h"
#include "frame/gas_file.h"

namespace brisance {

/// What the manifest holds for a file.
struct ManifestEntry {
  FileRecord file;
  std::string
      content;  ///< hash of what the file means (grid values, poses, particles, pixels); empty where bytes say it all
};

/// A file of a run that is yet to be written.
struct NewFile {
  std::string name;                          ///< in the run
  std::function<void(std::ostream&)> write;  ///< holds the bytes
  std::string content;                       ///< as in ManifestEntry
};

/// gas, bodies, particles and report of a frame, and the shapes that bodies took in it.
std::vector<NewFile> filesOf(const Frame& frame, const GasSource& gas);

/// A file on the disk under a temporary name. Without RunDirectory::add it goes again.
struct StagedFile {
  std::string name;  ///< in the run
  std::unique_ptr<DurableBatch> batch;
  FileRecord record;
};

/// A run directory being written or read. Paths in the manifest are relative, with '/'.
class RunDirectory {
 public:
  enum class Mode {
    create,     ///< must not hold a run yet
    overwrite,  ///< an old run's files are removed first
    resume,     ///< continue an old run
    open,       ///< film: add files to a run
    share       ///< pictures: add files to a run that other processes, on any machine, add theirs to meanwhile
  };
  /// Takes the lock, in mode `share` together with others of that mode. Throws InputError for a run that exists
  /// (create) or does not (resume, open, share), with the option that would do it; Error for one that others work in.
  RunDirectory(const std::filesystem::path& path, Mode mode);

  const std::filesystem::path& path() const { return path_; }
  const std::map<std::string, ManifestEntry>& manifest() const { return manifest_; }

  /// Reads the manifest anew, and works while no other process changes the run. In the modes that have the run to
  /// themselves it only works.
  void inTurn(const std::function<void()>& work);
  /// Writes a file durably and then the manifest. These all work in their turn.
  void add(const std::string& name, const std::string& bytes, const std::string& content = "");
  /// The same in two parts, the second of which may wait for the disk.
  StagedFile stage(const std::string& name, const std::function<void(std::ostream&)>& write) const;
  void add(StagedFile file);
  /// Several files that become known together: written first, then one manifest.
  void record(const std::map<std::string, ManifestEntry>& entries);
  /// Forgets and deletes.
  void remove(const std::vector<std::string>& names);

  /// Several files, made durable together, then one manifest with all of them.
  void add(const std::vector<NewFile>& files);
  void addFrame(const Frame& frame) { add(filesOf(frame, sourceOf(frame.gas))); }
  /// Copies of a file as inputs/HASH.EXT; returns that relative name.
  std::string addInput(const std::filesystem::path& source);

  /// Last frame N such that frames 1..N are whole in the manifest.
  int lastFrame() const;

 private:
  void takeLock();
  void writeManifest();
  void replaceOldRun();
  void continueOldRun();
  std::filesystem::path placeOf(const std::string& name) const;
  std::filesystem::path path_;
  std::unique_ptr<DirectoryLock> lock_;
  bool shared_ = false, turn_ = false;  ///< with others; it is ours now
  std::map<std::string, ManifestEntry> manifest_;
};

/// frameFile("gas", "gas", 7, "vdb") is "gas/gas.0007.vdb".
std::string frameFile(const std::string& folder, const std::string& stem, int index, const std::string& extension);

/// Reads only; no lock.
std::map<std::string, ManifestEntry> readManifest(const std::filesystem::path& run);

/// Reads the frames of a run, by one look at its manifest; no lock. A file's hash is checked against the manifest
/// before a parser sees it.
class RunReader {
 public:
  /// Throws InputError where there is no run.
  explicit RunReader(const std::filesystem::path& run);
  ~RunReader();
  RunReader(const RunReader&) = delete;
  RunReader& operator=(const RunReader&) = delete;

  /// The frames 1..N that are there whole: N.
  int lastFrame() const;
  /// Throws InputError for a frame that is not there, naming those that are.
  void requireFrame(int index) const;
  /// Fills index, time and bodies, these with meshes and materials from pieces.glb and
  /// bodies/shapes.*.glb. May be called from several threads.
  void readBodies(int index, Frame& frame) const;
  /// The bytes of a file. Throws DamagedFile.
  std::string bytes(const std::string& name) const;

 private:
  struct Shapes;
  struct ShapeFiles;
  std::shared_ptr<const Shapes> shapesOf(int frame) const;
  std::filesystem::path run_;
  std::map<std::string, ManifestEntry> manifest_;
  std::unique_ptr<ShapeFiles> shapeFiles_;
};

/// A frame as it was written, its files' hashes checked against the manifest before a parser sees them. The gas is read
/// only on request. Bodies' meshes come from pieces.glb.
Frame readFrame(const std::filesystem::path& run, int index, bool withGas);

/// What is wrong with a run: one line per file that is missing, or has another size or hash. Empty: all is well.
std::vector<std::string> verifyRun(const std::filesystem::path& run);

}  // namespace brisance
