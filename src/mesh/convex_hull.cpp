#include "mesh/convex_hull.h"

#include <cstdio>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace brisance {
namespace {

/// Qhull's state; its messages go nowhere.
class Hull {
 public:
  Hull() : silence_(std::fopen("/dev/null", "w")) { qh_zero(&qh_, silence_); }
  ~Hull() {
    qh_.NOerrexit = True;
    qh_freeqhull(&qh_, !qh_ALL);
    int current = 0, total = 0;
    qh_memfreeshort(&qh_, &current, &total);
    if (silence_) std::fclose(silence_);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// False if Qhull gave up. It never ends the program: errors return through its own jump.
  bool build(std::vector<double>& coordinates, const char* options) {
    return qh_new_qhull(&qh_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(), False,
                        const_cast<char*>(options), silence_, silence_) == 0;
  }

  /// Corners of the facets by their point's number, counter-clockwise from outside.
  std::vector<Triangle> facets() {
    std::vector<Triangle> result;
    qhT* qh = &qh_;  // the macros below want this name
    facetT* facet = nullptr;
    FORALLfacets {
      setT* vertices = qh_facet3vertex(qh, facet);
      vertexT *vertex = nullptr, **vertexp = nullptr;
      Triangle triangle{};
      std::size_t n = 0;
      FOREACHvertex_(vertices) {
        if (n < 3) triangle[n] = static_cast<std::uint32_t>(qh_pointid(qh, vertex->point));
        ++n;
      }
      qh_settempfree(qh, &vertices);
      result.push_back({triangle[0], triangle[2], triangle[1]});  // Qhull's face inwards
    }
    return result;
  }

 private:
  std::FILE* silence_;
  qhT qh_;
};

/// About the middle of their box, and of size one.
std::vector<double> scaled(const std::vector<Vec3d>& points, const Box3& box) {
  const Vec3d middle = (box.lower + box.upper) * 0.5, size = box.size();
  const double largest = std::max({size.x, size.y, size.z});
  std::vector<double> coordinates;
  for (const Vec3d& p : points)
    for (int axis = 0; axis < 3; ++axis) coordinates.push_back((p[axis] - middle[axis]) / largest);
  return coordinates;
}

/// The points that the triangles use, and no others.
TriangleMesh meshOf(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
  TriangleMesh mesh;
  constexpr std::uint32_t unused = 0xFFFFFFFFu;
  std::vector<std::uint32_t> numberOf(points.size(), unused);
  for (Triangle t : triangles) {
    for (std::uint32_t& corner : t) {
      if (numberOf[corner] == unused) {
        numberOf[corner] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(points[corner]);
      }
      corner = numberOf[corner];
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// The points' box: for fewer than four points, and where Qhull fails.
TriangleMesh boxHull(const Box3& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back({corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                             corner & 4 ? box.upper.z : box.lower.z});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace

TriangleMesh convexHull(const std::vector<Vec3d>& points) {
  Box3 box;
  for (const Vec3d& p : points) box.include(p);
  const Vec3d size = box.size();
  if (points.empty() || !(std::max({size.x, size.y, size.z}) > 0)) return {};
  std::vector<double> coordinates = scaled(points, box);
  if (points.size() >= 4) {
    Hull hull;
    // QJ moves points a little until every facet is a triangle: no merged facets, no flat simplex.
    if (hull.build(coordinates, "qhull QJ Pp")) return meshOf(points, hull.facets());
  }
  return boxHull(box);
}

}  // namespace brisance
