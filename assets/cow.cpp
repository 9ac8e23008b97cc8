#include "assets/models.h"

namespace brisance::samples {
namespace {

constexpr int leftRight = 2;  // the cow looks along x: its sides are mirror images in z = 0

Union trunk() {
  Union body;
  body.add(limb({{{-0.62, 1.06, 0}, 0.37}, {{-0.1, 1.0, 0}, 0.43}, {{0.42, 1.04, 0}, 0.37}}), 0.1);
  body.add(ellipsoid({-0.1, 0.88, 0}, {0.58, 0.42, 0.46}), 0.2);      // belly
  body.add(ellipsoid({0.4, 1.22, 0}, {0.3, 0.26, 0.2}), 0.15);        // withers
  body.add(mirrored(ball({-0.66, 1.31, 0.2}, 0.1), leftRight), 0.2);  // hips
  body.add(ellipsoid({0.66, 0.86, 0}, {0.17, 0.24, 0.16}), 0.2);      // brisket
  return body;
}

Union legs() {
  constexpr double side = 0.23;  // [m]
  Union all;
  all.add(limb({{{0.42, 0.92, 0.2}, 0.2}, {{0.44, 0.54, side}, 0.105}, {{0.44, 0.45, side}, 0.1}}), 0.05);
  all.add(limb({{{0.44, 0.45, side}, 0.1}, {{0.42, 0.15, side}, 0.075}}), 0.05);
  all.add(limb({{{0.43, 0.14, side}, 0.085}, {{0.46, 0.03, side}, 0.115}}), 0.04);  // hoof
  all.add(limb({{{-0.62, 1.0, 0.17}, 0.28}, {{-0.58, 0.78, 0.22}, 0.2}, {{-0.75, 0.5, side}, 0.1}}), 0.05);
  all.add(limb({{{-0.75, 0.5, side}, 0.1}, {{-0.69, 0.15, side}, 0.078}}), 0.05);
  all.add(limb({{{-0.68, 0.14, side}, 0.085}, {{-0.65, 0.03, side}, 0.115}}), 0.04);
  all.carve(halfSpace({0, 0, 0}, {0, 1, 0}), 0.04);
  return all;
}

Union udder() {
  Union all;
  all.add(ellipsoid({-0.3, 0.5, 0}, {0.2, 0.17, 0.19}), 0.05);
  for (const double x : {-0.21, -0.38})
    all.add(mirrored(limb({{{x, 0.4, 0.085}, 0.05}, {{x, 0.27, 0.095}, 0.036}}), leftRight), 0.05);
  return all;
}

Union tail() {
  Union all;
  all.add(limb({{{-0.84, 1.3, 0}, 0.11}, {{-1.06, 1.24, 0}, 0.07}, {{-1.15, 0.95, 0.03}, 0.052}}), 0.05);
  all.add(limb({{{-1.15, 0.95, 0.03}, 0.052}, {{-1.13, 0.6, 0.08}, 0.048}}), 0.05);
  all.add(ellipsoid({-1.13, 0.47, 0.1}, {0.09, 0.19, 0.09}), 0.06);
  return all;
}

Union skull() {
  Union all;
  all.add(ellipsoid({1.02, 1.55, 0}, {0.24, 0.24, 0.21}), 0.05);
  all.add(limb({{{1.08, 1.5, 0}, 0.19}, {{1.34, 1.29, 0}, 0.155}}), 0.08);
  all.add(ellipsoid({1.4, 1.23, 0}, {0.15, 0.15, 0.2}, {{0.8, -0.6, 0}, {0.6, 0.8, 0}}), 0.08);  // muzzle
  all.add(ellipsoid({1.06, 1.38, 0}, {0.2, 0.17, 0.17}), 0.1);                                   // cheeks
  all.add(ellipsoid({1.02, 1.75, 0}, {0.1, 0.07, 0.12}), 0.06);                                  // poll
  all.add(mirrored(ball({1.19, 1.565, 0.165}, 0.062), leftRight), 0.02);                         // eyes
  all.add(mirrored(ellipsoid({1.17, 1.63, 0.165}, {0.1, 0.035, 0.06}), leftRight), 0.03);        // brows
  all.carve(mirrored(ellipsoid({1.515, 1.29, 0.1}, {0.05, 0.045, 0.035}), leftRight), 0.03);     // nostrils
  all.carve(ellipsoid({1.5, 1.14, 0}, {0.1, 0.028, 0.3}, {{1, -0.4, 0}, {0.4, 1, 0}}), 0.05);    // mouth
  return all;
}

Union head() {
  Union all = skull();
  const EllipsoidFrame leaf{{-0.35, -0.12, 1}, {-0.1, 1, 0.1}};
  Union ear;
  ear.add(ellipsoid({0.9, 1.58, 0.36}, {0.22, 0.115, 0.06}, leaf), 0.01);
  ear.carve(ellipsoid({0.96, 1.58, 0.42}, {0.15, 0.07, 0.06}, leaf), 0.04);
  all.add(mirrored(ear, leftRight), 0.06);
  all.add(mirrored(limb({{{0.98, 1.75, 0.1}, 0.075},
                         {{0.98, 1.82, 0.24}, 0.065},
                         {{1.03, 1.9, 0.36}, 0.05},
                         {{1.09, 2.0, 0.36}, 0.03}}),
                   leftRight),
          0.04);
  return all;
}

}  // namespace

Model cowModel() {
  Union body = trunk();
  body.add(mirrored(legs(), leftRight), 0.12);
  body.add(udder(), 0.08);
  body.add(tail(), 0.08);
  body.add(limb({{{0.5, 1.14, 0}, 0.28}, {{0.95, 1.45, 0}, 0.15}}), 0.15);  // neck
  body.add(head(), 0.06);
  Union details = head();
  details.add(udder(), 0.1);
  return {body, {{-1.4, -0.12, -0.75}, {1.75, 2.2, 0.75}}, details, 0.65, 0.028, 5804};
}

}  // namespace brisance::samples
