// What files need of the system, with its refusals as errors of one line.
#pragma once

#include <fcntl.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <string_view>

namespace brisance {

constexpr std::string_view temporaryPrefix = ".tmp.";

/// Throws Error, noRoom where the user can make room or choose another place: "path: what: the system's reason;
/// advice".
[[noreturn]] void throwSystemError(const std::filesystem::path& path, const std::string& what, int reason);

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
  Descriptor(const std::filesystem::path& path, int flags);
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  bool ok() const { return number_ >= 0; }

 private:
  int number_;
};

/// Throws where what was written to the file may not have reached the disk.
void syncFile(const Descriptor& file, const std::filesystem::path& path);

/// The name under which a file is written; removes the file unless it was given its final name.
class TemporaryName {
 public:
  explicit TemporaryName(const std::filesystem::path& path);
  ~TemporaryName();
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;
  const std::filesystem::path& name() const { return name_; }
  const std::filesystem::path& finalName() const { return final_; }
  void becomeFinal();

 private:
  std::filesystem::path final_, name_;
};

/// Makes the names in a file's directory durable.
void syncDirectoryOf(const std::filesystem::path& path);

}  // namespace brisance
