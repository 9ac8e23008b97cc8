// The bodies of a frame as something that rays hit.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "frame/frame.h"
#include "render/materials.h"

namespace brisance {

struct Ray {
  Vec3f origin;     ///< [m]
  Vec3f direction;  ///< unit
  float near = 0;   ///< [m] where it begins
  float time = 0;   ///< 0 .. 1 while the shutter is open
};

/// The triangle that a ray meets, before anything is looked up about it.
struct FoundTriangle {
  static constexpr std::uint32_t none = ~0u;
  std::uint32_t body = none, triangle = 0;
  float distance = 0;  ///< [m]
  float u = 0, v = 0;  ///< shares of its second and third corner
  Vec3f across;        ///< along its normal, outward, of any length
  bool isNone() const { return body == none; }
};

struct SurfaceHit {
  float distance = 0;    ///< [m]
  Vec3f normal;          ///< of the triangle: unit, outward
  Vec3f shadingNormal;   ///< between the vertices where the material is smooth, else `normal`: unit, outward
  TexturePlace texture;  ///< the place in the body only where the material is a pattern in space
  Vec3f alongU;          ///< the way u grows, any length, only where the material is anisotropic
  std::uint16_t material = 0;
  std::uint32_t body = 0;
};

/// Whether a shadow falls behind glass.
enum class GlassShade { passes, blocks };

/// Where a body is `seconds` after its pose.
Pose poseAfter(const FrameBody& body, double seconds);

/// A bounding volume hierarchy (Embree) over transformed copies of all bodies; built anew for each frame.
class SceneGeometry {
 public:
  /// `openTime` [s]: how long the bodies move during the picture, half of it before and half after their poses.
  /// Throws InputError for a material that `materials` does not have, Error(noRoom) when memory runs out.
  SceneGeometry(const std::vector<FrameBody>& bodies, const MaterialTable& materials, double openTime);
  ~SceneGeometry();
  SceneGeometry(const SceneGeometry&) = delete;
  SceneGeometry& operator=(const SceneGeometry&) = delete;

  /// So many rays at a time are followed best together, where they go much the same way.
  static constexpr int packet = 16;

  /// The first surface beyond ray.near.
  bool closest(const Ray& ray, SurfaceHit& hit) const;
  /// The same in two parts: the triangle that a ray meets, or that each ray of a packet meets, and what it is there.
  FoundTriangle find(const Ray& ray) const;
  void find(std::span<const Ray> rays, std::span<FoundTriangle> found) const;
  SurfaceHit surfaceAt(const FoundTriangle& found) const;
  /// The share of light that comes along the ray over `distance` [m]: 0 behind a surface that casts a shadow. Light
  /// passes glass straight (no caustics), is absorbed in it, and loses at each of its surfaces the reflection at normal
  /// incidence; or glass blocks light like any other body.
  Vec3f lightPassing(const Ray& ray, float distance, GlassShade glass = GlassShade::passes) const;
  /// The same for a packet of rays, each over its own distance.
  void lightPassing(std::span<const Ray> rays, std::span<const float> distances, std::span<Vec3f> passing) const;
  /// Whether at a hit on glass another body of the same glass touches it, so that there is no surface to see: the
  /// hidden faces between pieces that have not parted yet.
  bool touchesSameGlass(const Ray& ray, const SurfaceHit& hit) const;
  /// A distance [m] below which two surfaces are one: float positions carry an error of this size.
  float resolution() const { return resolution_; }

 private:
  struct Bodies;
  std::unique_ptr<Bodies> bodies_;
  float resolution_;
};

}  // namespace brisance
