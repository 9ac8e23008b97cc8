#include "fluid/semi_lagrangian.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/visible_sample.h"

namespace brisance {

namespace {
constexpr int blockSamples = 128;  // whose corners stay in the nearest cache

struct Block {
  Vec3i begin;  ///< its first sample; the others follow along x
  int count;
  alignas(64) float shift[3][blockSamples];  ///< [cells] from each sample to the place asked for
  alignas(64) float speed[3][blockSamples];  ///< [m/s]
};

/// What is needed to look a place up along one axis of a padded grid, in its sample numbers.
struct AxisRange {
  float lowest, highest;  ///< places beyond are moved here
  int period;             ///< 0 where the axis ends
};

/// Samples on faces across `axis` have the walls of that axis on them; others half a cell away.
AxisRange rangeOf(const PaddedGrid& grid, const SampleGrid& samples, int axis) {
  const int size = grid.values.size[axis];
  const auto last = static_cast<float>(size - 1);
  const bool across = axis == samples.axis;
  if (isPeriodic(samples.faces, axis)) return {0, last, size - (across ? 3 : 2)};
  const auto margin = [&](FaceKind kind) { return kind == FaceKind::open ? 0.0f : across ? 1.0f : 0.5f; };
  return {margin(samples.faces[lowerFaceOf(axis)]), last - margin(samples.faces[upperFaceOf(axis)]), 0};
}

/// Trilinear values of a padded grid at the places of a block.
class Sampler {
 public:
  Sampler(const PaddedGrid& grid, const SampleGrid& samples, const Vec3f& offset) : grid_(grid), offset_(offset) {
    for (int axis = 0; axis < 3; ++axis) range_[axis] = rangeOf(grid, samples, axis);
  }

  /// At the block's own samples, which lie half-way between those of the grid or on them.
  void atRest(const Block& block, float* values) const {
    std::fill_n(values, block.count, 0.0f);
    int corners = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
      if ((x && offset_.x == 0) || (y && offset_.y == 0) || (z && offset_.z == 0)) continue;
      const auto below = [](float offset) { return offset < 0 ? -1 : 0; };
      const float* from = grid_.row(block.begin.y + y + below(offset_.y), block.begin.z + z + below(offset_.z)) +
                          block.begin.x + x + below(offset_.x);
      for (int n = 0; n < block.count; ++n) values[n] += from[n];
      ++corners;
    }
    const float share = 1.0f / static_cast<float>(corners);
    for (int n = 0; n < block.count; ++n) values[n] *= share;
  }

  void at(const Block& block, float* values) {
    std::fill_n(first_, block.count, 0);
    for (int axis = 0; axis < 3; ++axis) locate(block, axis);
    loadPairs(block.count);
    mix(block.count, values);
  }

 private:
  void locate(const Block& block, int axis) {
    const AxisRange range = range_[axis];
    const int base = block.begin[axis] + 1, along = axis == 0 ? 1 : 0, last = grid_.values.size[axis] - 2;
    const std::int64_t stride = grid_.values.stride(axis);
    float* share = share_[axis];
    for (int n = 0; n < block.count; ++n) {
      const float t = block.shift[axis][n] + offset_[axis];
      int below = static_cast<int>(t);
      below -= t < static_cast<float>(below) ? 1 : 0;
      int cell = base + along * n + below;
      float part = t - static_cast<float>(below);
      const float place = static_cast<float>(cell) + part;
      if (range.period == 0) {
        const float inside = std::min(std::max(place, range.lowest), range.highest);
        const int other = std::min(static_cast<int>(inside), last);
        part = inside == place ? part : inside - static_cast<float>(other);
        cell = inside == place ? cell : other;
      } else {
        const int around = (cell - 1) % range.period;
        cell = around < 0 ? around + range.period + 1 : around + 1;
      }
      // the last sample itself has none behind it
      part = cell > last ? 1.0f : part;
      cell = std::min(cell, last);
      share[n] = part;
      first_[n] += cell * stride;
    }
  }

