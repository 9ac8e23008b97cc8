#include "base/durable_batch.h"

#include <unistd.h>

#include <cstring>
#include <set>
#include <streambuf>

#include "base/check.h"
#include "base/system_file.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t bufferBytes = 1 << 20;  // large enough that the cost of a system call vanishes
constexpr std::size_t startBytes = 1 << 22;   // what is worth telling the disk of

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

  /// What is larger than the buffer need not go through it.
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    if (count < static_cast<std::streamsize>(bufferBytes)) return std::streambuf::xsputn(bytes, count);
    if (sync() == 0) writeAll(bytes, static_cast<std::size_t>(count));
    return reason_ == 0 ? count : 0;
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
        startDisk(static_cast<std::size_t>(written));
        bytes += written;
        count -= static_cast<std::size_t>(written);
      }
    }
  }

  /// While more comes the disk may take what has come; nobody waits here, and no refusal is lost to the sync.
  void startDisk(std::size_t written) {
    waiting_ += written;
    if (waiting_ < startBytes) return;
    ::sync_file_range(descriptor_, 0, 0, SYNC_FILE_RANGE_WRITE);
    waiting_ = 0;
  }

  int descriptor_;
  std::vector<char> buffer_;
  ContentHash hash_;
  std::uint64_t size_ = 0;
  std::size_t waiting_ = 0;
  int reason_ = 0;
};

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

struct DurableBatch::Written {
  TemporaryName name;
  Descriptor file;
};

DurableBatch::DurableBatch() = default;
DurableBatch::~DurableBatch() = default;

FileRecord DurableBatch::add(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  TemporaryName name(path);
  Descriptor file(name.name(), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.ok()) throwSystemError(path, "cannot be written", errno);
  CheckedBuffer buffer(file.number());
  fill(buffer, path, write);
  ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE);  // the disk may begin; finish() waits for it
  files_.push_back({std::move(name), std::move(file)});
  return buffer.record();
}

void DurableBatch::finish() {
  for (const Written& written : files_) syncFile(written.file, written.name.finalName());
  std::set<fs::path> directories;
  for (Written& written : files_) written.name.becomeFinal();
  for (const Written& written : files_)
    if (directories.insert(written.name.finalName().parent_path()).second) syncDirectoryOf(written.name.finalName());
  files_.clear();
}

}  // namespace brisance
