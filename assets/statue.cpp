#include "assets/models.h"

namespace brisance::samples {
namespace {

constexpr int leftRight = 0;

/// A robe that falls in folds from the hips to the plinth.
Implicit robe() {
  Union cloth;
  cloth.add(limb({{{0.03, 0.9, 0}, 0.17}, {{0.02, 0.8, 0}, 0.215}, {{0, 0.12, 0}, 0.27}}), 0.03);
  return [cloth](const Vec3d& p) {
    constexpr double folds = 5, depth = 0.035, waist = 0.95, knee = 0.5;  // [-, m, m, m]
    const double angle = portableAtan2(p.x, p.z);
    const double fall = std::clamp((waist - p.y) / (waist - knee), 0.0, 1.0);
    return cloth(p) + depth * fall * portableSinCos(folds * angle + 2.5 * p.y).sin;
  };
}

Union torso() {
  Union all;
  all.add(ellipsoid({0, 1.32, 0}, {0.19, 0.2, 0.13}), 0.05);
  all.add(limb({{{-0.17, 1.45, 0}, 0.075}, {{0.17, 1.43, 0}, 0.075}}), 0.1);    // shoulders
  all.add(mirrored(ball({0.085, 1.34, 0.1}, 0.075), leftRight), 0.03);          // breasts
  all.add(limb({{{0, 1.25, 0}, 0.11}, {{0.02, 1.06, 0}, 0.108}}), 0.08);        // waist
  all.add(limb({{{0.21, 1.43, 0}, 0.068}, {{0.27, 1.27, 0.02}, 0.06}}), 0.05);  // arms, broken off
  all.add(limb({{{-0.21, 1.45, 0}, 0.07}, {{-0.29, 1.22, 0.04}, 0.058}, {{-0.29, 1.12, 0.09}, 0.052}}), 0.05);
  return all;
}

Union head() {
  Union all;
  all.add(limb({{{0, 1.42, 0}, 0.1}, {{0.01, 1.64, 0}, 0.075}}), 0.05);  // neck
  all.add(ellipsoid({0.01, 1.76, 0.03}, {0.1, 0.145, 0.12}), 0.05);
  all.add(ellipsoid({0.01, 1.81, -0.03}, {0.135, 0.13, 0.14}), 0.015);                               // hair
  all.add(limb({{{0.01, 1.8, -0.1}, 0.09}, {{0, 1.5, -0.12}, 0.1}, {{0, 1.3, -0.1}, 0.09}}), 0.08);  // down her back
  all.add(limb({{{0.01, 1.83, 0.13}, 0.02}, {{0.01, 1.74, 0.18}, 0.038}}), 0.02);                    // nose
  all.carve(mirrored(ball({0.055, 1.785, 0.165}, 0.045), leftRight), 0.03);                          // eyes
  all.add(ellipsoid({0.01, 1.695, 0.145}, {0.045, 0.025, 0.025}), 0.015);                            // lips
  all.add(ball({0.01, 1.65, 0.11}, 0.035), 0.04);                                                    // chin
  return all;
}

}  // namespace

Model statueModel() {
  Union body;
  body.add(robe(), 0.06);
  body.add(limb({{{0.12, 0.3, 0.17}, 0.09}, {{0.12, 0.62, 0.16}, 0.1}, {{0.09, 0.9, 0.05}, 0.14}}),
           0.06);  // a knee bent
  body.add(torso(), 0.04);
  body.add(head(), 0.03);
  body.add(ellipsoid({0, 0.09, 0}, {0.38, 0.15, 0.38}), 0.1);  // plinth
  body.carve(halfSpace({0, 0, 0}, {0, 1, 0}), 0.12);
  Union details = torso();
  details.add(head(), 0.1);
  return {body, {{-0.6, -0.1, -0.6}, {0.6, 2.1, 0.6}}, details, 0.68, 0.022, 1418};
}

}  // namespace brisance::samples
