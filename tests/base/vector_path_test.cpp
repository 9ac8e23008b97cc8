#include "base/vector_path.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/random.h"

namespace brisance {
namespace {

/// Restores the path that was chosen before.
class VectorPathTest : public testing::Test {
 protected:
  ~VectorPathTest() override { forceVectorPath(before_); }

 private:
  VectorPath before_ = vectorPath();
};

/// A loop with products next to sums: a fused multiply-add would change its last bits.
std::vector<float> stencilWith(VectorPath path) {
  forceVectorPath(path);
  const Random random(1, Stream::test);
  std::vector<float> in(1003), out(in.size());
  for (std::size_t n = 0; n < in.size(); ++n) in[n] = static_cast<float>(random.normal(n));
  runWide([&] {
    for (std::size_t n = 1; n + 1 < in.size(); ++n)
      out[n] = 0.3f * in[n - 1] + 0.7f * in[n] * in[n] - in[n + 1] / (2.f + in[n] * in[n]);
  });
  return out;
}

TEST_F(VectorPathTest, EveryPathGivesTheSameBits) {
  const std::vector<float> plain = stencilWith(VectorPath::plain);
  EXPECT_NE(plain[1], plain[2]);
  EXPECT_EQ(stencilWith(VectorPath::avx2), plain);
  EXPECT_EQ(stencilWith(VectorPath::avx512), plain);
}

TEST_F(VectorPathTest, IsNeverWiderThanTheProcessor) {
  forceVectorPath(VectorPath::avx512);
  const VectorPath widest = vectorPath();
  for (const VectorPath wish : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(wish);
    EXPECT_EQ(vectorPath(), std::min(wish, widest));
  }
}

TEST_F(VectorPathTest, RunsTheBodyOnceOnEachPath) {
  for (const VectorPath path : {VectorPath::plain, VectorPath::avx2, VectorPath::avx512}) {
    forceVectorPath(path);
    int runs = 0;
    runWide([&] { ++runs; });
    EXPECT_EQ(runs, 1);
  }
}

}  // namespace
}  // namespace brisance
