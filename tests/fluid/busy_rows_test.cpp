#include "fluid/busy_rows.h"

#include <gtest/gtest.h>

#include "fluid/advection.h"
#include "fluid/fluid_fixture.h"

namespace brisance {
namespace {
using namespace test;

TEST(BusyRows, AreThoseNearASampleThatDiffersAndAroundAPeriodicBox) {
  for (const FaceKind kind : {FaceKind::open, FaceKind::periodic}) {
    const FluidSettings s = box({5, 12, 11}, kind);
    Grid3<float> scalar(s.cells, {}, s.cellSize);
    scalar(4, 1, 10) = 1e-30f;
    scalar(0, 7, 3) = -1;
    BusyRows busy;
    busy.find(scalar, 0, s.faces);
    ASSERT_FALSE(busy.all());
    const auto apart = [&](int a, int b, int size) {
      const int distance = std::abs(a - b);
      return kind == FaceKind::periodic ? std::min(distance, size - distance) : distance;
    };
    for (int rows = 0; rows <= BusyRows::farthest; ++rows)
      for (int k = 0; k < s.cells.z; ++k)
        for (int j = 0; j < s.cells.y; ++j) {
          const int first = apart(j, 1, 12) + apart(k, 10, 11), second = apart(j, 7, 12) + apart(k, 3, 11);
          EXPECT_EQ(busy.within(rows, j, k), std::min(first, second) <= rows) << rows << " " << j << " " << k;
        }
  }
}

TEST(BusyRows, AreAllWhereMostAre) {
  const FluidSettings s = box({5, 12, 11});
  Grid3<float> scalar(s.cells, {}, s.cellSize, 3);
  BusyRows busy;
  busy.find(scalar, 0, s.faces);
  EXPECT_TRUE(busy.all());
  busy.find(scalar, 3, s.faces);
  EXPECT_FALSE(busy.all());
  EXPECT_FALSE(busy.within(BusyRows::farthest, 2, 2));
  busy.take(s.cells);
  EXPECT_TRUE(busy.within(0, 2, 2));
}

/// A ball of smoke in a whirling wind without inflow, in which nothing else is said to be usual.
TEST(BusyRows, MacCormackMovesABallOfSmokeAsIfAllRowsWereBusy) {
  for (const FaceKind kind : {FaceKind::noSlip, FaceKind::periodic})
    for (const Vec3i& middle : {Vec3i{10, 11, 12}, {0, 0, 23}, {19, 21, 0}}) {
      FluidSettings s = box({20, 22, 24}, kind);
      s.advection = MacCormack{};
      FluidState gas = gasIn(s);
      for (int axis = 0; axis < 3; ++axis)
        setComponent(gas.velocity.component(axis),
                     [&](const Vec3d& at) { return std::sin(6.2831853 * (at[(axis + 1) % 3] + 0.3 * axis)) + 0.4; });
      restAtClosedFaces(gas);
      for (int k = 0; k < s.cells.z; ++k)
        for (int j = 0; j < s.cells.y; ++j)
          for (int i = 0; i < s.cells.x; ++i) {
            const Vec3i away{i - middle.x, j - middle.y, k - middle.z};
            gas.soot(i, j, k) =
                away.x * away.x + away.y * away.y + away.z * away.z < 9 ? 1 + 0.1f * static_cast<float>(i) : 0.5f;
          }
      const double dt = 0.9 * s.cellSize / 4.2;
      AdvectionScratch few, all;
      Grid3<float> some = gas.soot, every = gas.soot;
      for (int step = 0; step < 2; ++step) {
        const Balance balance = advectScalar(some, gas, s, 0.5f, dt, few);
        EXPECT_FALSE(few.busy.all());
        carryScalar(every, gas, s, 0, dt, all);
        EXPECT_TRUE(all.busy.all());
        EXPECT_EQ(some.values, every.values);
        EXPECT_NEAR(balance.out, 0, 1e-9);  // closed, or what leaves comes in again
      }
    }
}

}  // namespace
}  // namespace brisance
