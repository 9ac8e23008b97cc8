#include "render/render_frame.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"
#include "render/camera.h"
#include "render/path_tracer.h"
#include "render/sampling.h"
#include "render/whitted.h"

namespace brisance {
namespace {

constexpr int tileSize = 16;  // [pixels]: small enough that two threads end together

enum ParticleKind : std::uint8_t { unburntFuel = 0, burningFuel = 1, soot = 2 };

/// The mass that the picture counts: fuel that does not burn is not seen.
float drawnMass(const FrameParticles& particles, std::size_t p, float fuelWeight) {
  switch (particles.kind[p]) {
    case burningFuel:
      return particles.mass[p] * fuelWeight;
    case soot:
      return particles.mass[p];
    default:
      return 0;
  }
}

std::unique_ptr<GasMedium> gasOf(const Frame& frame, const RenderSettings& settings, const BlackbodyColours& heat,
                                 RenderScratch& scratch) {
  const VolumeSettings& volume = settings.volume;
  const FrameParticles& particles = frame.particles;
  const auto weigh = [&](std::size_t p) { return drawnMass(particles, p, static_cast<float>(volume.fuelWeight)); };
  const auto seen = [&] {
    for (std::size_t p = 0; p < particles.kind.size(); ++p)
      if (weigh(p) > 0) return true;
    return false;
  };
  if (!volume.drawn || !seen()) return nullptr;
  const ParticleVolumeSettings grid{volume.cells, volume.corner, volume.cellSize, volume.blur, volume.filterSize};
  splatParticles(particles, grid, weigh, heat, scratch.volume, scratch.splat);
  return std::make_unique<GasMedium>(scratch.volume, volume, std::move(scratch.samples));
}

/// The camera at the start, and at as many further times of the open shutter as a pixel has samples.
std::vector<Camera> camerasOf(const RenderSettings& settings, const PictureTime& time) {
  const double open = settings.camera.shutter * time.frameDuration;
  const int count = open > 0 ? settings.samples * settings.samples : 1;
  std::vector<Camera> cameras;
  for (int c = 0; c < count; ++c) {
    const double when = time.filmTime + open * ((c + 0.5) / count - 0.5);
    cameras.emplace_back(cameraAt(settings.camera, when), settings.width, settings.height);
  }
  return cameras;
}

/// An integrator: light along a ray.
using Follow = std::function<Vec3f(const Ray&, float phase, SampleSequence&)>;

/// Draws pixels.
class Exposure {
 public:
  Exposure(const RenderSettings& settings, const Follow& follow, const PictureTime& time, int frame)
      : follow_(follow),
        samples_(settings.samples),
        weights_(subPixelWeights(settings.samples)),
        cameras_(camerasOf(settings, time)),
        jitter_(settings.seed, Stream::pixelJitter),
        firstPixel_(static_cast<std::uint64_t>(frame) * settings.width * settings.height),
        width_(settings.width) {}

  /// The weighted mean of jittered samples, one in each of n x n sub-pixels (appendix A.1.3).
  Vec3f pixel(int x, int y) const {
    const std::uint64_t number = firstPixel_ + static_cast<std::uint64_t>(y) * width_ + x;
    Vec3f sum;
    for (int s = 0; s < samples_ * samples_; ++s) sum += sample(x, y, number, s) * weights_[s];
    return sum;
  }

 private:
  Vec3f sample(int x, int y, std::uint64_t pixelNumber, int s) const {
    constexpr int drawsPerSample = 4;
    const std::uint64_t draw = drawsPerSample * (pixelNumber * samples_ * samples_ + s);
    // A random number over the sub-pixel is its centre plus a centred offset.
    const double across = x + (s % samples_ + jitter_.uniform(draw)) / samples_;
    const double down = y + (s / samples_ + jitter_.uniform(draw + 1)) / samples_;
    // Each sample takes another time of the open shutter, in an order that differs from pixel to pixel.
    const std::size_t when = (jitter_.below(cameras_.size(), pixelNumber) + s) % cameras_.size();
    const float time = (static_cast<float>(when) + 0.5f) / static_cast<float>(cameras_.size());
    // The ways of a pixel through the gas share out a step evenly, from a random start.
    const double phase =
        (s + jitter_.uniform(drawsPerSample * pixelNumber * samples_ * samples_ + 2)) / (samples_ * samples_);
    constexpr std::uint64_t pathDraws = std::uint64_t{1} << 62;  // beyond all draws above
    SampleSequence numbers(jitter_.bits(pathDraws + pixelNumber), static_cast<std::uint32_t>(s));
    const CameraWay way = cameras_[when].way(across, down, numbers.pair());
    return follow_({Vec3f(way.origin), Vec3f(way.direction), 0, time}, static_cast<float>(phase), numbers);
  }

