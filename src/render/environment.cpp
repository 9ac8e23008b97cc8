#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/check.h"
#include "base/durable_file.h"
#include "render/picture_file.h"

namespace brisance {
namespace {

constexpr auto onePi = static_cast<float>(pi);
constexpr Vec3f luminanceWeights{0.2126f, 0.7152f, 0.0722f};

int wrapped(int i, int n) { return (i % n + n) % n; }

/// How bright the picture may be within a pixel, given that light is mixed between the middles of pixels.
float brightnessAround(const Image& picture, int x, int y) {
  Vec3f sum;
  for (int row = std::max(0, y - 1); row <= std::min(picture.height - 1, y + 1); ++row)
    for (int column = x - 1; column <= x + 1; ++column) sum += picture(wrapped(column, picture.width), row);
  return dot(luminanceWeights, sum);
}

float sineOfRow(float y, int rows) { return std::sin(onePi * y / static_cast<float>(rows)); }

/// The entry of a rising list in which `share` of its total falls; `share` becomes the share within the entry.
int drawn(std::span<const float> upTo, float& share) {
  const float wanted = share * upTo.back();
  const auto found = std::upper_bound(upTo.begin(), upTo.end(), wanted);
  const auto i = std::min<std::ptrdiff_t>(found - upTo.begin(), std::ssize(upTo) - 1);
  const float before = i == 0 ? 0 : upTo[i - 1];
  share = std::clamp((wanted - before) / (upTo[i] - before), 0.0f, 0x1.fffffep-1f);
  return static_cast<int>(i);
}

Image linearPicture(const Picture& picture) {
  Image image(picture.width, picture.height);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
    for (int channel = 0; channel < 3; ++channel)
      image.pixels[p][channel] = srgbDecoded(static_cast<float>(picture.rgb[3 * p + channel]) / 255);
  return image;
}

Image readEnvironment(const std::filesystem::path& file) {
  std::error_code trouble;
  if (!std::filesystem::is_regular_file(file, trouble))
    throw InputError(fmt::format("render.environment: picture {} does not exist", file.string()));
  const std::string bytes = readFile(file);
  return file.extension() == ".exr" ? decodeExr(bytes, file.string())
                                    : linearPicture(decodePicture(bytes, file.string()));
}

}  // namespace

Environment::Environment(const Image& picture, const EnvironmentSettings& settings)
    : picture_(picture), rotation_(static_cast<float>(settings.rotationDegrees / 360)) {
  for (Vec3f& pixel : picture_.pixels) pixel = max(pixel * static_cast<float>(settings.strength), Vec3f{});
  float total = 0;
  for (int y = 0; y < picture_.height; ++y) {
    float row = 0;
    for (int x = 0; x < picture_.width; ++x) {
      light_.push_back(brightnessAround(picture_, x, y) * sineOfRow(static_cast<float>(y) + 0.5f, picture_.height));
      columnsUpTo_.push_back(row += light_.back());
    }
    rowsUpTo_.push_back(total += row);
  }
}

Environment::Place Environment::placeOf(const Vec3f& d) const {
  const float turns = 0.5f + std::atan2(d.x, -d.z) / (2 * onePi) + rotation_;
  const float down = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / onePi;
  return {(turns - std::floor(turns)) * static_cast<float>(picture_.width), down * static_cast<float>(picture_.height)};
}

Vec3f Environment::between(const Place& place) const {
  const float x = place.x - 0.5f, y = std::clamp(place.y - 0.5f, 0.0f, static_cast<float>(picture_.height - 1));
  const auto column = static_cast<int>(std::floor(x)), row = static_cast<int>(y);
  const float across = x - static_cast<float>(column), down = y - static_cast<float>(row);
  const auto line = [&](int r) {
    return picture_(wrapped(column, picture_.width), r) * (1 - across) +
           picture_(wrapped(column + 1, picture_.width), r) * across;
  };
  return line(row) * (1 - down) + line(std::min(row + 1, picture_.height - 1)) * down;
}

Vec3f Environment::operator()(const Vec3f& direction) const {
  return isEven() ? everywhere_ : between(placeOf(direction));
}

std::optional<EnvironmentSample> Environment::sample(float x, float y) const {
  if (isEven() || !(rowsUpTo_.back() > 0)) return std::nullopt;
  const int row = drawn(rowsUpTo_, y);
  const std::size_t first = static_cast<std::size_t>(row) * picture_.width;
  const int column = drawn({columnsUpTo_.data() + first, static_cast<std::size_t>(picture_.width)}, x);
  const float polar = onePi * (static_cast<float>(row) + y) / static_cast<float>(picture_.height);
  const float around =
      2 * onePi * ((static_cast<float>(column) + x) / static_cast<float>(picture_.width) - 0.5f - rotation_);
  const Vec3f direction(std::sin(polar) * std::sin(around), std::cos(polar), -std::sin(polar) * std::cos(around));
  const float p = density(direction);
  if (!(p > 0)) return std::nullopt;
  return EnvironmentSample{direction, (*this)(direction), p};
}

float Environment::density(const Vec3f& direction) const {
  if (isEven() || !(rowsUpTo_.back() > 0)) return 0;
  const Place place = placeOf(direction);
  const int x = std::min(static_cast<int>(place.x), picture_.width - 1),
            y = std::min(static_cast<int>(place.y), picture_.height - 1);
  const float sine = std::sqrt(std::max(0.0f, 1 - direction.y * direction.y));
  if (!(sine > 0)) return 0;
  const auto pixels = static_cast<float>(picture_.pixels.size());
  return light_[static_cast<std::size_t>(y) * picture_.width + x] / rowsUpTo_.back() * pixels /
         (2 * onePi * onePi * sine);
}

Environment environmentOf(const RenderSettings& settings) {
  if (!settings.environment.file) return {settings.background};
  return {readEnvironment(*settings.environment.file), settings.environment};
}

}  // namespace brisance
