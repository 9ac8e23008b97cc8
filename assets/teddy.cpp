#include "assets/models.h"

namespace brisance::samples {
namespace {

constexpr int leftRight = 0;  // the bear looks along z: its sides are mirror images in x = 0

/// Eyes and nose, of buttons.
Union buttons() {
  Union all;
  all.add(ellipsoid({0, 1.17, 0.41}, {0.075, 0.05, 0.05}), 0.02);
  all.add(mirrored(ball({0.12, 1.245, 0.275}, 0.048), leftRight), 0.02);
  return all;
}

Union face() {
  Union all;
  all.add(ellipsoid({0, 1.1, 0.27}, {0.175, 0.135, 0.16}), 0.05);    // snout
  all.carve(ellipsoid({0, 1.06, 0.43}, {0.012, 0.09, 0.07}), 0.03);  // mouth
  all.add(buttons(), 0.015);
  return all;
}

Union head() {
  Union all;
  all.add(ellipsoid({0, 1.17, 0.02}, {0.31, 0.28, 0.28}), 0.05);
  all.add(face(), 0.04);
  Union ear;
  ear.add(ellipsoid({0.27, 1.405, 0}, {0.12, 0.12, 0.08}, {{0.8, -0.5, 0}, {0.5, 0.8, 0}}), 0.01);
  ear.carve(ellipsoid({0.28, 1.415, 0.11}, {0.095, 0.095, 0.07}), 0.05);
  all.add(mirrored(ear, leftRight), 0.05);
  return all;
}

Union limbs() {
  Union all;
  all.add(limb({{{0.31, 0.73, 0.03}, 0.145}, {{0.66, 0.52, 0.22}, 0.165}}), 0.05);             // arm
  all.add(ball({0.68, 0.49, 0.26}, 0.18), 0.06);                                               // paw
  all.add(limb({{{0.22, 0.21, 0.12}, 0.2}, {{0.41, 0.21, 0.6}, 0.185}}), 0.05);                // leg
  all.add(ellipsoid({0.43, 0.26, 0.7}, {0.2, 0.25, 0.11}, {{1, 0, -0.35}, {0, 1, 0}}), 0.06);  // foot
  return all;
}

}  // namespace

Model teddyModel() {
  Union body;
  body.add(limb({{{0, 0.42, 0}, 0.4}, {{0, 0.74, 0}, 0.26}}), 0.05);
  body.add(ellipsoid({0, 0.42, 0.1}, {0.4, 0.36, 0.39}), 0.1);  // belly
  body.add(mirrored(limbs(), leftRight), 0.07);
  body.add(ball({0, 0.25, -0.42}, 0.12), 0.06);  // tail
  body.carve(halfSpace({0, 0.02, 0}, {0, 1, 0}), 0.08);
  body.add(head(), 0.06);
  return {body, {{-1, -0.15, -0.7}, {1, 1.8, 1}}, buttons(), 0.6, 0.03, 3192};
}

}  // namespace brisance::samples
