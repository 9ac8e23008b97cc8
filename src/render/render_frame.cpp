#include "render/render_frame.h"

#include <optional>

#include "render/exposure.h"
#include "render/path_tracer.h"
#include "render/whitted.h"

namespace brisance {
namespace {

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
  return std::make_unique<GasMedium>(scratch.volume, volume, std::move(scratch.bricks));
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
  return expose(CameraRays(settings, subject.time, subject.frame.index), settings.width, settings.height, follow);
}

Image drawn(const Subject& subject, const WhittedIntegrator&) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, subject.gas);
  if (subject.gas) subject.gas->illuminate(settings.ambientLight, lights);
  const RayWorld world{subject.geometry,    subject.materials,     lights,           subject.gas,
                       subject.environment, settings.ambientLight, settings.maxDepth};
  return exposed(subject, [&](std::span<CameraRay> rays, std::span<Vec3f> light) { radiance(world, rays, light); });
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
  return exposed(subject, [&](std::span<CameraRay> rays, std::span<Vec3f> light) { pathRadiance(world, rays, light); });
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
  if (gas) scratch.bricks = GasMedium::memoryOf(std::move(*gas));
  return image;
}

Image renderFrame(const Frame& frame, const RenderSettings& settings) {
  PictureTime time;
  time.filmTime = frame.time;
  RenderScratch scratch;
  return renderFrame(frame, settings, RenderAssets(settings), time, scratch);
}

}  // namespace brisance
