#include "base/durable_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <streambuf>
#include <system_error>
#include <vector>

#include "base/check.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t bufferBytes = 1 << 18;  // large enough that the cost of a system call vanishes
constexpr std::string_view temporaryPrefix = ".tmp.";

std::string adviceFor(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or choose another place";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that may be written";
    case ENOENT:
    case ENOTDIR:
    case EEXIST:
      return "its directory must exist and be a directory";
    default:
      return "";
  }
}

[[noreturn]] void throwSystemError(const fs::path& path, const std::string& what, int reason) {
  const std::string advice = adviceFor(reason);
  throw Error(
      advice.empty() ? ExitCode::failed : ExitCode::noRoom,
      fmt::format("{}: {}: {}{}{}", path.string(), what, std::strerror(reason), advice.empty() ? "" : "; ", advice));
}

/// Repeats a system call that a signal broke off.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      : number_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); })) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool ok() const { return number_ >= 0; }

 private:
  int number_;
};

/// Counts and hashes what it writes, and remembers why the system refused.
class CheckedBuffer : public std::streambuf {
 public:
  explicit CheckedBuffer(int descriptor) : descriptor_(descriptor), buffer_(bufferBytes) { restart(); }
  int reason() const { return reason_; }
  FileRecord record() const { return {size_, hash_.hex()}; }
  bool flush() { return sync() == 0; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  int sync() override {
    const std::size_t count = static_cast<std::size_t>(pptr() - pbase());
    if (reason_ == 0 && count > 0) writeAll(pbase(), count);
    restart();
    return reason_ == 0 ? 0 : -1;
  }

  /// Only where writing stands now, for libraries that ask.
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const bool asked = offset == 0 && from == std::ios_base::cur;
    return asked ? pos_type(static_cast<off_type>(size_) + (pptr() - pbase())) : pos_type(off_type(-1));
  }

 private:
  void restart() { setp(buffer_.data(), buffer_.data() + buffer_.size()); }

  void writeAll(const char* bytes, std::size_t count) {
    hash_.add(bytes, count);
    size_ += count;
    while (count > 0 && reason_ == 0) {
      const ssize_t written = uninterrupted([&] { return ::write(descriptor_, bytes, count); });
      if (written < 0) {
        reason_ = errno;
      } else {
        bytes += written;
        count -= static_cast<std::size_t>(written);
      }
    }
  }

  int descriptor_;
  std::vector<char> buffer_;
  ContentHash hash_;
  std::uint64_t size_ = 0;
  int reason_ = 0;
};

/// The name keeps its extension, since some libraries choose the format by it.
fs::path temporaryName(const fs::path& path) {
  return path.parent_path() / fmt::format("{}{}.{}", temporaryPrefix, ::getpid(), path.filename().string());
}

/// Removes the temporary file unless it was given its final name.
class Temporary {
 public:
  explicit Temporary(const fs::path& path) : final_(path), name_(temporaryName(path)) {}
  ~Temporary() {
    if (!name_.empty()) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  const fs::path& name() const { return name_; }

  void becomeFinal() {
    if (::rename(name_.c_str(), final_.c_str()) != 0) throwSystemError(final_, "cannot be named", errno);
    name_.clear();
    syncDirectory();
  }

 private:
  void syncDirectory() const {
    const fs::path parent = final_.parent_path();
    const Descriptor directory(parent.empty() ? "." : parent, O_RDONLY | O_DIRECTORY);
    // Some file systems have nothing to sync in a directory and say EINVAL.
    if (!directory.ok() || (::fsync(directory.number()) != 0 && errno != EINVAL))
      throwSystemError(final_, "its directory cannot be synced", errno);
  }

  fs::path final_, name_;
};

void syncFile(const Descriptor& file, const fs::path& path) {
  if (uninterrupted([&] { return ::fsync(file.number()); }) != 0) throwSystemError(path, "cannot be written", errno);
}

/// Runs the writer; a refusal by the system comes first, whatever else the writer made of it.
void fill(CheckedBuffer& buffer, const fs::path& path, const std::function<void(std::ostream&)>& write) {
  std::ostream stream(&buffer);
  stream.exceptions(std::ios_base::badbit);
  try {
    write(stream);
    buffer.flush();
  } catch (...) {
    if (buffer.reason() == 0) throw;
  }
  if (buffer.reason() != 0) throwSystemError(path, "cannot be written", buffer.reason());
  CHECK(!stream.fail(), "writing {} failed without a reason", path.string());
}

}  // namespace

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
  Temporary temporary(path);
  const Descriptor file(temporary.name(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.ok()) throwSystemError(path, "cannot be written", errno);
  CheckedBuffer buffer(file.number());
  fill(buffer, path, write);
  syncFile(file, path);
  temporary.becomeFinal();
  return buffer.record();
}

FileRecord writeDurably(const fs::path& path, std::string_view bytes) {
  return writeDurably(path,
                      [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

FileRecord writeDurablyByName(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  Temporary temporary(path);
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
  const FileRecord record = recordOf(temporary.name());
  temporary.becomeFinal();
  return record;
}

namespace {
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

DirectoryLock::DirectoryLock(const fs::path& directory)
    : descriptor_(::open((directory / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throwSystemError(directory, "cannot be locked", errno);
  if (uninterrupted([&] { return ::flock(descriptor_, LOCK_EX | LOCK_NB); }) == 0) return;
  const int reason = errno;
  ::close(descriptor_);
  if (reason != EWOULDBLOCK) throwSystemError(directory, "cannot be locked", reason);
  throw Error(
      ExitCode::failed,
      fmt::format("{}: another process is working in this run; wait until it ends, or stop it", directory.string()));
}

DirectoryLock::~DirectoryLock() { ::close(descriptor_); }

}  // namespace brisance
