#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

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
Imf::FrameBuffer frameBuffer(float* pixels, const Imath::Box2i& window) {
  Imf::FrameBuffer buffer;
  const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
  for (int channel = 0; channel < 3; ++channel)
    buffer.insert(channelNames[channel],
                  Imf::Slice::Make(Imf::FLOAT, pixels + channel, window, 3 * sizeof(float), 3 * sizeof(float) * width));
  return buffer;
}

/// A channel's values as the file holds them.
struct PlaneOfFile {
  std::vector<half> halves;
  std::vector<float> floats;
};

PlaneOfFile planeOf(const ExrChannel& channel, std::size_t pixels) {
  PlaneOfFile plane;
  channel.whole ? plane.floats.reserve(pixels) : plane.halves.reserve(pixels);
  for (std::size_t p = 0; p < pixels; ++p) {
    const float value = channel.values[p * channel.step];
    if (channel.whole)
      plane.floats.push_back(value);
    else
      plane.halves.push_back(half(std::clamp(value, -largestHalf, largestHalf)));
  }
  return plane;
}

Imf::Slice sliceOf(PlaneOfFile& plane, const Imath::Box2i& window) {
  return plane.floats.empty() ? Imf::Slice::Make(Imf::HALF, plane.halves.data(), window)
                              : Imf::Slice::Make(Imf::FLOAT, plane.floats.data(), window);
}

Image readChannels(Imf::InputFile& file, const std::string& fileName) {
  const Imath::Box2i window = file.header().dataWindow();
  for (const char* name : channelNames)
    if (!file.header().channels().findChannel(name)) throw std::runtime_error(fmt::format("no channel {}", name));
  const auto extent = [](int first, int last) { return static_cast<std::uint64_t>(std::int64_t{last} - first + 1); };
  const Picture claimed =
      emptyPicture(extent(window.min.x, window.max.x), extent(window.min.y, window.max.y), fileName);
  Image image(claimed.width, claimed.height);
  file.setFrameBuffer(frameBuffer(&image.pixels.front().x, window));
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

std::string encodeExr(const Image& image) {
  std::vector<ExrChannel> channels;
  channels.reserve(3);
  for (int c = 0; c < 3; ++c) channels.push_back({channelNames[c], &image.pixels.front().x + c, 3});
  return encodeExr(image.width, image.height, channels, {});
}

std::string encodeExr(int width, int height, const std::vector<ExrChannel>& channels,
                      const std::map<std::string, std::string>& texts) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [name, text] : texts) header.insert(name, Imf::StringAttribute(text));
  std::vector<PlaneOfFile> planes;
  for (const ExrChannel& channel : channels) {
    header.channels().insert(channel.name, Imf::Channel(channel.whole ? Imf::FLOAT : Imf::HALF));
    planes.push_back(planeOf(channel, static_cast<std::size_t>(width) * height));
  }
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    buffer.insert(channels[c].name, sliceOf(planes[c], header.dataWindow()));
  StringSink sink;
  {
    constexpr int threads = 0;  // work in this thread: the library's own pool would ignore the user's limit
    Imf::OutputFile file(sink, header, threads);
    file.setFrameBuffer(buffer);
    file.writePixels(height);
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
