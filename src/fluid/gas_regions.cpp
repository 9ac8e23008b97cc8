#include "fluid/gas_regions.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"

namespace brisance {

namespace {
/// Cells of one row that hang together along x.
struct Run {
  int first, end;
  bool outside;  ///< an open face of the box bounds one of them
};

struct RowPlace {
  int j, k;
};

/// Legend: runs are numbered row by row; those of row r are first_[r] .. first_[r + 1].
class RegionSearch {
 public:
  RegionSearch(const Faces& faces, SolidStamp& stamp) : faces_(faces), stamp_(stamp), n_(stamp.inside.size) {}

  void run() {
    std::vector<std::vector<Run>> rows(static_cast<std::size_t>(n_.y) * n_.z);
    parallelFor(0, n_.z, 1, [&](std::int64_t first, std::int64_t last) {
      for (int k = static_cast<int>(first); k < last; ++k)
        for (int j = 0; j < n_.y; ++j) rows[rowNumber(j, k)] = runsOf({j, k});
    });
    first_.push_back(0);
    for (const auto& row : rows) {
      runs_.insert(runs_.end(), row.begin(), row.end());
      first_.push_back(static_cast<std::uint32_t>(runs_.size()));
    }
    DisjointSets sets(runs_.size());
    joinRuns(sets);
    number(sets);
  }

 private:
  std::size_t rowNumber(int j, int k) const { return j + static_cast<std::size_t>(n_.y) * k; }
  bool isOpenEnd(int face) const { return faces_[face] != FaceKind::periodic; }

  bool leavesBox(int i, RowPlace at) const {
    const MacVelocity& open = stamp_.openShare;
    return (at.j == 0 && isOpenEnd(2) && open.v(i, 0, at.k) > 0) ||
           (at.j == n_.y - 1 && isOpenEnd(3) && open.v(i, n_.y, at.k) > 0) ||
           (at.k == 0 && isOpenEnd(4) && open.w(i, at.j, 0) > 0) ||
           (at.k == n_.z - 1 && isOpenEnd(5) && open.w(i, at.j, n_.z) > 0);
  }

  std::vector<Run> runsOf(RowPlace at) const {
    const float* u = &stamp_.openShare.u(0, at.j, at.k);
    const std::uint8_t* inside = &stamp_.inside(0, at.j, at.k);
    const bool onBorder = at.j == 0 || at.k == 0 || at.j == n_.y - 1 || at.k == n_.z - 1;
    std::vector<Run> runs;
    for (int i = 0; i < n_.x; ++i) {
      if (inside[i]) continue;
      if (runs.empty() || runs.back().end != i || u[i] == 0) runs.push_back({i, i, false});
      Run& run = runs.back();
      run.end = i + 1;
      if (onBorder) run.outside = run.outside || leavesBox(i, at);
    }
    if (!runs.empty() && isOpenEnd(0) && runs.front().first == 0 && u[0] > 0) runs.front().outside = true;
    if (!runs.empty() && isOpenEnd(1) && runs.back().end == n_.x && u[n_.x] > 0) runs.back().outside = true;
    return runs;
  }

  /// Joins the runs of two rows where a face between them is open at all.
  void joinRows(std::size_t lower, std::size_t upper, const float* share, DisjointSets& sets) const {
    std::uint32_t a = first_[lower], b = first_[upper];
    while (a < first_[lower + 1] && b < first_[upper + 1]) {
      const int from = std::max(runs_[a].first, runs_[b].first), to = std::min(runs_[a].end, runs_[b].end);
      for (int i = from; i < to; ++i)
        if (share[i] > 0) {
          sets.join(a, b);
          break;
        }
      ++(runs_[a].end < runs_[b].end ? a : b);
    }
  }

  void joinRuns(DisjointSets& sets) const {
    const MacVelocity& open = stamp_.openShare;
    for (int k = 0; k < n_.z; ++k)
      for (int j = 0; j < n_.y; ++j) {
        const std::size_t row = rowNumber(j, k);
        const bool aroundY = j == 0 && faces_[2] == FaceKind::periodic;
        const bool aroundZ = k == 0 && faces_[4] == FaceKind::periodic;
        if (j > 0 || aroundY) joinRows(rowNumber(aroundY ? n_.y - 1 : j - 1, k), row, &open.v(0, j, k), sets);
        if (k > 0 || aroundZ) joinRows(rowNumber(j, aroundZ ? n_.z - 1 : k - 1), row, &open.w(0, j, k), sets);
        const bool both =
            first_[row] < first_[row + 1] && runs_[first_[row]].first == 0 && runs_[first_[row + 1] - 1].end == n_.x;
        if (both && faces_[0] == FaceKind::periodic && open.u(0, j, k) > 0) sets.join(first_[row], first_[row + 1] - 1);
      }
  }

  void number(DisjointSets& sets) {
    std::vector<std::int32_t> numbers(runs_.size(), -1);
    stamp_.sealed.clear();
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const std::uint32_t root = sets.root(r);
      if (root == r) {
        numbers[r] = static_cast<std::int32_t>(stamp_.sealed.size());
        stamp_.sealed.push_back(1);
      }
      numbers[r] = numbers[root];
      if (runs_[r].outside) stamp_.sealed[numbers[r]] = 0;
    }
    parallelFor(0, n_.z, 1, [&](std::int64_t firstPlane, std::int64_t lastPlane) {
      for (int k = static_cast<int>(firstPlane); k < lastPlane; ++k)
        for (int j = 0; j < n_.y; ++j) {
          std::int32_t* region = &stamp_.region(0, j, k);
          std::fill_n(region, n_.x, -1);
          for (std::uint32_t r = first_[rowNumber(j, k)]; r < first_[rowNumber(j, k) + 1]; ++r)
            std::fill(region + runs_[r].first, region + runs_[r].end, numbers[r]);
        }
    });
  }

  const Faces& faces_;
  SolidStamp& stamp_;
  Vec3i n_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> first_;
};
}  // namespace

void findRegions(const Faces& faces, SolidStamp& stamp) { RegionSearch(faces, stamp).run(); }

}  // namespace brisance