  const Follow& follow_;
  int samples_;
  std::vector<float> weights_;
  std::vector<Camera> cameras_;
  Random jitter_;
  std::uint64_t firstPixel_;
  int width_;
};

Image exposed(const Exposure& exposure, int width, int height) {
  Image image(width, height);
  const int columns = (width + tileSize - 1) / tileSize, rows = (height + tileSize - 1) / tileSize;
  parallelFor(0, static_cast<std::int64_t>(columns) * rows, 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t tile = first; tile < last; ++tile) {
      const int left = static_cast<int>(tile % columns) * tileSize, top = static_cast<int>(tile / columns) * tileSize;
      for (int y = top; y < std::min(top + tileSize, height); ++y)
        for (int x = left; x < std::min(left + tileSize, width); ++x) image(x, y) = exposure.pixel(x, y);
    }
  });
  return image;
}

}  // namespace

RenderAssets::RenderAssets(const RenderSettings& settings)
    : heat(settings.volume.blackbody), environment(environmentOf(settings)) {
  for (const auto& [name, material] : settings.materials)
    if (const auto* image = std::get_if<ImageTexture>(&material.diffuse)) textures.load(image->file, name);
}

namespace {

/// What is drawn: a frame with its settings, ready for rays.
struct Subject {
  const Frame& frame;
  const RenderSettings& settings;
  const Environment& environment;
  const MaterialTable& materials;
  const SceneGeometry& geometry;
  GasMedium* gas;  ///< or none
  PictureTime time;
  double openTime;  ///< [s] simulated
};

Image exposed(const Subject& subject, const Follow& follow) {
  const RenderSettings& settings = subject.settings;
  return exposed(Exposure(settings, follow, subject.time, subject.frame.index), settings.width, settings.height);
}

Image drawn(const Subject& subject, const WhittedIntegrator&) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, subject.gas);
  if (subject.gas) subject.gas->illuminate(settings.ambientLight, lights);
  const RayWorld world{subject.geometry,    subject.materials,     lights,           subject.gas,
                       subject.environment, settings.ambientLight, settings.maxDepth};
  return exposed(subject, [&](const Ray& ray, float phase, SampleSequence&) { return radiance(world, ray, phase); });
}

/// Fire is no light of the list here: its gas itself is drawn from.
Image drawn(const Subject& subject, const PathIntegrator& integrator) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, nullptr);
  const AreaLights shining(subject.frame.bodies, subject.materials, subject.openTime);
  std::optional<FireSampler> fire;
  if (subject.gas) fire.emplace(*subject.gas);
  constexpr Vec3f white(1, 1, 1);
  const PathWorld world{subject.geometry,
                        subject.materials,
                        lights,
                        shining,
                        subject.environment,
                        subject.gas,
                        fire ? &*fire : nullptr,
                        min(settings.volume.smokeColour, white),
                        static_cast<float>(settings.volume.anisotropy),
                        integrator,
                        settings.maxDepth};
  return exposed(subject, [&](const Ray& ray, float phase, SampleSequence& numbers) {
    return pathRadiance(world, ray, phase, numbers);
  });
}

}  // namespace

Image renderFrame(const Frame& frame, const RenderSettings& settings, const RenderAssets& assets,
                  const PictureTime& time, RenderScratch& scratch) {
  const MaterialTable materials(settings, assets.textures);
  const double openTime = settings.camera.shutter * time.frameDuration * time.simulatedPerFilm;
  const SceneGeometry geometry(frame.bodies, materials, openTime);
  const std::unique_ptr<GasMedium> gas = gasOf(frame, settings, assets.heat, scratch);
  const Subject subject{frame, settings, assets.environment, materials, geometry, gas.get(), time, openTime};
  Image image = std::visit([&](const auto& integrator) { return drawn(subject, integrator); }, settings.integrator);
  if (gas) scratch.samples = GasMedium::memoryOf(std::move(*gas));
  return image;
}

Image renderFrame(const Frame& frame, const RenderSettings& settings) {
  PictureTime time;
  time.filmTime = frame.time;
  RenderScratch scratch;
  return renderFrame(frame, settings, RenderAssets(settings), time, scratch);
}

}  // namespace brisance
