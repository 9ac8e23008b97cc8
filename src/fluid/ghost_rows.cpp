#include "fluid/ghost_rows.h"

#include <algorithm>

namespace brisance {

namespace {
/// The speed at which gas crosses a face of the box beside a sample, twice: of the two cells that a velocity component
/// along another axis lies between.
float crossing(const MacVelocity& velocity, int face, int along, Vec3i at) {
  const int axis = face / 2;
  const Grid3<float>& normal = velocity.component(axis);
  at[axis] = face % 2 ? normal.size[axis] - 1 : 0;
  Vec3i before = at;
  if (along >= 0 && along != axis) {
    before[along] = std::max(at[along] - 1, 0);
    at[along] = std::min(at[along], normal.size[along] - 1);
  }
  return normal(before.x, before.y, before.z) + normal(at.x, at.y, at.z);
}

bool comesIn(int face, float speed) { return face % 2 ? speed < 0 : speed > 0; }
}  // namespace

float GhostRows::end(int face, int j, int k) const {
  const int last = samples_.size.x - 1;
  if (faces_[face] == FaceKind::periodic) return samples_(face % 2 ? last + 1 - period(0) : period(0) - 1, j, k);
  const float inner = samples_(face % 2 ? last : 0, j, k);
  if (faces_[face] == FaceKind::open)
    return comesIn(face, crossing(velocity_, face, along_, {0, j, k})) ? outer_ : inner;
  return reversedAt(face) ? -inner : inner;
}

const float* GhostRows::madeRow(int face, int j, int k, float* room) const {
  const float* inner = &samples_(0, j, k);
  const int n = length();
  if (faces_[face] == FaceKind::open) {
    for (int i = 0; i < n; ++i)
      room[i] = comesIn(face, crossing(velocity_, face, along_, {i, j, k})) ? outer_ : inner[i];
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
  std::copy_n(&samples_(0, j, k), length(), copy);
  copy[-1] = end(0, j, k);
  copy[length()] = end(1, j, k);
  return copy;
}

}  // namespace brisance
