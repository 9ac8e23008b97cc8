#include "base/durable_folder.h"

#include <unistd.h>

#include <system_error>

#include "base/check.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

fs::path besides(const fs::path& path, const std::string& what) {
  return path.parent_path() / fmt::format(".tmp.{}.{}{}", ::getpid(), what, path.filename().string());
}

/// "out/" and "out" are one folder.
fs::path withoutSlash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

void giveName(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw Error(ExitCode::noRoom, fmt::format("{}: cannot be named: {}", to.string(), error.message()));
}

}  // namespace

DurableFolder::DurableFolder(const fs::path& path) : final_(withoutSlash(path)), temporary_(besides(final_, "")) {
  std::error_code error;
  fs::create_directory(temporary_, error);
  if (error)
    throw Error(ExitCode::noRoom, fmt::format("{}: cannot be made: {}; choose a place that may be written",
                                              final_.string(), error.message()));
}

DurableFolder::~DurableFolder() {
  std::error_code ignored;
  if (!finished_) fs::remove_all(temporary_, ignored);
}

FileRecord DurableFolder::add(const std::string& name, const std::function<void(std::ostream&)>& write) {
  try {
    return writeDurably(temporary_ / name, write);
  } catch (const Error& trouble) {
    std::string line = trouble.what();
    if (line.starts_with(temporary_.string())) line.replace(0, temporary_.string().size(), final_.string());
    throw Error(trouble.code, line);
  }
}

FileRecord DurableFolder::add(const std::string& name, std::string_view bytes) {
  return add(name, [&](std::ostream& out) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

void DurableFolder::finish() {
  const fs::path old = besides(final_, "old.");
  std::error_code error;
  const bool replaces = fs::exists(final_, error);
  if (replaces) giveName(final_, old);
  giveName(temporary_, final_);
  finished_ = true;
  if (replaces) fs::remove_all(old, error);
}

}  // namespace brisance
