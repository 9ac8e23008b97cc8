#include "render/render_frame.h"

#include <optional>

#include "render/denoise.h"
#include "render/drawn_bits.h"
#include "render/drawn_volume.h"
#include "render/exposure.h"
#include "render/flow_arrows.h"
#include "render/path_tracer.h"
#include "render/piece_paint.h"
#include "render/whitted.h"

namespace brisance {
namespace {

/// The gas' own cells are not blurred: steps are as long as they.
std::unique_ptr<GasMedium> gasOf(const Frame& frame, const RenderSettings& settings, const BlackbodyColours& heat,
                                 RenderScratch& scratch) {
  VolumeSettings volume = settings.volume;
  if (!drawnVolume(frame, volume, heat, scratch.volume, scratch.splat)) return nullptr;
  if (volume.source == VolumeSource::gas) volume.blur = 0;
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
  const CameraRays& rays;
  Noise noise;
  const StopRequested& stopRequested;
};

Exposed exposed(const Subject& subject, const Follow& follow) {
  const RenderSettings& settings = subject.settings;
  const auto followUnlessStopped = [&](std::span<CameraRay> rays, std::span<Vec3f> light) {
    if (subject.stopRequested && subject.stopRequested()) throw Interrupted();
    follow(rays, light);
  };
  if (!samplesGoByNoise(settings))
    return expose(subject.rays, settings.width, settings.height, followUnlessStopped, subject.noise);
  return exposeByNoise(subject.rays, settings.width, settings.height, followUnlessStopped, subject.noise,
                       settings.samples * settings.samples);
}

Vec3f smokeAlbedo(const RenderSettings& settings) { return min(settings.volume.smokeColour, Vec3f(1, 1, 1)); }

Exposed drawn(const Subject& subject, const WhittedIntegrator&) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, subject.gas);
  if (subject.gas) subject.gas->illuminate(settings.ambientLight, lights);
  const RayWorld world{subject.geometry,    subject.materials,     lights,           subject.gas,
                       subject.environment, settings.ambientLight, settings.maxDepth};
  return exposed(subject, [&](std::span<CameraRay> rays, std::span<Vec3f> light) { radiance(world, rays, light); });
}

/// Fire is no light of the list here: ways are drawn towards it. Where noise is to be taken out, the samples are
/// those of the guides.
Exposed drawn(const Subject& subject, const PathIntegrator& integrator) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, nullptr);
  const AreaLights shining(subject.frame.bodies, subject.materials, subject.openTime);
  std::optional<FireDirections> fire;
  if (subject.gas) fire.emplace(*subject.gas);
  const PathWorld world{subject.geometry,
                        subject.materials,
                        lights,
                        shining,
                        subject.environment,
                        subject.gas,
                        fire ? &*fire : nullptr,
                        smokeAlbedo(settings),
                        static_cast<float>(settings.volume.anisotropy),
                        integrator,
                        settings.maxDepth};
  return exposed(subject, [&](std::span<CameraRay> rays, std::span<Vec3f> light) { pathRadiance(world, rays, light); });
}

void drawLayers(const Subject& subject, PictureLayers& layers, PictureGuides& guides) {
  const RenderSettings& settings = subject.settings;
  const std::vector<LightSource> lights = lightSources(settings.lights, nullptr);
  const auto* paths = std::get_if<PathIntegrator>(&settings.integrator);
  const SightWorld world{subject.geometry,
                         subject.materials,
                         lights,
                         subject.environment,
                         subject.gas,
                         smokeAlbedo(settings),
                         paths ? *paths : PathIntegrator{},
                         settings.maxDepth};
  drawLayers({world, subject.rays, settings, subject.time, subject.frame.bodies}, layers, guides);
}

}  // namespace

DrawnPicture drawPicture(const Frame& frame, const RenderSettings& settings, const RenderAssets& assets,
                         const PictureTime& time, RenderScratch& scratch, const StopRequested& stopRequested) {
  const MaterialTable materials(settings, assets.textures);
  const double openTime = settings.camera.shutter * time.frameDuration * time.simulatedPerFilm;
  const SceneGeometry geometry(frame.bodies, materials, openTime);
  const std::unique_ptr<GasMedium> gas = gasOf(frame, settings, assets.heat, scratch);
  const CameraRays rays(settings, time, frame.index);
  const bool wantsLayers = settings.writeExr && settings.layers, measures = wantsLayers || settings.denoise;
  const Subject subject{
      frame,        settings, assets.environment, materials, geometry,
      gas.get(),    time,     openTime,           rays,      measures ? Noise::measured : Noise::ignored,
      stopRequested};
  Exposed exposed = std::visit([&](const auto& integrator) { return drawn(subject, integrator); }, settings.integrator);
  DrawnPicture picture;
  if (measures) {
    PictureGuides guides;
    drawLayers(subject, picture.layers, guides);
    if (settings.denoise) exposed.mean = denoised(exposed, guides);
    if (!wantsLayers) picture.layers = {};
  }
  picture.light = std::move(exposed.mean);
  picture.variance = std::move(exposed.variance);
  if (gas) scratch.bricks = GasMedium::memoryOf(std::move(*gas));
  return picture;
}

DrawnPicture drawFilmFrame(Frame frame, const RenderSettings& settings, const RenderAssets& assets,
                           const PictureTime& time, RenderScratch& scratch, const StopRequested& stopRequested) {
  RenderSettings look = settings;
  if (settings.flow.drawn) addFlow(frame.gas, settings.flow, frame.bodies, look.materials);
  paintPieces(frame.bodies, look.materials, assets.heat);
  addBits(frame, settings.bits, assets.heat, frame.bodies, look.materials);
  return drawPicture(frame, look, assets, time, scratch, stopRequested);
}

Image renderFrame(const Frame& frame, const RenderSettings& settings) {
  PictureTime time;
  time.filmTime = frame.time;
  RenderScratch scratch;
  RenderSettings light = settings;
  light.layers = false;
  return drawPicture(frame, light, RenderAssets(settings), time, scratch).light;
}

}  // namespace brisance
