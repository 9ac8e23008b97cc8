#include "base/system_file.h"

#include <unistd.h>

#include <cstring>

#include "base/check.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

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

/// The name keeps its extension, since some libraries choose the format by it.
fs::path temporaryName(const fs::path& path) {
  return path.parent_path() / fmt::format("{}{}.{}", temporaryPrefix, ::getpid(), path.filename().string());
}

}  // namespace

void throwSystemError(const fs::path& path, const std::string& what, int reason) {
  const std::string advice = adviceFor(reason);
  throw Error(
      advice.empty() ? ExitCode::failed : ExitCode::noRoom,
      fmt::format("{}: {}: {}{}{}", path.string(), what, std::strerror(reason), advice.empty() ? "" : "; ", advice));
}

Descriptor::Descriptor(const fs::path& path, int flags)
    : number_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, 0666); })) {}
Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

void syncFile(const Descriptor& file, const fs::path& path) {
  if (uninterrupted([&] { return ::fsync(file.number()); }) != 0) throwSystemError(path, "cannot be written", errno);
}

TemporaryName::TemporaryName(const fs::path& path) : final_(path), name_(temporaryName(path)) {}
TemporaryName::TemporaryName(TemporaryName&& other) noexcept
    : final_(std::move(other.final_)), name_(std::move(other.name_)) {
  other.name_.clear();
}
TemporaryName::~TemporaryName() {
  if (!name_.empty()) ::unlink(name_.c_str());
}

void TemporaryName::becomeFinal() {
  if (::rename(name_.c_str(), final_.c_str()) != 0) throwSystemError(final_, "cannot be named", errno);
  name_.clear();
}

void syncDirectoryOf(const fs::path& path) {
  const fs::path parent = path.parent_path();
  const Descriptor directory(parent.empty() ? "." : parent, O_RDONLY | O_DIRECTORY);
  // Some file systems have nothing to sync in a directory and say EINVAL.
  if (!directory.ok() || (::fsync(directory.number()) != 0 && errno != EINVAL))
    throwSystemError(path, "its directory cannot be synced", errno);
}

}  // namespace brisance
