#include "rigid/closest_points.h"

#include <BulletCollision/CollisionShapes/btConvexInternalShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

namespace brisance {
namespace {

btVector3 toBullet(const Vec3d& v) { return {v.x, v.y, v.z}; }
Vec3d fromBullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// Points of ours as a shape of Bullet's, without a margin.
class HullOf : public btConvexInternalShape {
 public:
  explicit HullOf(std::span<const Vec3d> points) : points_(points) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    setMargin(0);
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const Vec3d along = fromBullet(direction);
    const Vec3d* farthest = &points_[0];
    double most = dot(*farthest, along);
    for (const Vec3d& p : points_)
      if (const double d = dot(p, along); d > most) most = d, farthest = &p;
    return toBullet(*farthest);
  }
  btVector3 localGetSupportingVertex(const btVector3& direction) const override {
    return localGetSupportingVertexWithoutMargin(direction);
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* farthest,
                                                         int count) const override {
    for (int n = 0; n < count; ++n) farthest[n] = localGetSupportingVertexWithoutMargin(directions[n]);
  }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "hull"; }

 private:
  std::span<const Vec3d> points_;
};

}  // namespace

std::optional<ClosestPoints> closestPoints(std::span<const Vec3d> a, std::span<const Vec3d> b) {
  HullOf hullA(a), hullB(b);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver overlap;
  btGjkPairDetector detector(&hullA, &hullB, &simplex, &overlap);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA.setIdentity();
  input.m_transformB.setIdentity();
  btPointCollector found;
  detector.getClosestPoints(input, found, nullptr);
  if (!found.m_hasResult) return std::nullopt;
  ClosestPoints closest;
  closest.normal = -fromBullet(found.m_normalOnBInWorld);
  closest.distance = found.m_distance;
  closest.onB = fromBullet(found.m_pointInWorld);
  closest.onA = closest.onB - closest.normal * closest.distance;
  if (!(std::abs(length(closest.normal) - 1) < 1e-6)) return std::nullopt;
  return closest;
}

}  // namespace brisance
