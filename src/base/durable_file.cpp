#include "base/durable_file.h"

#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <xxhash.h>

#include <cstring>
#include <system_error>
#include <vector>

#include "base/check.h"
#include "base/durable_batch.h"
#include "base/system_file.h"

namespace brisance {

namespace fs = std::filesystem;

ContentHash::ContentHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(static_cast<XXH3_state_t*>(state_));
}
ContentHash::~ContentHash() { XXH3_freeState(static_cast<XXH3_state_t*>(state_)); }

void ContentHash::add(const void* bytes, std::size_t count) {
  if (count > 0) XXH3_128bits_update(static_cast<XXH3_state_t*>(state_), bytes, count);
}

std::string ContentHash::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(static_cast<const XXH3_state_t*>(state_));
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

FileRecord writeDurably(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  DurableBatch one;
  FileRecord record = one.add(path, write);
  one.finish();
  return record;
}

FileRecord writeDurably(const fs::path& path, std::string_view bytes) {
  return writeDurably(path,
                      [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

FileRecord writeDurablyByName(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  TemporaryName temporary(path);
  {
    // Refused here with a reason, rather than by a library without one.
    const Descriptor probe(temporary.name(), O_WRONLY | O_CREAT | O_TRUNC);
    if (!probe.ok()) throwSystemError(path, "cannot be written", errno);
  }
  write(temporary.name());
  const Descriptor file(temporary.name(), O_RDONLY);
  if (!file.ok()) throwSystemError(path, "was not written", errno);
  syncFile(file, path);
  // A library may take a full disk for success; then nothing at all is free, and the file's end is in doubt.
  struct statvfs disk {};
  if (::fstatvfs(file.number(), &disk) == 0 && disk.f_blocks > 0 && disk.f_bfree == 0)
    throwSystemError(path, "cannot be written", ENOSPC);
  FileRecord record = recordOf(temporary.name());
  temporary.becomeFinal();
  syncDirectoryOf(path);
  return record;
}

namespace {
constexpr std::size_t bufferBytes = 1 << 18;

/// Gives the file's bytes to `take`, a buffer at a time.
void readThrough(const fs::path& path, const std::function<void(const char*, std::size_t)>& take) {
  const Descriptor file(path, O_RDONLY);
  std::vector<char> buffer(bufferBytes);
  ssize_t count = file.ok() ? 1 : -1;
  while (count > 0) {
    count = uninterrupted([&] { return ::read(file.number(), buffer.data(), buffer.size()); });
    if (count > 0) take(buffer.data(), static_cast<std::size_t>(count));
  }
  if (count < 0) throw DamagedFile(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
}
}  // namespace

std::string readFile(const fs::path& path) {
  std::string bytes;
  readThrough(path, [&](const char* part, std::size_t count) { bytes.append(part, count); });
  return bytes;
}

FileRecord recordOf(const fs::path& path) {
  ContentHash hash;
  std::uint64_t size = 0;
  readThrough(path, [&](const char* part, std::size_t count) {
    hash.add(part, count);
    size += count;
  });
  return {size, hash.hex()};
}

void makeDirectories(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throwSystemError(path, "cannot be made", error.value());
  if (!fs::is_directory(path, error)) throwSystemError(path, "cannot be made", ENOTDIR);
}

void removeTemporaries(const fs::path& directory) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    std::error_code ignored;
    if (entry.path().filename().string().starts_with(temporaryPrefix)) fs::remove(entry.path(), ignored);
  }
}

namespace {

int openLockFile(const fs::path& directory, const char* name) {
  const int descriptor = ::open((directory / name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) throwSystemError(directory, "cannot be locked", errno);
  return descriptor;
}

bool locked(int descriptor, int operation) {
  return uninterrupted([&] { return ::flock(descriptor, operation); }) == 0;
}

}  // namespace

DirectoryLock::DirectoryLock(const fs::path& directory, Kind kind)
    : descriptor_(openLockFile(directory, ".lock")), kind_(kind) {
  foundAlone_ = locked(descriptor_, LOCK_EX | LOCK_NB);
  if (foundAlone_ || (kind == Kind::together && locked(descriptor_, LOCK_SH | LOCK_NB))) return;
  const int reason = errno;
  ::close(descriptor_);
  if (reason != EWOULDBLOCK) throwSystemError(directory, "cannot be locked", reason);
  throw Error(
      ExitCode::failed,
      fmt::format("{}: another process is working in this run; wait until it ends, or stop it", directory.string()));
}

DirectoryLock::~DirectoryLock() { ::close(descriptor_); }

void DirectoryLock::letOthersIn() {
  if (kind_ == Kind::together) locked(descriptor_, LOCK_SH);
}

DirectoryTurn::DirectoryTurn(const fs::path& directory) : descriptor_(openLockFile(directory, ".turn")) {
  if (locked(descriptor_, LOCK_EX)) return;
  const int reason = errno;
  ::close(descriptor_);
  throwSystemError(directory, "cannot be locked", reason);
}

DirectoryTurn::~DirectoryTurn() { ::close(descriptor_); }

}  // namespace brisance
