#include "fluid/ghost_rows.h"

#include <algorithm>
#include <cstring>

#include "base/vector_path.h"

namespace brisance {

namespace {
/// Speeds at a face of the box in two rows of cells, whose sums are twice those at which gas crosses it beside samples:
/// a velocity component along another axis lies between two cells.
struct Crossing {
  const float *before, *at;
  int shift, last;  ///< samples along x lie between cells i - shift and i, of which `last` is the last
  float operator()(int i) const { return before[std::max(i - shift, 0)] + at[std::min(i, last)]; }
};

/// `place` of a sample, of which the place along the face's own axis does not matter, nor i.
Crossing crossingAt(const MacVelocity& velocity, int face, int along, Vec3i place) {
  const int axis = face / 2;
  const Grid3<float>& normal = velocity.component(axis);
  place.x = 0;
  place[axis] = face % 2 ? normal.size[axis] - 1 : 0;
  Vec3i before = place;
  if (along > 0 && along != axis) {
    before[along] = std::max(place[along] - 1, 0);
    place[along] = std::min(place[along], normal.size[along] - 1);
  }
  return {&normal(before.x, before.y, before.z), &normal(place.x, place.y, place.z), along == 0 && axis != 0 ? 1 : 0,
          normal.size.x - 1};
}

/// A few cache lines: calling the library for them takes longer than copying.
void copyRow(const float* from, int count, float* to) {
  constexpr int line = 16;
  runWide([&] {
    int i = 0;
    for (; i + line <= count; i += line) std::memcpy(to + i, from + i, line * sizeof(float));
    for (; i < count; ++i) to[i] = from[i];
  });
}

bool comesIn(int face, float speed) { return face % 2 ? speed < 0 : speed > 0; }
}  // namespace

float GhostRows::end(int face, int j, int k) const {
  const int last = samples_.size.x - 1;
  if (faces_[face] == FaceKind::periodic) return samples_(face % 2 ? last + 1 - period(0) : period(0) - 1, j, k);
  const float inner = samples_(face % 2 ? last : 0, j, k);
  if (faces_[face] == FaceKind::open)
    return comesIn(face, crossingAt(velocity_, face, along_, {0, j, k})(0)) ? outer_ : inner;
  return reversedAt(face) ? -inner : inner;
}

const float* GhostRows::madeRow(int face, int j, int k, float* room) const {
  const float* inner = &samples_(0, j, k);
  const int n = length();
  if (faces_[face] == FaceKind::open) {
    const Crossing speed = crossingAt(velocity_, face, along_, {0, j, k});
    const float sign = face % 2 ? -1.0f : 1.0f;
    const auto ghost = [&](int i, float crossing) { room[i] = sign * crossing > 0 ? outer_ : inner[i]; };
    ghost(0, speed(0));
    runWide([&] {
      for (int i = 1; i < n - 1; ++i) ghost(i, speed.before[i - speed.shift] + speed.at[i]);
    });
    ghost(n - 1, speed(n - 1));
    return room;
  }
  if (!reversedAt(face)) return inner;
  for (int i = 0; i < n; ++i) room[i] = -inner[i];
  return room;
}

const float* GhostRows::row(int j, int k, float* room) const {
  int place[2] = {j, k};
  for (const int axis : {1, 2}) {
    int& at = place[axis - 1];
    const int count = samples_.size[axis];
    if (at >= 0 && at < count) continue;
    const int face = 2 * axis + (at < 0 ? 0 : 1);
    const bool around = faces_[face] == FaceKind::periodic;
    at = around ? at + (at < 0 ? period(axis) : -period(axis)) : std::clamp(at, 0, count - 1);
    return around ? &samples_(0, place[0], place[1]) : madeRow(face, place[0], place[1], room);
  }
  return &samples_(0, j, k);
}

const float* GhostRows::withEnds(int j, int k, float* room) const {
  float* copy = room + 1;
  copyRow(&samples_(0, j, k), length(), copy);
  copy[-1] = end(0, j, k);
  copy[length()] = end(1, j, k);
  return copy;
}

}  // namespace brisance
