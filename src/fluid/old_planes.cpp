#include "fluid/old_planes.h"

#include "base/parallel.h"

namespace brisance {

void OldPlanes::keep(const FluidState& gas, const Slabs& slabs, const ChangingSpans& spans, bool periodic) {
  const Vec3i cells = gas.temperature.size;
  meetings_ = slabs.count(), rows_ = cells.y, width_ = cells.x, periodic_ = periodic;
  floats_.resize(index(meetings_, 0, 0, 0));
  const Grid3<float>* fields[scalarFields] = {&gas.temperature, &gas.soot, &gas.flame};
  parallelFor(periodic ? 0 : 1, meetings_, 1, [&](std::int64_t first, std::int64_t last) {
    for (int meeting = static_cast<int>(first); meeting < last; ++meeting) {
      const int above = slabs[meeting].first, below = (above > 0 ? above : cells.z) - 1;
      for (int j = 0; j < cells.y; ++j) {
        RowSpan span = spans.at(j, below);
        span.join(spans.at(j, above));
        if (span.empty()) continue;
        for (int field = 0; field < scalarFields; ++field)
          for (const int side : {0, 1})
            std::copy_n(&(*fields[field])(span.first, j, side ? above : below), span.end - span.first,
                        &floats_[index(meeting, field, side, j) + span.first]);
      }
    }
  });
}

}  // namespace brisance