  void loadPairs(int count) {
    const std::int64_t up = grid_.values.stride(1), back = grid_.values.stride(2);
    const float* values = grid_.values.values.data();
    for (int n = 0; n < count; ++n) {
      const float* corner = values + first_[n];
      std::memcpy(pair_[0] + 2 * n, corner, 2 * sizeof(float));
      std::memcpy(pair_[1] + 2 * n, corner + up, 2 * sizeof(float));
      std::memcpy(pair_[2] + 2 * n, corner + back, 2 * sizeof(float));
      std::memcpy(pair_[3] + 2 * n, corner + back + up, 2 * sizeof(float));
    }
  }

  void mix(int count, float* values) const {
    for (int n = 0; n < count; ++n) {
      const float a = share_[0][n], b = share_[1][n], c = share_[2][n];
      const auto line = [&](const float* pair) { return pair[2 * n] + (pair[2 * n + 1] - pair[2 * n]) * a; };
      const float p = line(pair_[0]), q = line(pair_[1]), r = line(pair_[2]), s = line(pair_[3]);
      const float near = p + (q - p) * b, far = r + (s - r) * b;
      values[n] = near + (far - near) * c;
    }
  }

  const PaddedGrid& grid_;
  Vec3f offset_;
  AxisRange range_[3];
  alignas(64) std::int64_t first_[blockSamples];
  alignas(64) float share_[3][blockSamples];
  alignas(64) float pair_[4][2 * blockSamples];
};

/// [cells] from a sample of a velocity component to the sample of the same number of the grid.
Vec3f offsetFrom(int component, const SampleGrid& samples) {
  Vec3f offset;
  if (component == samples.axis) return offset;
  offset[component] = 0.5f;
  if (samples.axis != SampleGrid::cells) offset[samples.axis] = -0.5f;
  return offset;
}

/// Follows a block of cells back.
class Tracer {
 public:
  Tracer(const PaddedVelocity& velocity, const SampleGrid& cells, float perSpeed)
      : speed_{Sampler(velocity.component[0], {cells.faces, 0}, offsetFrom(0, cells)),
               Sampler(velocity.component[1], {cells.faces, 1}, offsetFrom(1, cells)),
               Sampler(velocity.component[2], {cells.faces, 2}, offsetFrom(2, cells))},
        perSpeed_(perSpeed) {}

  void trace(Block& block) {
    for (int c = 0; c < 3; ++c) speed_[c].atRest(block, block.speed[c]);
    follow(block, 0.5f * perSpeed_);
    for (int c = 0; c < 3; ++c) speed_[c].at(block, block.speed[c]);
    follow(block, perSpeed_);
  }

 private:
  void follow(Block& block, float perSpeed) const {
    for (int c = 0; c < 3; ++c)
      for (int n = 0; n < block.count; ++n) block.shift[c][n] = perSpeed * block.speed[c][n];
  }
  Sampler speed_[3];
  float perSpeed_;
};

/// Calls work(thread's own copy of `tool`, block) for the blocks of all samples of a size.
template <class Tool, class Work>
void forBlocks(const Vec3i& size, const Tool& tool, const Work& work) {
  parallelFor(0, size.z, 1, [&](std::int64_t first, std::int64_t last) {
    Tool own = tool;
    Block block;
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; i += blockSamples) {
          block.begin = {i, j, k};
          block.count = std::min(blockSamples, size.x - i);
          work(own, block);
        }
  });
}

/// The paths from a block's samples.
class PathReader {
 public:
  PathReader(const FlowPaths& paths, const SampleGrid& samples) : paths_(paths), axis_(samples.axis) {
    if (axis_ != SampleGrid::cells) periodic_ = isPeriodic(samples.faces, axis_);
  }
  void read(Block& block) const {
    for (int c = 0; c < 3; ++c) {
      const Grid3<float>& path = paths_[c];
      if (axis_ == SampleGrid::cells)
        std::copy_n(&path(block.begin.x, block.begin.y, block.begin.z), block.count, block.shift[c]);
      else if (axis_ == 0)
        meanAlongRow(path, block, block.shift[c]);
      else
        meanOfRows(path, block, block.shift[c]);
    }
  }

