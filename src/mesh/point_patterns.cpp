#include "mesh/point_patterns.h"

namespace brisance {
namespace {

double extentOf(const Box3& box) { return std::max(box.size().x, box.size().y); }

/// Points of the outline's bounding box, one for each number from 0.
class Darts {
 public:
  Darts(const PaneArea& pane, const Random& random)
      : box_(polygonBounds(pane.corners)), inside_(pane.corners, borderMargin * extentOf(box_)), random_(random) {}

  /// The next that lies inside the outline.
  Vec2d next() {
    for (;; draw_ += 2) {
      const Vec2d p{box_.lower.x + box_.size().x * random_.uniform(draw_),
                    box_.lower.y + box_.size().y * random_.uniform(draw_ + 1)};
      if (!inside_.contains(p)) continue;
      draw_ += 2;
      return p;
    }
  }

 private:
  Box3 box_;
  PolygonInside inside_;
  const Random& random_;
  std::uint64_t draw_ = 0;
};

/// Points in square cells as wide as the largest distance that is asked for.
class CellsOfPoints {
 public:
  CellsOfPoints(const Box3& box, double width)
      : lower_(box.lower), width_(width), columns_(index(box.upper.x - lower_.x) + 1) {
    heads_.assign(columns_ * (index(box.upper.y - lower_.y) + 1), none);
  }
  void add(const Vec2d& p) {
    std::uint32_t& head = heads_[index(p.y - lower_.y) * columns_ + index(p.x - lower_.x)];
    points_.push_back({p, head});
    head = static_cast<std::uint32_t>(points_.size() - 1);
  }
  /// Whether no point lies within `distance`, at most the cells' width.
  bool isFree(const Vec2d& p, double distance) const {
    const std::size_t column = index(p.x - lower_.x), row = index(p.y - lower_.y), rows = heads_.size() / columns_;
    for (std::size_t y = row - (row > 0); y <= std::min(row + 1, rows - 1); ++y)
      for (std::size_t x = column - (column > 0); x <= std::min(column + 1, columns_ - 1); ++x)
        for (std::uint32_t i = heads_[y * columns_ + x]; i != none; i = points_[i].next) {
          const Vec2d gap = points_[i].place - p;
          if (gap.x * gap.x + gap.y * gap.y < distance * distance) return false;
        }
    return true;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFu;
  struct Listed {
    Vec2d place;
    std::uint32_t next;
  };
  std::size_t index(double offset) const { return static_cast<std::size_t>(std::max(0.0, offset / width_)); }

  Vec3d lower_;
  double width_;
  std::size_t columns_;
  std::vector<std::uint32_t> heads_;
  std::vector<Listed> points_;
};

/// One point near the middle of each of equal lengths of every edge; `freedom` says how near.
std::vector<BorderPoint> evenBorder(const PaneArea& pane, double freedom, const Random& random) {
  std::vector<BorderPoint> border;
  std::uint64_t draw = borderDraws;
  for (std::size_t edge = 0; edge < pane.corners.size(); ++edge) {
    const Vec2d side = pane.corners[(edge + 1) % pane.corners.size()] - pane.corners[edge];
    const double length = std::sqrt(side.x * side.x + side.y * side.y);
    const auto parts = std::max<std::int64_t>(1, std::lround(length / pane.spacing));
    for (std::int64_t i = 1; i < parts; ++i, ++draw)
      border.push_back(
          {edge, (static_cast<double>(i) + freedom * (random.uniform(draw) - 0.5)) / static_cast<double>(parts)});
  }
  return border;
}

}  // namespace

std::vector<Vec2d> pointsInside(const PaneArea& pane, const UniformPoints&, const Random& random,
                                const std::vector<Vec2d>&) {
  Darts darts(pane, random);
  std::vector<Vec2d> points;
  points.reserve(std::max(0, pane.count));
  for (int i = 0; i < pane.count; ++i) points.push_back(darts.next());
  return points;
}

std::vector<Vec2d> pointsInside(const PaneArea& pane, const BlueNoisePoints&, const Random& random,
                                const std::vector<Vec2d>& border) {
  if (pane.count < 1) return {};
  constexpr double firstRadius = 0.9;  // of the spacing: few more than half of the points find room at it
  constexpr double shrink = 0.97;      // after so many misses in a row:
  constexpr int patience = 100;
  double radius = firstRadius * pane.spacing;
  CellsOfPoints cells(polygonBounds(pane.corners), radius);
  for (const Vec2d& p : border) cells.add(p);
  Darts darts(pane, random);
  std::vector<Vec2d> points;
  for (int misses = 0; points.size() < static_cast<std::size_t>(pane.count);) {
    const Vec2d p = darts.next();
    if (cells.isFree(p, radius)) {
      cells.add(p);
      points.push_back(p);
      misses = 0;
    } else if (++misses == patience) {
      radius *= shrink;
      misses = 0;
    }
  }
  return points;
}

std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const UniformPoints&, const Random& random) {
  constexpr double freedom = 0.8;  // shards' outer edges vary in length
  return evenBorder(pane, freedom, random);
}
std::vector<BorderPoint> pointsOnBorder(const PaneArea& pane, const BlueNoisePoints&, const Random& random) {
  constexpr double freedom = 0.2;
  return evenBorder(pane, freedom, random);
}

}  // namespace brisance
