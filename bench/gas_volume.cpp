// The volume of the picture, and gas as files: beside OpenVDB.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "base/stream_copy.h"
#include "frame/gas_file.h"
#include "frame/particle_volume.h"

#ifdef BRISANCE_HAS_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Filter.h>
#endif

namespace brisance {
namespace {

constexpr int volumeCells = 300, particleCount = 1'000'000;
constexpr double cellSize = 1.0 / volumeCells;
constexpr std::int64_t volumeFloats = std::int64_t{4} * volumeCells * volumeCells * volumeCells;

/// All over the box: nothing is empty.
FrameParticles spreadParticles() {
  const Random random(1, Stream::test);
  FrameParticles particles;
  for (std::uint64_t n = 0; n < particleCount; ++n) {
    particles.position.emplace_back(static_cast<float>(random.uniform(4 * n)),
                                    static_cast<float>(random.uniform(4 * n + 1)),
                                    static_cast<float>(random.uniform(4 * n + 2)));
    particles.mass.push_back(1e-6f);
    particles.temperature.push_back(static_cast<float>(random.uniform(4 * n + 3)));
  }
  return particles;
}

/// An object, as the renderer's colours are: calls of it are inlined.
constexpr auto colourOf = [](float temperature) { return Vec3f(1, temperature, temperature * temperature); };

ParticleVolumeSettings volumeSettings(double deviation, int filterSize) {
  return {{volumeCells, volumeCells, volumeCells}, {0, 0, 0}, cellSize, deviation * cellSize, filterSize};
}

/// The definition in double, at one cell so far from the faces that none of its sources is narrowed by them.
double exactDensity(const FrameParticles& particles, const Vec3i& cell, double deviation, int radius) {
  const auto weight = [&](int t) {
    return std::abs(t) > radius ? 0 : std::exp(-0.5 * t * t / (deviation * deviation));
  };
  double norm = 0, sum = 0;
  for (int t = -radius; t <= radius; ++t) norm += weight(t);
  for (std::size_t n = 0; n < particles.position.size(); ++n) {
    double share = particles.mass[n];
    for (int axis = 0; axis < 3 && share > 0; ++axis) {
      const double p = double(particles.position[n][axis]) / cellSize - .5, lower = std::floor(p);
      const int away = static_cast<int>(lower) - cell[axis];
      share *= ((1 - (p - lower)) * weight(away) + (p - lower) * weight(away + 1)) / norm;
    }
    sum += share;
  }
  return sum / (cellSize * cellSize * cellSize);
}

double errorOf(const ParticleVolume& volume, const FrameParticles& particles, double deviation, int radius) {
  const Random random(2, Stream::test);
  double error = 0, largest = 0;
  for (std::uint64_t n = 0; n < 10; ++n) {
    const auto place = [&](std::uint64_t axis) {
      return 2 * radius + static_cast<int>(random.below(volumeCells - 4 * radius, 3 * n + axis));
    };
    const Vec3i cell(place(0), place(1), place(2));
    const double exact = exactDensity(particles, cell, deviation, radius);
    error = std::max(error, std::abs(volume.density(cell.x, cell.y, cell.z) - exact));
    largest = std::max(largest, exact);
  }
  return error / largest;
}

/// Reads an array as large as the volume once and writes another, past the caches, by all threads: what a blur does at
/// least to one that is there already.
class VolumeCopy {
 public:
  void operator()() {
    constexpr std::int64_t grain = 1 << 20;
    parallelFor(0, std::ssize(from_), grain, [&](std::int64_t first, std::int64_t last) {
      streamCopy(&to_[first], &from_[first], last - first);
      endStreaming();
    });
  }

