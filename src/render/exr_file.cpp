#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cstring>

#include "render/decoders.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

constexpr float largestHalf = 65504;
constexpr const char* channelNames[] = {"R", "G", "B"};

/// Writes into a string, so that the bytes can be placed durably by others.
class StringSink : public Imf::OStream {
 public:
  StringSink() : OStream("memory") {}
  void write(const char* from, int count) override {
    const auto end = place_ + static_cast<std::size_t>(count);
    if (bytes.size() < end) bytes.resize(end);
    std::memcpy(bytes.data() + place_, from, static_cast<std::size_t>(count));
    place_ = end;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }
  std::string bytes;

 private:
  std::size_t place_ = 0;
};

class StringSource : public Imf::IStream {
 public:
  StringSource(const std::string& bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char* to, int count) override {
    const auto wanted = static_cast<std::size_t>(count);
    if (place_ + wanted > bytes_.size()) throw std::runtime_error("the file is cut short");
    std::memcpy(to, bytes_.data() + place_, wanted);
    place_ += wanted;
    return place_ < bytes_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t place) override { place_ = std::min<std::uint64_t>(place, bytes_.size()); }

 private:
  const std::string& bytes_;
  std::size_t place_ = 0;
};

/// Describes `pixels`, packed red green blue in rows of the window, to the library.
template <class T>
Imf::FrameBuffer frameBuffer(T* pixels, Imf::PixelType type, const Imath::Box2i& window) {
  Imf::FrameBuffer buffer;
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  for (int channel = 0; channel < 3; ++channel)
    buffer.insert(channelNames[channel],
                  Imf::Slice::Make(type, pixels + channel, window, 3 * sizeof(T), 3 * sizeof(T) * width));
  return buffer;
}

std::vector<half> halves(const Image& image) {
  std::vector<half> values;
  values.reserve(3 * image.pixels.size());
  for (const Vec3f& pixel : image.pixels)
    for (int channel = 0; channel < 3; ++channel)
      values.push_back(half(std::clamp(pixel[channel], -largestHalf, largestHalf)));
  return values;
}

Image readChannels(Imf::InputFile& file, const std::string& fileName) {
  const Imath::Box2i window = file.header().dataWindow();
  for (const char* name : channelNames)
    if (!file.header().channels().findChannel(name)) throw std::runtime_error(fmt::format("no channel {}", name));
  const auto extent = [](int first, int last) { return static_cast<std::uint64_t>(std::int64_t{last} - first + 1); };
  const Picture claimed =
      emptyPicture(extent(window.min.x, window.max.x), extent(window.min.y, window.max.y), fileName);
  Image image(claimed.width, claimed.height);
  file.setFrameBuffer(frameBuffer(&image.pixels.front().x, Imf::FLOAT, window));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

std::string encodeExr(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* name : channelNames) header.channels().insert(name, Imf::Channel(Imf::HALF));
  std::vector<half> values = halves(image);
  StringSink sink;
  {
    constexpr int threads = 0;  // work in this thread: the library's own pool would ignore the user's limit
    Imf::OutputFile file(sink, header, threads);
    file.setFrameBuffer(frameBuffer(values.data(), Imf::HALF, header.dataWindow()));
    file.writePixels(image.height);
  }
  return std::move(sink.bytes);
}

Image decodeExr(const std::string& bytes, const std::string& fileName) {
  try {
    StringSource source(bytes, fileName);
    Imf::InputFile file(source, 0);
    return readChannels(file, fileName);
  } catch (const DamagedFile&) {
    throw;
  } catch (const std::exception& error) {
    throw DamagedFile(fmt::format("{}: not a whole OpenEXR picture with R, G and B: {}", fileName, error.what()));
  }
}

}  // namespace brisance
