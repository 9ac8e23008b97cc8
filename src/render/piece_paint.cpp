#include "render/piece_paint.h"

#include <algorithm>
#include <cmath>

namespace brisance {
namespace {

/// A piece's hue in turns: the golden ratio keeps any first few apart.
double hueOf(std::size_t piece) {
  const double turns = 0.6180339887498949 * static_cast<double>(piece);
  return turns - std::floor(turns);
}

/// A colour of some hue, its largest component 1 and its smallest 0.
Vec3f pureColour(double hue) {
  Vec3f colour;
  for (int c = 0; c < 3; ++c) {
    const double away = std::abs(hue - c / 3.0), around = std::min(away, 1 - away);  // in turns
    colour[c] = static_cast<float>(std::clamp(2 - 6 * around, 0.0, 1.0));
  }
  return colour;
}

float luminance(const Vec3f& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// `colour` on its way to `hue` of the same luminance.
Vec3f tinted(const Vec3f& colour, const Vec3f& hue, float share) {
  return colour * (1 - share) + hue * (share * luminance(colour) / luminance(hue));
}

Material onPiece(Material material, const FrameBody& body, std::size_t piece, const BlackbodyColours& heat) {
  if (auto* solid = std::get_if<SolidColour>(&material.diffuse))
    solid->colour = tinted(solid->colour, pureColour(hueOf(piece)), static_cast<float>(material.pieceTint));
  material.emission += heat(static_cast<float>(body.temperature)) * static_cast<float>(material.glow);
  return material;
}

bool differs(const Material& material) { return material.pieceTint > 0 || material.glow > 0; }

}  // namespace

void paintPieces(std::vector<FrameBody>& bodies, std::map<std::string, Material>& materials,
                 const BlackbodyColours& heat) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto found = materials.find(bodies[b].material);
    if (found == materials.end() || !differs(found->second)) continue;
    const Material material = onPiece(found->second, bodies[b], b, heat);
    bodies[b].material += "@" + bodies[b].name;  // the names of bodies have no @
    materials[bodies[b].material] = material;
  }
}

}  // namespace brisance