 private:
  AlignedVector<float> from_ = AlignedVector<float>(volumeFloats, 1.f), to_ = from_;
};

void copyVolume(benchmark::State& state) {
  VolumeCopy copy;
  for (auto _ : state) copy();
  state.counters["threads"] = threadCount();
}

/// In this run, the median of some.
double secondsOfCopy() {
  VolumeCopy copy;
  std::array<double, 9> seconds;
  Stopwatch watch;
  for (double& lap : seconds) {
    copy();
    lap = watch.lap();
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

void splatAndBlur(benchmark::State& state, double deviation, int filterSize) {
  const FrameParticles particles = spreadParticles();
  const ParticleVolumeSettings settings = volumeSettings(deviation, filterSize);
  const auto weigh = [&](std::size_t n) { return particles.mass[n]; };
  ParticleVolume volume;
  SplatScratch scratch;
  splatParticles(particles, settings, weigh, colourOf, volume, scratch);  // fresh memory comes once in a film
  Stopwatch watch;
  for (auto _ : state) splatParticles(particles, settings, weigh, colourOf, volume, scratch);
  const double seconds = watch.lap() / static_cast<double>(state.iterations());
  static const double copySeconds = secondsOfCopy();
  state.counters["threads"] = threadCount();
  state.counters["timesTheCopy"] = seconds / copySeconds;
  const int radius = filterSize > 0 ? filterSize / 2 : static_cast<int>(std::ceil(3 * deviation));
  state.counters["error"] = errorOf(volume, particles, deviation, radius);
}

/// The bytes of the volume stored once, by all threads and ordinary stores: the least that any splat does.
void storeVolume(benchmark::State& state) {
  constexpr std::int64_t grain = 1 << 20;
  AlignedVector<float> volume(volumeFloats);
  for (auto _ : state)
    parallelFor(0, volumeFloats, grain, [&](std::int64_t first, std::int64_t last) {
      std::fill(&volume[first], &volume[first] + (last - first), 1.f);
    });
  state.counters["threads"] = threadCount();
}

constexpr int gasCells = 128;

/// A fireball, and gas that moves everywhere.
struct Explosion {
  Grid3<float> density{{gasCells, gasCells, gasCells}, Vec3d(.5, .5, .5) / gasCells, 1.0 / gasCells, 0.f};
  Grid3<float> temperature{density.size, density.origin, density.cellSize, 300.f};
  Grid3<float> flame = density;
  Grid3<Vec3f> velocity{density.size, density.origin, density.cellSize};

  Explosion() {
    const Random random(3, Stream::test);
    for (int k = 0; k < gasCells; ++k)
      for (int j = 0; j < gasCells; ++j)
        for (int i = 0; i < gasCells; ++i) {
          const Vec3d away = density.position(i, j, k) - Vec3d(.5, .5, .5);
          const std::int64_t n = density.index(i, j, k);
          velocity.values[n] = Vec3f(away * (0.3 / (0.01 + dot(away, away))));
          const double inside = 1 - dot(away, away) / (0.4 * 0.4);
          if (inside <= 0) continue;
          const float curls = static_cast<float>(inside * (1 + 0.3 * std::sin(40 * away.x) * std::sin(50 * away.y) +
                                                           1e-3 * random.uniform(static_cast<std::uint64_t>(n))));
          density.values[n] = 0.1f * curls;
          temperature.values[n] = 300 + 2000 * curls;
          flame.values[n] = inside > 0.5 ? 0.05f * curls : 0.f;
        }
  }

  GasSource source() const {
    return {denseBricks(density, 0.f), denseBricks(temperature, 300.f), denseBricks(flame, 0.f),
            denseBricks(velocity, Vec3f())};
  }
  FrameGas sparse() const {
    const GasSource gas = source();
    return {makeSparse(gas.density), makeSparse(gas.temperature), makeSparse(gas.flame), makeSparse(gas.velocity)};
  }
};

/// Frames are new files: what taking away an old one costs is left out.
void removeUntimed(benchmark::State& state, const std::filesystem::path& file) {
  state.PauseTiming();
  std::filesystem::remove(file);
  state.ResumeTiming();
}

std::filesystem::path benchFile(const std::string& name) { return std::filesystem::temp_directory_path() / name; }

template <class T>
double differences(const SparseGrid<T>& a, const SparseGrid<T>& b) {
  double count = 0;
  for (std::size_t n = 0; n < std::min(a.bricks.size(), b.bricks.size()); ++n) count += !(a.bricks[n] == b.bricks[n]);
  return count + std::abs(double(a.bricks.size()) - double(b.bricks.size()));
}

/// From dense grids to a synced file under its final name.
void writeExplosion(benchmark::State& state) {
  const Explosion explosion;
  const auto file = benchFile("brisance_bench_gas.vdb");
  for (auto _ : state) {
    removeUntimed(state, file);
    writeGas(file, explosion.source());
  }
  const FrameGas read = readGas(file), expected = explosion.sparse();
  state.counters["threads"] = threadCount();
  state.counters["wrongBricks"] =
      differences(read.density, expected.density) + differences(read.temperature, expected.temperature) +
      differences(read.flame, expected.flame) + differences(read.velocity, expected.velocity);
  state.counters["MB"] = 1e-6 * static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::remove(file);
}

/// Without the disk.
void packExplosion(benchmark::State& state) {
  const Explosion explosion;
  for (auto _ : state) benchmark::DoNotOptimize(packGas(explosion.source()));
  state.counters["threads"] = threadCount();
}

#ifdef BRISANCE_HAS_OPENVDB
/// Four grids, each particle's eight shares set one by one, then the library's own Gaussian: four box means of three
/// cells, the deviation of which is sqrt(8/3) cells.
void splatAndBlurByOpenVdb(benchmark::State& state) {
  openvdb::initialize();
  const FrameParticles particles = spreadParticles();
  double mass = 0;
  for (auto _ : state) {
    std::array<openvdb::FloatGrid::Ptr, 4> grids;
    for (std::size_t c = 0; c < 4; ++c) {
      grids[c] = openvdb::FloatGrid::create(0.f);
      grids[c]->denseFill({{0, 0, 0}, {volumeCells - 1, volumeCells - 1, volumeCells - 1}}, 0.f, true);
      auto access = grids[c]->getAccessor();
      for (std::size_t n = 0; n < particles.position.size(); ++n) {
        const Vec3f colour = colourOf(particles.temperature[n]);
        const float amount = particles.mass[n] * (c == 0 ? 1 : colour[static_cast<int>(c) - 1]);
        const Vec3d p = Vec3d(particles.position[n]) / cellSize - Vec3d(.5, .5, .5);
        const Vec3i lower(static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                          static_cast<int>(std::floor(p.z)));
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3i step(corner & 1, corner >> 1 & 1, corner >> 2);
          const Vec3d share = p - Vec3d(lower);
          double weight = amount;
          for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? share[axis] : 1 - share[axis];
          access.modifyValue({lower.x + step.x, lower.y + step.y, lower.z + step.z},
                             [&](float& value) { value += static_cast<float>(weight); });
        }
      }
      openvdb::tools::Filter<openvdb::FloatGrid>(*grids[c]).gaussian(1, 1);
    }
    mass = 0;
    for (auto value = grids[0]->cbeginValueOn(); value; ++value) mass += *value;
  }
  state.counters["threads"] = threadCount();
  state.counters["massError"] = std::abs(mass / (1e-6 * particleCount) - 1);
}

template <class Grid, class Value, class T>
typename Grid::Ptr fromDense(const Grid3<T>& dense, const T& background, const std::string& name) {
  using Dense = openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ>;
  static_assert(sizeof(Value) == sizeof(T));
  const openvdb::CoordBBox box({0, 0, 0}, {dense.size.x - 1, dense.size.y - 1, dense.size.z - 1});
  const Dense view(box, reinterpret_cast<Value*>(const_cast<T*>(dense.values.data())));
  Value outside;
  std::memcpy(static_cast<void*>(&outside), &background, sizeof outside);
  auto grid = Grid::create(outside);
  openvdb::tools::copyFromDense(view, *grid, Value(0.f));
  grid->setName(name);
  return grid;
}

void writeExplosionByOpenVdb(benchmark::State& state) {
  openvdb::initialize();
  const Explosion explosion;
  const auto file = benchFile("brisance_bench_peer.vdb");
  for (auto _ : state) {
    removeUntimed(state, file);
    const openvdb::GridCPtrVec grids{fromDense<openvdb::FloatGrid, float>(explosion.density, 0.f, "density"),
                                     fromDense<openvdb::FloatGrid, float>(explosion.temperature, 300.f, "temperature"),
                                     fromDense<openvdb::FloatGrid, float>(explosion.flame, 0.f, "flame"),
                                     fromDense<openvdb::Vec3SGrid, openvdb::Vec3s>(explosion.velocity, Vec3f(), "vel")};
    openvdb::io::File out(file.string());
    out.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write(grids);
  }
  state.counters["threads"] = threadCount();
  state.counters["MB"] = 1e-6 * static_cast<double>(std::filesystem::file_size(file));
  std::filesystem::remove(file);
}
#endif

template <class... Arguments>
auto add(const std::string& name, Arguments... arguments) {
  return benchmark::RegisterBenchmark(name.c_str(), arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
}

const bool registered = [] {
  keepFreedMemory();
  add("SplatBlur/Particles/300/Brisance", splatAndBlur, 1.0, 5);        // the thesis' nf = 5
  add("SplatBlur/ParticlesWide/300/Brisance", splatAndBlur, 6.0, 0);    // the scenes' default: 37 cells
  add("SplatBlur/ParticlesPeer/300/Brisance", splatAndBlur, 1.633, 0);  // as wide as the peer's
  add("SplatBlur/StoreVolume/300/Memory", storeVolume);
  add("SplatBlur/CopyVolume/300/Memory", copyVolume);
  add("WriteVdb/Explosion/128/Brisance", writeExplosion);
  add("WriteVdb/ExplosionInMemory/128/Brisance", packExplosion);
#ifdef BRISANCE_HAS_OPENVDB
  add("SplatBlur/Particles/300/OpenVdb", splatAndBlurByOpenVdb)->Iterations(1);
  add("WriteVdb/Explosion/128/OpenVdb", writeExplosionByOpenVdb);
#endif
  return true;
}();

}  // namespace
}  // namespace brisance
