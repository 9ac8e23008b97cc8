#include "fluid/box_poisson.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/vector_path.h"
#include "fluid/tile_transpose.h"

namespace brisance {

namespace {
constexpr int lanes = LineTransform::lanes;

std::vector<float> eigenvalues(AxisEnds ends, int n) {
  std::vector<float> values(n);
  for (int k = 0; k < n; ++k) values[k] = static_cast<float>(modeEigenvalue(ends, n, k));
  return values;
}

bool hasConstantMode(AxisEnds ends) { return ends == AxisEnds::walls || ends == AxisEnds::periodic; }

/// Scratch of one thread: 16 lines of the longest axis, twice.
struct LineScratch {
  AlignedFloats lines, work;
  explicit LineScratch(const CellLayout& layout)
      : lines(longest(layout) * lanes, 0.0f), work(longest(layout) * lanes, 0.0f) {}
  static std::size_t longest(const CellLayout& layout) {
    return static_cast<std::size_t>(std::max(layout.roundedRow(), layout.cells.y));
  }
};
}  // namespace

BoxPoisson::BoxPoisson(const Vec3i& cells, const Faces& faces)
    : layout_(cells),
      faces_(faces),
      x_(axisEnds(faces[0], faces[1]), cells.x),
      y_(axisEnds(faces[2], faces[3]), cells.y),
      z_(axisEnds(faces[4], faces[5]), cells.z),
      eigenvalueX_(layout_.roundedRow(), 1.0f),
      eigenvalueY_(eigenvalues(axisEnds(faces[2], faces[3]), cells.y)) {
  const std::vector<float> alongX = eigenvalues(axisEnds(faces[0], faces[1]), cells.x);
  std::copy(alongX.begin(), alongX.end(), eigenvalueX_.begin());
  singular_ = true;
  for (int axis = 0; axis < 3; ++axis)
    singular_ = singular_ && hasConstantMode(axisEnds(faces[lowerFaceOf(axis)], faces[upperFaceOf(axis)]));
}

/// Modes of x and y of one plane, in the processor's own cache.
void BoxPoisson::toModes(float* plane, const std::uint8_t* tiles, float* lines, float* work) const {
  for (int j = 0; j < layout_.cells.y; j += lanes) {
    if (tiles && !tiles[j / lanes]) continue;
    const int rows = std::min(lanes, layout_.cells.y - j);
    float* row = plane + j * layout_.row;
    rowsToLines(row, layout_.row, rows, layout_.roundedRow(), lines);
    x_.forward({lines, lanes}, {lines, lanes}, work);
    linesToRows(lines, layout_.roundedRow(), row, layout_.row, rows);
  }
  for (int i = 0; i < layout_.cells.x; i += lanes)
    y_.forward({plane + i, layout_.row, true}, {plane + i, layout_.row}, work);
}

void BoxPoisson::fromModes(float* plane, const std::uint8_t* tiles, float* lines, float* work) const {
  for (int i = 0; i < layout_.cells.x; i += lanes)
    y_.inverse({plane + i, layout_.row, true}, {plane + i, layout_.row}, work);
  for (int j = 0; j < layout_.cells.y; j += lanes) {
    if (tiles && !tiles[j / lanes]) continue;
    const int rows = std::min(lanes, layout_.cells.y - j);
    float* row = plane + j * layout_.row;
    rowsToLines(row, layout_.row, rows, layout_.roundedRow(), lines);
    x_.inverse({lines, lanes}, {lines, lanes}, work);
    linesToRows(lines, layout_.roundedRow(), row, layout_.row, rows);
  }
}

/// Along z; divided by the n of the two inverse transforms.
void BoxPoisson::solveAlongZ(CellField& field, const std::uint8_t* planes) const {
  const Vec3i n = layout_.cells;
  const float scale = static_cast<float>(1.0 / (double(n.x) * n.y));
  parallelFor(0, n.y, 1, [&](std::int64_t first, std::int64_t last) {
    thread_local LineElimination::Scratch scratch;
    AlignedFloats lambda(layout_.roundedRow());
    for (int j = static_cast<int>(first); j < last; ++j) {
      for (int i = 0; i < layout_.roundedRow(); ++i) lambda[i] = eigenvalueX_[i] + eigenvalueY_[j];
      z_.solve({&field(0, j, 0), layout_.plane, planes},
               {lambda.data(), scale, layout_.roundedRow(), singular_ && j == 0}, scratch);
    }
  });
}

void BoxPoisson::solve(CellField& field) const {
  solve(field, [](int, float*) {});
}

void BoxPoisson::solve(CellField& field, const Fill& fill) const {
  const auto sweep = [&](const auto& work) {
    parallelFor(0, layout_.cells.z, 1, [&](std::int64_t first, std::int64_t last) {
      LineScratch scratch(layout_);
      for (int k = static_cast<int>(first); k < last; ++k) work(k, field.row(0, k), scratch);
    });
  };
  sweep([&](int k, float* plane, LineScratch& scratch) {
    fill(k, plane);
    toModes(plane, nullptr, scratch.lines.data(), scratch.work.data());
  });
  solveAlongZ(field, nullptr);
  sweep([&](int, float* plane, LineScratch& scratch) {
    fromModes(plane, nullptr, scratch.lines.data(), scratch.work.data());
  });
}

void BoxPoisson::solve(CellField& field, const SparseRegion& region, const Fill& fill) const {
  const auto sweep = [&](auto work) {
    parallelFor(0, layout_.cells.z, 1, [&](std::int64_t first, std::int64_t last) {
      LineScratch scratch(layout_);
      for (int k = static_cast<int>(first); k < last; ++k)
        if (region.planes[k]) work(k, field.row(0, k), region.tiles.data() + k * tilesPerPlane(), scratch);
    });
  };
  sweep([&](int k, float* plane, const std::uint8_t* tiles, LineScratch& scratch) {
    std::fill_n(plane, layout_.row * (layout_.cells.y - 1) + layout_.roundedRow(), 0.0f);
    fill(k, plane);
    toModes(plane, tiles, scratch.lines.data(), scratch.work.data());
  });
  solveAlongZ(field, region.planes.data());
  sweep([&](int, float* plane, const std::uint8_t* tiles, LineScratch& scratch) {
    fromModes(plane, tiles, scratch.lines.data(), scratch.work.data());
  });
}

}  // namespace brisance
