#include "fluid/padded_grid.h"

#include <algorithm>

#include "base/parallel.h"

namespace brisance {

namespace {
/// Calls at(ghost, inner, a, b) for each sample of one face's ghost layer; (a, b) number the samples of the face along
/// the two other axes, the lower axis first. The ghosts of lower axes count as inner samples, -1 and the last but one:
/// so that edges and corners have values too.
template <class At>
void forGhosts(Grid3<float>& padded, int face, const At& at) {
  const int axis = face / 2, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  const int layer = face % 2 ? padded.size[axis] - 1 : 0;
  const std::int64_t inward = face % 2 ? -padded.stride(axis) : padded.stride(axis);
  const int edgeB = b < axis ? 0 : 1, edgeC = c < axis ? 0 : 1;
  constexpr int rows = 32;  // fewer are not worth another thread
  parallelFor(edgeC, padded.size[c] - edgeC, rows, [&](std::int64_t first, std::int64_t last) {
    for (int q = static_cast<int>(first); q < last; ++q)
      for (int p = edgeB; p < padded.size[b] - edgeB; ++p) {
        const std::int64_t ghost = layer * padded.stride(axis) + p * padded.stride(b) + q * padded.stride(c);
        at(padded.values[ghost], padded.values[ghost + inward], p - 1, q - 1);
      }
  });
}

/// Ghosts beyond a periodic face: the samples inside the opposite one. `shared`: the samples of both faces are one.
void wrap(Grid3<float>& padded, int face, bool shared) {
  const int axis = face / 2, samples = padded.size[axis] - 2;
  const std::int64_t around = (face % 2 ? -1 : 1) * padded.stride(axis) * (shared ? samples - 1 : samples);
  forGhosts(padded, face, [&](float& ghost, float, int, int) { ghost = *(&ghost + around); });
}

/// Whether gas comes in through a face of the box beside a sample (p, q) of a scalar, or of the velocity component
/// along `staggered`, which lies between two cells and takes the mean of their speeds.
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
  bool at(int p, int q) const {
    const float speed = cell(p - backP_, q - backQ_) + cell(p, q);
    return upper_ ? speed < 0 : speed > 0;
  }

 private:
  float cell(int p, int q) const {
    const int pp = std::clamp(p, 0, normal_.size[b_] - 1), qq = std::clamp(q, 0, normal_.size[c_] - 1);
    return normal_.values[layer_ + pp * normal_.stride(b_) + qq * normal_.stride(c_)];
  }
  const Grid3<float>& normal_;
  bool upper_;
  int b_, c_, backP_, backQ_;
  std::int64_t layer_;
};
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
      const Inflow inflow(velocity, face, axis);
      const float outer = static_cast<float>(settings.wind[axis]);
      forGhosts(padded.values, face,
                [&](float& ghost, float inner, int p, int q) { ghost = inflow.at(p, q) ? outer : inner; });
    } else if (face / 2 != axis && kind == FaceKind::noSlip) {
      const float twice = static_cast<float>(2 * settings.wallVelocity[face][axis]);
      forGhosts(padded.values, face, [&](float& ghost, float inner, int, int) { ghost = twice - inner; });
    } else {
      forGhosts(padded.values, face, [&](float& ghost, float inner, int, int) { ghost = inner; });
    }
  }
}

void fillScalarGhosts(PaddedGrid& padded, const MacVelocity& velocity, const Faces& faces, float ambient) {
  for (int face = 0; face < 6; ++face) {
    if (faces[face] == FaceKind::periodic) {
      wrap(padded.values, face, false);
      continue;
    }
    if (faces[face] == FaceKind::open) {
      const Inflow inflow(velocity, face);
      forGhosts(padded.values, face,
                [&](float& ghost, float inner, int p, int q) { ghost = inflow.at(p, q) ? ambient : inner; });
    } else {
      forGhosts(padded.values, face, [&](float& ghost, float inner, int, int) { ghost = inner; });
    }
  }
}

void fillPressureGhosts(PaddedGrid& padded, const Faces& faces) {
  for (int face = 0; face < 6; ++face) {
    const float factor = faces[face] == FaceKind::open ? -1.0f : 1.0f;
    if (faces[face] == FaceKind::periodic)
      wrap(padded.values, face, false);
    else
      forGhosts(padded.values, face, [&](float& ghost, float inner, int, int) { ghost = factor * inner; });
  }
}

void PaddedVelocity::fill(const MacVelocity& velocity, const FluidSettings& settings) {
  for (int axis = 0; axis < 3; ++axis) {
    copyInside(component[axis], velocity.component(axis));
    fillSpeedGhosts(component[axis], axis, velocity, settings);
  }
}

void padScalar(PaddedGrid& padded, const Grid3<float>& scalar, const MacVelocity& velocity, const Faces& faces,
               float ambient) {
  copyInside(padded, scalar);
  fillScalarGhosts(padded, velocity, faces, ambient);
}

}  // namespace brisance
