#include "fluid/padded_grid.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {

namespace {
/// A row of one face's ghost layer, along the lower of the two other axes: ghost p lies at at[p * step], the sample
/// inside of it `inward` further, for begin <= p < end. The samples of the face are numbered from (0, 0).
struct GhostRow {
  float* at;
  std::int64_t step, inward;
  int begin, end;
};

/// Calls visit(row, q) for all rows of a face's ghosts. The ghosts of lower axes count as inner samples, -1 and the
/// last but one: so that edges and corners have values too.
template <class Visit>
void forGhostRows(Grid3<float>& padded, int face, const Visit& visit) {
  const int axis = face / 2, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const int layer = face % 2 ? padded.size[axis] - 1 : 0;
  const std::int64_t inward = face % 2 ? -padded.stride(axis) : padded.stride(axis), step = padded.stride(b);
  const int edgeB = b < axis ? 0 : 1, edgeC = c < axis ? 0 : 1;
  constexpr int rows = 32;  // fewer are not worth another thread
  parallelFor(edgeC, padded.size[c] - edgeC, rows, [&](std::int64_t first, std::int64_t last) {
    for (int q = static_cast<int>(first); q < last; ++q) {
      float* start = padded.values.data() + layer * padded.stride(axis) + q * padded.stride(c) + step;
      visit(GhostRow{start, step, inward, edgeB - 1, padded.size[b] - edgeB - 1}, q - 1);
    }
  });
}

/// Sets the ghosts begin <= p < end of a row to ghostOf(inner, p).
template <class GhostOf>
void setGhosts(const GhostRow& row, int begin, int end, const GhostOf& ghostOf) {
  float* at = row.at;
  const std::int64_t step = row.step, inward = row.inward;
  if (step == 1) {
#pragma GCC ivdep
    for (int p = begin; p < end; ++p) at[p] = ghostOf(at[p + inward], p);
  } else {
    for (int p = begin; p < end; ++p) at[p * step] = ghostOf(at[p * step + inward], p);
  }
}

/// Ghosts that follow from the sample inside alone.
template <class GhostOf>
void fillGhosts(PaddedGrid& padded, int face, const GhostOf& ghostOf) {
  forGhostRows(padded.values, face, [&](const GhostRow& row, int) {
    setGhosts(row, row.begin, row.end, [&](float inner, int) { return ghostOf(inner); });
  });
}
void copyToGhosts(PaddedGrid& padded, int face) {
  fillGhosts(padded, face, [](float inner) { return inner; });
}

/// Ghosts beyond a periodic face: the samples inside the opposite one. `shared`: the samples of both faces are one.
void wrap(Grid3<float>& padded, int face, bool shared) {
  const int axis = face / 2, samples = padded.size[axis] - 2;
  const std::int64_t around = (face % 2 ? -1 : 1) * padded.stride(axis) * (shared ? samples - 1 : samples);
  forGhostRows(padded, face, [&](const GhostRow& row, int) {
    for (int p = row.begin; p < row.end; ++p) row.at[p * row.step] = row.at[p * row.step + around];
  });
}

/// Whether gas comes in through a face of the box beside the samples of a scalar, or of the velocity component along
/// `staggered`, which lie between two cells and take the mean of their speeds.
class Inflow {
 public:
  Inflow(const MacVelocity& velocity, int face, int staggered = -1)
      : normal_(velocity.component(face / 2)),
        upper_(face % 2),
        b_(face / 2 == 0 ? 1 : 0),
        c_(face / 2 == 2 ? 1 : 2),
        backP_(staggered == b_ ? 1 : 0),
        backQ_(staggered == c_ ? 1 : 0),
        layer_(upper_ ? (normal_.size[face / 2] - 1) * normal_.stride(face / 2) : 0) {}

