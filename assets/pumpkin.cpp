#include "assets/models.h"

namespace brisance::samples {
namespace {

/// Ribs: ellipsoids around the stem.
Union flesh() {
  constexpr int ribs = 11;
  Union all;
  for (int rib = 0; rib < ribs; ++rib) {
    const auto [sin, cos] = portableSinCos(2 * pi * rib / ribs);
    const Vec3d outward{cos, 0, sin};
    all.add(ellipsoid(Vec3d{0, 0.4, 0} + outward * 0.3, {0.3, 0.4, 0.2}, {outward, {0, 1, 0}}), 0.05);
  }
  all.add(ellipsoid({0, 0.4, 0}, {0.3, 0.33, 0.3}), 0.1);
  return all;
}

Union stem() {
  Union all;
  all.add(limb({{{0, 0.66, 0}, 0.12}, {{0.01, 0.82, 0}, 0.07}, {{0.05, 0.93, 0}, 0.062}, {{0.12, 1.01, 0.01}, 0.07}}),
          0.02);
  all.carve(halfSpace({0.12, 1.02, 0.01}, {-0.7, -0.8, -0.05}), 0.02);
  return all;
}

}  // namespace

Model pumpkinModel() {
  Union all;
  const Union fruit = flesh();
  // A little longer one way than the other, as pumpkins are that have lain on the field.
  all.add([fruit](const Vec3d& p) { return fruit({p.x / 1.2, p.y, p.z}); }, 0.03);
  all.add(stem(), 0.06);
  return {all, {{-0.85, -0.15, -0.8}, {0.85, 1.25, 0.8}}, stem(), 1, 0.03, 10000};
}

}  // namespace brisance::samples
