#include "particles/particle_order.h"

#include <gtest/gtest.h>

#include <tuple>

#include "base/random.h"

namespace brisance {
namespace {

/// In a box of 1 m a side, and a little beyond it.
ParticleSet scattered(int count) {
  const Random random(1, Stream::test);
  ParticleSet particles;
  for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(count); ++n) {
    NewParticle fuel;
    fuel.position = Vec3d(random.uniform(4 * n), random.uniform(4 * n + 1), random.uniform(4 * n + 2)) * 1.02;
    fuel.mass = random.uniform(4 * n + 3);
    fuel.temperature = 300 + static_cast<double>(n);
    fuel.ignited = n % 3 == 0;
    fuel.kind = n % 2 == 0 ? ParticleKind::fuel : ParticleKind::soot;
    append(particles, fuel);
  }
  return particles;
}

auto fieldsOf(const ParticleSet& p, std::size_t n) {
  return std::tuple(p.position[n], p.velocity[n], p.mass[n], p.temperature[n], p.sootMass[n], p.kind[n], p.ignited[n],
                    p.madeSoot[n]);
}

TEST(ParticleOrder, KeepsEachParticleWholeAndRowsTogether) {
  const ParticleSet before = scattered(5000);
  ParticleSet after = before;
  OrderScratch scratch;
  const Grid3<float> cells({10, 10, 10}, {.05, .05, .05}, 0.1);
  for (int again = 0; again < 2; ++again) sortByRow(after, cells, scratch);  // the second time nothing moves
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after.nextId, before.nextId);
  const auto rowOf = [](const Vec3d& p) {
    const auto cell = [](double x) { return std::min(9, static_cast<int>(x * 10)); };
    return cell(p.y) + 10 * cell(p.z);
  };
  for (std::size_t n = 0; n < after.size(); ++n) {
    ASSERT_EQ(fieldsOf(after, n), fieldsOf(before, after.id[n]));  // ids were 0, 1, 2, ...
    if (n == 0) continue;
    const int row = rowOf(after.position[n]), previous = rowOf(after.position[n - 1]);
    ASSERT_TRUE(row > previous || (row == previous && after.id[n] > after.id[n - 1]));
  }
}

TEST(ParticleOrder, RemovingKeepsTheOrderOfTheOthers) {
  for (const int period : {1, 2, 7, 5001}) {
    const ParticleSet before = scattered(5000);
    ParticleSet after = before;
    std::vector<std::uint8_t> gone(before.size(), 0);
    for (std::size_t n = 0; n < gone.size(); n += static_cast<std::size_t>(period)) gone[n] = 1;
    removeFlagged(after, gone);
    std::size_t kept = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
      if (gone[n]) continue;
      ASSERT_LT(kept, after.size());
      ASSERT_EQ(after.id[kept], before.id[n]);
      ASSERT_EQ(fieldsOf(after, kept), fieldsOf(before, n));
      ++kept;
    }
    EXPECT_EQ(kept, after.size());
  }
}

}  // namespace
}  // namespace brisance
