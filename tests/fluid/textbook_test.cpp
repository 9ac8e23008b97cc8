// The gas against flows of textbooks.
#include "assets/textbook_flows.h"

#include <gtest/gtest.h>

#include <cmath>

namespace brisance {
namespace {
using namespace textbook;

TEST(Textbook, PoissonsEquationIsSolvedToSecondOrder) {
  EXPECT_NEAR(std::log2(poissonError(16) / poissonError(32)), 2, 0.05);
}

class SecondOrder : public testing::TestWithParam<AdvectionScheme> {};

std::string nameOf(const testing::TestParamInfo<AdvectionScheme>& tested) {
  return tested.index == 0 ? "Central" : "MacCormack";
}
INSTANTIATE_TEST_SUITE_P(Textbook, SecondOrder, testing::Values(DonorCell{0}, MacCormack{}), nameOf);

/// A vortex at a Courant number of 0.8: the steps shrink with the cells, so that the order is that in space and time.
VortexResult vortexAt(int cells, const AdvectionScheme& scheme, double wind) {
  constexpr double time = 0.2;
  const Vec3d carried{wind, 0.3 * wind, 0};
  const double fastest = 2 + carried.x + carried.y;  // |u| + |v|
  const int steps = static_cast<int>(std::ceil(time * cells * fastest / 0.8));
  return runVortex({cells, scheme, 0.01, carried, time, steps});
}

TEST_P(SecondOrder, AVortexDecaysAtItsRate) { EXPECT_NEAR(vortexAt(32, GetParam(), 0).decay, 1, 0.01); }

TEST_P(SecondOrder, AVortexInTheWindConvergesAtSecondOrder) {
  const VortexResult coarse = vortexAt(16, GetParam(), 0.5), fine = vortexAt(32, GetParam(), 0.5);
  EXPECT_NEAR(std::log2(coarse.meanError / fine.meanError), 2, 0.2);
  EXPECT_NEAR(std::log2(coarse.largestError / fine.largestError), 2, 0.3);
  EXPECT_NEAR(fine.decay, 1, 0.01);
}

/// At most 2 % of the lid's speed from the table at 64 cells.
void expectGhia(const AdvectionScheme& scheme, int reynolds) {
  const CavityProfiles profiles = runCavity({64, scheme, double(reynolds)});
  EXPECT_LT(farthest(profiles.u, ghia(reynolds).u), 0.02);
  EXPECT_LT(farthest(profiles.v, ghia(reynolds).v), 0.02);
  EXPECT_LT(profiles.change, 1e-3) << "not steady after " << profiles.time << " s";
}

TEST_P(SecondOrder, ACavitysProfilesAreThoseOfGhiaAtReynoldsNumber100) { expectGhia(GetParam(), 100); }
TEST_P(SecondOrder, ACavitysProfilesAreThoseOfGhiaAtReynoldsNumber400) { expectGhia(GetParam(), 400); }

}  // namespace
}  // namespace brisance
