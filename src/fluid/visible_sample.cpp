#include "fluid/visible_sample.h"

#include <cmath>

namespace brisance {

bool VisibleSampler::step(Vec3i& cell, int axis, bool forward) const {
  Vec3i face = cell;
  if (forward) ++face[axis];
  if (!(solid_.openShare.component(axis)(face.x, face.y, face.z) > 0)) return false;
  cell[axis] += forward ? 1 : -1;
  const int last = solid_.inside.size[axis] - 1;
  if (isPeriodic(faces_, axis)) cell[axis] = cell[axis] < 0 ? last : cell[axis] > last ? 0 : cell[axis];
  return true;
}

VisibleSampler::Place VisibleSampler::walk(const Vec3i& cell, const Vec3f& shift) const {
  Place place{cell, {0.5f, 0.5f, 0.5f}};
  for (int axis = 0; axis < 3; ++axis) {
    float left = 0.5f + shift[axis];
    while (left < 0 || left > 1) {
      const bool forward = left > 1;
      if (!step(place.cell, axis, forward)) {
        left = forward ? 1.0f : 0.0f;
        break;
      }
      left -= forward ? 1.0f : -1.0f;
      place.outside = !contains(place.cell);
      if (place.outside) return place;
    }
    place.share[axis] = left;
  }
  return place;
}

float VisibleSampler::mixAround(const Place& place) const {
  bool reached[8] = {true};
  Vec3i corner[8] = {place.cell};
  float sum = 0, weights = 0;
  for (int mask = 0; mask < 8; ++mask) {
    float weight = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const int bit = 1 << axis;
      const float away = std::abs(place.share[axis] - 0.5f);
      weight *= mask & bit ? away : 1 - away;
      if (!(mask & bit) || reached[mask] || !reached[mask ^ bit] || !contains(corner[mask ^ bit])) continue;
      corner[mask] = corner[mask ^ bit];
      reached[mask] = step(corner[mask], axis, place.share[axis] > 0.5f);
    }
    if (!reached[mask]) continue;
    sum += weight * (value(corner[mask]) - value(place.cell));
    weights += weight;
  }
  return value(place.cell) + sum / weights;
}

float VisibleSampler::at(const Vec3i& cell, const Vec3f& shift) const {
  const Place place = walk(cell, shift);
  return place.outside ? value(place.cell) : mixAround(place);
}

}  // namespace brisance