 private:
  /// The cell after (or, for a face's number less one, before) a face; at the end of the box the one inside it.
  int cell(const Grid3<float>& path, int number) const {
    const int count = path.size[axis_];
    if (number >= 0 && number < count) return number;
    return periodic_ ? (number + count) % count : std::clamp(number, 0, count - 1);
  }
  void meanOfRows(const Grid3<float>& path, const Block& block, float* mean) const {
    Vec3i before = block.begin, after = block.begin;
    before[axis_] = cell(path, before[axis_] - 1);
    after[axis_] = cell(path, after[axis_]);
    const float *a = &path(before.x, before.y, before.z), *b = &path(after.x, after.y, after.z);
    for (int n = 0; n < block.count; ++n) mean[n] = 0.5f * (a[n] + b[n]);
  }
  void meanAlongRow(const Grid3<float>& path, const Block& block, float* mean) const {
    const float* row = &path(0, block.begin.y, block.begin.z);
    const int begin = block.begin.x, end = begin + block.count;
    for (int i = std::max(begin, 1); i < std::min(end, path.size.x); ++i)
      mean[i - begin] = 0.5f * (row[i - 1] + row[i]);
    const auto atEnd = [&](int i) { mean[i - begin] = 0.5f * (row[cell(path, i - 1)] + row[cell(path, i)]); };
    if (begin == 0) atEnd(0);
    if (end == path.size.x + 1) atEnd(path.size.x);
  }

  const FlowPaths& paths_;
  int axis_;
  bool periodic_ = false;
};

/// Among solids a scalar is looked up with an eye to what stands between.
void seeAround(const VisibleSampler& sampler, const Block& block, float* values) {
  for (int n = 0; n < block.count; ++n) {
    const Vec3i cell{block.begin.x + n, block.begin.y, block.begin.z};
    values[n] = sampler.at(cell, {block.shift[0][n], block.shift[1][n], block.shift[2][n]});
  }
}
}  // namespace

void tracePaths(const PaddedVelocity& velocity, const Faces& faces, double dt, FlowPaths& paths) {
  const Grid3<float>& u = velocity.component[0].values;
  const Vec3i size = u.size - Vec3i(3, 2, 2);  // without the ghosts, and between the faces
  for (Grid3<float>& path : paths)
    if (!(path.size == size)) path = Grid3<float>(size, {}, u.cellSize);
  const Tracer tracer(velocity, {faces}, static_cast<float>(-dt / u.cellSize));
  forBlocks(size, tracer, [&](Tracer& own, Block& block) {
    runWide([&] { own.trace(block); });
    for (int c = 0; c < 3; ++c)
      std::copy_n(block.shift[c], block.count, &paths[c](block.begin.x, block.begin.y, block.begin.z));
  });
}

void carryBack(const FluidState& gas, const SampleGrid& samples, const FlowPaths& paths, const PaddedGrid& old,
               Grid3<float>& result) {
  const bool cells = samples.axis == SampleGrid::cells;
  const VisibleSampler visible(gas.solid, samples.faces, old);
  const PathReader reader(paths, samples);
  forBlocks(result.size, Sampler(old, samples, Vec3f{}), [&](Sampler& sampler, Block& block) {
    float* values = &result(block.begin.x, block.begin.y, block.begin.z);
    runWide([&] {
      reader.read(block);
      sampler.at(block, values);
    });
    if (cells && !gas.solid.empty) seeAround(visible, block, values);
    const auto keep = [&](const auto& closed) {
      for (int n = 0; n < block.count; ++n)
        if (closed(block.begin.x + n)) values[n] = old.row(block.begin.y, block.begin.z)[block.begin.x + n];
    };
    if (cells && gas.solid.empty) return;
    if (cells)
      keep([&](int at) { return gas.solid.inside(at, block.begin.y, block.begin.z) != 0; });
    else
      keep(
          [&](int at) { return !(gas.solid.openShare.component(samples.axis)(at, block.begin.y, block.begin.z) > 0); });
  });
}

}  // namespace brisance
