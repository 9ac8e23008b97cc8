#include "render/camera_rays.h"

#include <cmath>

#include "render/sampling.h"

namespace brisance {
namespace {

int subPixelsAcross(const RenderSettings& settings) { return static_cast<int>(std::ceil(settings.samples)); }

/// The camera at the start, and at as many further times of the open shutter as a pixel has samples.
std::vector<Camera> camerasOf(const RenderSettings& settings, const PictureTime& time) {
  const double open = settings.camera.shutter * time.frameDuration;
  const int across = subPixelsAcross(settings), count = open > 0 ? across * across : 1;
  std::vector<Camera> cameras;
  for (int c = 0; c < count; ++c) {
    const double when = time.filmTime + open * ((c + 0.5) / count - 0.5);
    cameras.emplace_back(cameraAt(settings.camera, when), settings.width, settings.height);
  }
  return cameras;
}

}  // namespace

CameraRays::CameraRays(const RenderSettings& settings, const PictureTime& time, int frame)
    : samples_(subPixelsAcross(settings)),
      weights_(subPixelWeights(samples_)),
      cameras_(camerasOf(settings, time)),
      jitter_(settings.seed, Stream::pixelJitter),
      allotment_(jitter_.bits(frame), Stream::pixelJitter),
      firstPixel_(static_cast<std::uint64_t>(frame) * settings.width * settings.height),
      width_(settings.width) {}

CameraRay CameraRays::ray(int x, int y, int s) const {
  const std::uint64_t pixel = numberOf(x, y);
  constexpr int drawsPerSample = 4;
  const std::uint64_t draw = drawsPerSample * (pixel * samples_ * samples_ + s);
  // A random number over the sub-pixel is its centre plus a centred offset.
  const double across = x + (s % samples_ + jitter_.uniform(draw)) / samples_;
  const double down = y + (s / samples_ + jitter_.uniform(draw + 1)) / samples_;
  // The ways of a pixel through the gas share out a step evenly, from a random start.
  const double phase = (s + jitter_.uniform(drawsPerSample * pixel * samples_ * samples_ + 2)) / (samples_ * samples_);
  return through({across, down}, pixel, s, static_cast<float>(phase), numbersOf(pixel, s));
}

CameraRay CameraRays::freeRay(int x, int y, int s) const {
  const std::uint64_t pixel = numberOf(x, y);
  SampleSequence numbers = numbersOf(pixel, s);
  const Vec2<float> place = numbers.pair();
  return through({x + static_cast<double>(place.x), y + static_cast<double>(place.y)}, pixel, s, numbers.number(),
                 numbers);
}

SampleSequence CameraRays::numbersOf(std::uint64_t pixel, int s) const {
  constexpr std::uint64_t pathDraws = std::uint64_t{1} << 62;  // beyond all draws of ray()
  return {jitter_.bits(pathDraws + pixel), static_cast<std::uint32_t>(s)};
}

/// Each sample takes another time of the open shutter, in an order that differs from pixel to pixel.
CameraRay CameraRays::through(const Vec2<double>& place, std::uint64_t pixel, int s, float phase,
                              SampleSequence numbers) const {
  const std::size_t when = (jitter_.below(cameras_.size(), pixel) + s) % cameras_.size();
  const float time = (static_cast<float>(when) + 0.5f) / static_cast<float>(cameras_.size());
  const CameraWay way = cameras_[when].way(place.x, place.y, numbers.pair());
  return {{Vec3f(way.origin), Vec3f(way.direction), 0, time}, phase, numbers};
}

}  // namespace brisance
