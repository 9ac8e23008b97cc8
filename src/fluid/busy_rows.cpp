#include "fluid/busy_rows.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/row_lines.h"
#include "base/vector_path.h"

namespace brisance {

void BusyRows::take(const Vec3i& cells) {
  cells_ = cells;
  all_ = true;
}

void BusyRows::find(const Grid3<float>& scalar, float usual, const Faces& faces) {
  cells_ = scalar.size;
  std::vector<std::uint8_t>& busy = near_[0];
  busy.resize(index(0, cells_.z));
  parallelFor(0, std::ssize(busy), 64, [&](std::int64_t first, std::int64_t last) {
    runWide([&] {
      for (std::int64_t row = first; row < last; ++row)
        busy[row] = anyOther(&scalar.values[row * cells_.x], cells_.x, usual) ? 1 : 0;
    });
  });
  for (int rows = 1; rows <= farthest; ++rows) widen(rows, faces);
  const std::vector<std::uint8_t>& far = near_[farthest];
  all_ = 2 * std::count(far.begin(), far.end(), 1) > std::ssize(far);
}

void BusyRows::widen(int rows, const Faces& faces) {
  const std::vector<std::uint8_t>& from = near_[rows - 1];
  std::vector<std::uint8_t>& to = near_[rows];
  to = from;
  const auto spread = [&](int axis, int row, int j, int k) {
    const int size = cells_[axis];
    if (isPeriodic(faces, axis)) row = (row + size) % size;
    if (row >= 0 && row < size) to[axis == 1 ? index(row, k) : index(j, row)] = 1;
  };
  for (int k = 0; k < cells_.z; ++k)
    for (int j = 0; j < cells_.y; ++j)
      if (from[index(j, k)])
        for (const int step : {-1, 1}) {
          spread(1, j + step, j, k);
          spread(2, k + step, j, k);
        }
}

}  // namespace brisance
