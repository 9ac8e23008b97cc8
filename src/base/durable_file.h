// Files that are whole or not there: written under a temporary name, synced, renamed, and their directory synced.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace brisance {

/// XXH3-128 of some bytes as 32 hexadecimal digits: the name of a content.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;
  void add(const void* bytes, std::size_t count);
  void add(std::string_view text) { add(text.data(), text.size()); }
  template <class T>
  void addValues(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    add(values.data(), values.size_bytes());
  }
  std::string hex() const;

 private:
  void* state_;
};

/// What was written: enough to find it damaged later.
struct FileRecord {
  std::uint64_t size = 0;
  std::string hash;  ///< ContentHash of the file's bytes
};

/// Writes `path` durably through a checked stream. Throws Error(noRoom) with one line when the disk is full or the
/// place not writable, and leaves neither the final name nor the temporary one behind.
FileRecord writeDurably(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);
FileRecord writeDurably(const std::filesystem::path& path, std::string_view bytes);

/// For libraries that insist on a file name of their own: `write` fills the temporary file; then synced and renamed.
FileRecord writeDurablyByName(const std::filesystem::path& path,
                              const std::function<void(const std::filesystem::path& temporary)>& write);

/// The whole file. Throws DamagedFile when it cannot be read.
std::string readFile(const std::filesystem::path& path);
FileRecord recordOf(const std::filesystem::path& path);

/// mkdir -p, as Error(noRoom) in one line where it may not.
void makeDirectories(const std::filesystem::path& path);

/// Removes what a killed process left under temporary names, in one directory.
void removeTemporaries(const std::filesystem::path& directory);

/// Who may write in a directory: one process alone, or several together (flock, released by the kernel however a
/// process ends; on file systems that pass it on, NFS among them, also between machines).
class DirectoryLock {
 public:
  enum class Kind { alone, together };
  /// Throws Error(failed) when another process holds a lock that does not go with this one.
  explicit DirectoryLock(const std::filesystem::path& directory, Kind kind = Kind::alone);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// No other process had a lock when this one was taken.
  bool foundAlone() const { return foundAlone_; }
  /// From then on others may come, where the kind is `together`.
  void letOthersIn();

 private:
  int descriptor_;
  Kind kind_;
  bool foundAlone_ = false;
};

/// One after the other: while it lives, no other process that takes its turn in the directory has it. Waits.
class DirectoryTurn {
 public:
  explicit DirectoryTurn(const std::filesystem::path& directory);
  ~DirectoryTurn();
  DirectoryTurn(const DirectoryTurn&) = delete;
  DirectoryTurn& operator=(const DirectoryTurn&) = delete;

 private:
  int descriptor_;
};

}  // namespace brisance
