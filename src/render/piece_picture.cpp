#include "render/piece_picture.h"

#include "base/check.h"
#include "render/render_frame.h"

namespace brisance {
namespace {

constexpr char insideName[] = "inside";
constexpr double fovDegrees = 28;

std::string materialOf(std::size_t piece, bool inside) { return fmt::format("{}{}", inside ? "i" : "o", piece); }

/// Full-strength colour of a hue from 0 to 1.
Vec3f ofHue(double hue) {
  const auto channel = [&](double centre) {
    const double away = std::abs(hue - centre), distance = std::min(away, 1 - away);  // 0 .. 1/2 around the circle
    return static_cast<float>(std::clamp(2 - 6 * distance, 0.0, 1.0));
  };
  return {channel(0), channel(1.0 / 3), channel(2.0 / 3)};
}

Vec3f mixed(const Vec3f& a, const Vec3f& b, float share) { return a * (1 - share) + b * share; }

Material paint(const Vec3f& colour) {
  Material material;
  material.diffuse = SolidColour{colour};
  material.specular = {0.06f, 0.06f, 0.06f};
  material.specularExponent = 40;
  return material;
}

bool isInside(const TriangleMesh& mesh, std::size_t triangle) {
  return !mesh.materials.empty() && mesh.materialNames[mesh.materials[triangle]] == insideName;
}

/// The piece with the materials of its colours, moved away from the middle.
FrameBody painted(const FrameBody& body, std::size_t number, const Vec3d& shift) {
  auto mesh = std::make_shared<TriangleMesh>(*body.mesh);
  mesh->materialNames = {materialOf(number, false), materialOf(number, true)};
  mesh->materials.clear();
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) mesh->materials.push_back(isInside(*body.mesh, t) ? 1 : 0);
  FrameBody piece = body;
  piece.mesh = std::move(mesh);
  piece.material = materialOf(number, false);
  piece.pose.position += shift;
  return piece;
}

Box3 boundsOf(const FrameBody& body) {
  Box3 box;
  for (const Vec3d& v : body.mesh->vertices) box.include(body.pose * v);
  return box;
}
Vec3d middleOf(const Box3& box) { return (box.lower + box.upper) * 0.5; }

/// As far away that everything is in the picture, whichever of its sides is the tighter.
CameraKey cameraFor(const std::vector<FrameBody>& bodies, const Vec3d& middle, const PiecePictureSettings& settings) {
  CameraKey camera;
  camera.fovDegrees = fovDegrees;
  camera.lookAt = middle;
  const Vec3d back = normalized(settings.toViewer), right = normalized(cross(camera.up, back)), up = cross(back, right);
  const double half = std::tan(fovDegrees * pi / 360) / 1.06;  // a little air around
  const double aspect = static_cast<double>(settings.width) / settings.height;
  double distance = 0;
  for (const FrameBody& body : bodies)
    for (const Vec3d& v : body.mesh->vertices) {
      const Vec3d place = body.pose * v - middle;
      const double needed = std::max(std::abs(dot(place, up)), std::abs(dot(place, right)) / aspect) / half;
      distance = std::max(distance, needed + dot(place, back));
    }
  camera.position = middle + back * distance;
  return camera;
}

/// A key light from the upper left, a weaker one from the right, and light from all around.
std::vector<Light> lightsFor(const Vec3d& toViewer) {
  const Vec3d back = normalized(toViewer), right = normalized(cross(Vec3d(0, 1, 0), back)), up = cross(back, right);
  return {SunLight{-(back * 0.9 - right * 0.7 + up * 1.1), {0.75f, 0.74f, 0.72f}},
          SunLight{-(back * 0.6 + right * 1.0 + up * 0.1), {0.22f, 0.23f, 0.26f}}};
}

}  // namespace

Vec3f pieceColour(std::size_t piece) {
  constexpr double goldenRatio = 0.6180339887498949;
  const double turn = 0.58 + static_cast<double>(piece) * goldenRatio;
  const double lightness = 0.5 + 0.5 * std::fmod(static_cast<double>(piece) * 0.7548776662466927, 1.0);
  const Vec3f grey(0.35f, 0.35f, 0.35f);
  return mixed(grey, ofHue(turn - std::floor(turn)), 0.72f) * static_cast<float>(lightness);
}

Picture drawPieces(const std::vector<FrameBody>& pieces, const PiecePictureSettings& settings) {
  if (pieces.empty()) throw InputError("brisance: there is no piece to draw");
  Box3 whole;
  for (const FrameBody& piece : pieces)
    if (!piece.mesh->vertices.empty()) {
      const Box3 box = boundsOf(piece);
      whole.include(box.lower);
      whole.include(box.upper);
    }
  const Vec3d middle = middleOf(whole);
  Frame frame;
  RenderSettings render;
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    if (pieces[n].mesh->triangles.empty()) continue;
    const Vec3f colour = pieceColour(n);
    render.materials[materialOf(n, false)] = paint(colour);
    render.materials[materialOf(n, true)] = paint(mixed(colour, {0.8f, 0.78f, 0.74f}, 0.6f));
    frame.bodies.push_back(painted(pieces[n], n, (middleOf(boundsOf(pieces[n])) - middle) * settings.explode));
  }
  if (frame.bodies.empty()) throw InputError("brisance: there is no piece to draw");
  render.width = settings.width;
  render.height = settings.height;
  render.samples = settings.samples;
  render.background = {2, 2, 2};  // near white on the screen, after the tone curve
  render.ambientLight = {0.22f, 0.22f, 0.23f};
  render.volume.drawn = false;
  render.camera.keys = {cameraFor(frame.bodies, middle, settings)};
  render.lights = lightsFor(settings.toViewer);
  return developed(renderFrame(frame, render), render.exposureStops);
}

}  // namespace brisance