  /// Ghosts of row q: `outer` where gas comes in, else as inside.
  void setRow(const GhostRow& row, int q, float outer) const {
    const float *before = cells(q - backQ_), *here = cells(q);
    const int count = normal_.size[b_];
    const std::int64_t step = normal_.stride(b_);
    const auto edge = [&](float inner, int p) {
      const auto at = [&](int n) { return step * std::clamp(n, 0, count - 1); };
      return chosen(before[at(p - backP_)] + here[at(p)], inner, outer);
    };
    const int inside = std::min(1, row.end), outside = std::max(inside, std::min(row.end, count));
    setGhosts(row, row.begin, inside, edge);
    setGhosts(row, inside, outside, [=, this, back = step * backP_](float inner, int p) {
      return chosen(before[p * step - back] + here[p * step], inner, outer);
    });
    setGhosts(row, outside, row.end, edge);
  }

 private:
  float chosen(float speed, float inner, float outer) const { return (upper_ ? -speed : speed) > 0 ? outer : inner; }
  const float* cells(int q) const {
    return normal_.values.data() + layer_ + std::clamp(q, 0, normal_.size[c_] - 1) * normal_.stride(c_);
  }
  const Grid3<float>& normal_;
  bool upper_;
  int b_, c_, backP_, backQ_;
  std::int64_t layer_;
};

void fillOpenGhosts(PaddedGrid& padded, int face, const Inflow& inflow, float outer) {
  forGhostRows(padded.values, face, [&](const GhostRow& row, int q) { inflow.setRow(row, q, outer); });
}
}  // namespace

void resizePadded(PaddedGrid& padded, const Grid3<float>& source) {
  const Vec3i size{source.size.x + 2, source.size.y + 2, source.size.z + 2};
  if (!(padded.values.size == size))
    padded.values = Grid3<float>(size, source.origin - Vec3d(1, 1, 1) * source.cellSize, source.cellSize);
}

void copyInside(PaddedGrid& padded, const Grid3<float>& source) {
  resizePadded(padded, source);
  parallelFor(0, source.size.z, 4, [&](std::int64_t first, std::int64_t last) {
    for (int k = static_cast<int>(first); k < last; ++k)
      for (int j = 0; j < source.size.y; ++j)
        std::copy_n(source.values.data() + source.index(0, j, k), source.size.x, padded.row(j, k));
  });
}

void fillSpeedGhosts(PaddedGrid& padded, int axis, const MacVelocity& velocity, const FluidSettings& settings) {
  for (int face = 0; face < 6; ++face) {
    const FaceKind kind = settings.faces[face];
    if (kind == FaceKind::periodic) {
      wrap(padded.values, face, face / 2 == axis);
    } else if (kind == FaceKind::open) {
      fillOpenGhosts(padded, face, Inflow(velocity, face, axis), static_cast<float>(settings.wind[axis]));
    } else if (face / 2 != axis && kind == FaceKind::noSlip) {
      const float twice = static_cast<float>(2 * settings.wallVelocity[face][axis]);
      fillGhosts(padded, face, [=](float inner) { return twice - inner; });
    } else {
      copyToGhosts(padded, face);
    }
  }
}

void fillScalarGhosts(PaddedGrid& padded, const MacVelocity& velocity, const Faces& faces, float ambient) {
  for (int face = 2; face < 6; ++face) {
    if (faces[face] == FaceKind::periodic)
      wrap(padded.values, face, false);
    else if (faces[face] == FaceKind::open)
      fillOpenGhosts(padded, face, Inflow(velocity, face), ambient);
    else
      copyToGhosts(padded, face);
  }
}

void fillPressureGhosts(PaddedGrid& padded, const Faces& faces) {
  for (int face = 0; face < 6; ++face) {
    const float factor = faces[face] == FaceKind::open ? -1.0f : 1.0f;
    if (faces[face] == FaceKind::periodic)
      wrap(padded.values, face, false);
    else
      fillGhosts(padded, face, [=](float inner) { return factor * inner; });
  }
}

void PaddedVelocity::fill(const MacVelocity& velocity, const FluidSettings& settings) {
  for (int axis = 0; axis < 3; ++axis) {
    copyInside(component[axis], velocity.component(axis));
    fillSpeedGhosts(component[axis], axis, velocity, settings);
  }
}

}  // namespace brisance
