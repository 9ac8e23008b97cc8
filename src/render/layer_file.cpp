#include "render/layer_file.h"

#include "base/durable_file.h"
#include "render/cryptomatte.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

constexpr const char* cryptomatteLayer = "CryptoObject";

/// Names and values of a file; values that no picture holds in this form live in `planes`.
struct FileContent {
  std::vector<ExrChannel> channels;
  std::vector<std::vector<float>> planes;
  std::map<std::string, std::string> texts;

  void add(const std::string& layer, const std::string& letters, const Image& image, bool whole = false) {
    for (std::size_t c = 0; c < letters.size(); ++c)
      channels.push_back({layer + letters[c], &image.pixels.front().x + c, 3, whole});
  }
  void add(const std::string& name, const std::vector<float>& values, bool whole = false) {
    channels.push_back({name, values.data(), 1, whole});
  }
  void addPlane(const std::string& name, std::vector<float> values, bool whole = true) {
    planes.push_back(std::move(values));
    channels.push_back({name, planes.back().data(), 1, whole});
  }
};

/// Pairs of id and coverage, largest coverage first: R and G, B and A of each layer.
void addBodies(const PictureLayers& layers, FileContent& content) {
  std::vector<float> ids;
  for (const std::string& name : layers.bodyNames) ids.push_back(cryptomatteId(name));
  for (int rank = 0; rank < rankedBodies; ++rank) {
    std::vector<float> id(layers.bodies.size()), share(layers.bodies.size());
    for (std::size_t p = 0; p < layers.bodies.size(); ++p) {
      const BodyShare& body = layers.bodies[p][rank];
      if (!(body.share > 0)) continue;
      id[p] = ids[body.body];
      share[p] = body.share;
    }
    const std::string layer = fmt::format("{}{:02}.", cryptomatteLayer, rank / 2);
    content.addPlane(layer + (rank % 2 ? "B" : "R"), std::move(id));
    content.addPlane(layer + (rank % 2 ? "A" : "G"), std::move(share));
  }
  content.texts = cryptomatteHeader(cryptomatteLayer, layers.bodyNames);
}

FileContent contentOf(const DrawnPicture& picture) {
  FileContent content;
  content.add("", "RGB", picture.light);
  const PictureLayers& layers = picture.layers;
  if (layers.isEmpty()) return content;
  content.add("A", layers.alpha);
  content.add("albedo.", "RGB", layers.albedo);
  content.add("depth.Z", layers.depth, true);
  content.channels.push_back({"motion.X", &layers.motion.front().x, 2});
  content.channels.push_back({"motion.Y", &layers.motion.front().y, 2});
  content.addPlane("motion.Z", std::vector<float>(layers.motion.size()), false);  // Blender reads no layers of two
  content.add("N.", "XYZ", layers.normal);
  content.add("variance.", "RGB", picture.variance, true);
  content.add("volume.", "RGB", layers.volume);
  content.add("volume.A", layers.volumeAlpha);
  addBodies(layers, content);
  return content;
}

}  // namespace

std::string encodeLayers(const DrawnPicture& picture) {
  const FileContent content = contentOf(picture);
  return encodeExr(picture.light.width, picture.light.height, content.channels, content.texts);
}

std::string contentHash(const DrawnPicture& picture) {
  const PictureLayers& layers = picture.layers;
  if (layers.isEmpty()) return contentHash(picture.light);
  ContentHash hash;
  for (const Image* image : {&picture.light, &picture.variance, &layers.albedo, &layers.normal, &layers.volume})
    hash.addValues(std::span<const Vec3f>(image->pixels));
  for (const std::vector<float>* plane : {&layers.alpha, &layers.depth, &layers.volumeAlpha})
    hash.addValues(std::span<const float>(*plane));
  hash.addValues(std::span<const Vec2<float>>(layers.motion));
  hash.addValues(std::span<const RankedBodies>(layers.bodies));
  for (const std::string& name : layers.bodyNames) hash.addValues(std::span<const char>(name));
  return hash.hex();
}

}  // namespace brisance
