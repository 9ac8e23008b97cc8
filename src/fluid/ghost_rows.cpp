#include "fluid/ghost_rows.h"

#include <algorithm>

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

}  // namespace

GhostRows::GhostRows(const Grid3<float>& samples, int along, float outer, const MacVelocity& velocity,
                     const Faces& faces)
    : samples_(samples), along_(along), outer_(outer), velocity_(velocity), faces_(faces), ends_{endOf(0), endOf(1)} {}

GhostRows::End GhostRows::endOf(int side) const {
  const std::int64_t last = samples_.size.x - 1, beyond = side ? last + 1 : -1;
  const bool periodic = faces_[side] == FaceKind::periodic;
  return {.source = periodic ? beyond + (side ? -period(0) : period(0)) : std::clamp<std::int64_t>(beyond, 0, last),
          .sign = reversedAt(side) ? -1.0f : 1.0f,
          .open = faces_[side] == FaceKind::open,
          .face = side ? velocity_.u.size.x - 1 : 0};
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

const float* GhostRows::rowBeyond(int j, int k, float* room) const {
  int place[2] = {j, k};
  const int axis = j < 0 || j >= samples_.size.y ? 1 : 2;
  int& at = place[axis - 1];
  const int face = 2 * axis + (at < 0 ? 0 : 1);
  if (faces_[face] == FaceKind::periodic) {
    at += at < 0 ? period(axis) : -period(axis);
    return &samples_(0, place[0], place[1]);
  }
  at = std::clamp(at, 0, samples_.size[axis] - 1);
  return madeRow(face, place[0], place[1], room);
}

}  // namespace brisance
