// The layers of an OpenEXR file as its own library reads them.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <map>
#include <string>
#include <vector>

namespace brisance {

struct ReadLayers {
  int width = 0, height = 0;
  std::map<std::string, std::vector<float>> channels;  ///< rows from the top
  std::map<std::string, std::string> texts;            ///< of the header
  float at(const std::string& channel, int x, int y) const { return channels.at(channel)[y * width + x]; }
};

inline ReadLayers readLayers(const std::string& name) {
  Imf::InputFile file(name.c_str());
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  ReadLayers read{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, {}, {}};
  Imf::FrameBuffer buffer;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    auto& values = read.channels[c.name()];
    values.resize(static_cast<std::size_t>(read.width) * read.height);
    buffer.insert(c.name(), Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  }
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      read.texts[a.name()] = text->value();
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  return read;
}

}  // namespace brisance
