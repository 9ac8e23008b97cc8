#include "render/scene_geometry.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "render/dielectric.h"
#include "render/drawn_bodies.h"

namespace brisance {

namespace {

/// Of the largest coordinate: some sixteen steps of a float, the error of a hit's place.
constexpr float relativeResolution = 2e-6f;
constexpr float smallestResolution = 1e-7f;  // [m]

float placeVertices(RTCGeometry geometry, unsigned slot, const TriangleMesh& mesh, const Pose& pose) {
  auto* to = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, slot, RTC_FORMAT_FLOAT3,
                                                         3 * sizeof(float), mesh.vertices.size()));
  if (!to) throw Error(ExitCode::noRoom, "not enough memory for the picture's triangles");
  const Mat3 rotation = rotationMatrix(pose.orientation);
  float largest = 0;
  for (const Vec3d& vertex : mesh.vertices) {
    const Vec3f place(rotation * vertex + pose.position);
    for (int axis = 0; axis < 3; ++axis) {
      *to++ = place[axis];
      largest = std::max(largest, std::abs(place[axis]));
    }
  }
  return largest;
}

void placeTriangles(RTCGeometry geometry, const TriangleMesh& mesh) {
  static_assert(sizeof(Triangle) == 3 * sizeof(unsigned));
  auto* to = static_cast<Triangle*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                            sizeof(Triangle), mesh.triangles.size()));
  if (!to) throw Error(ExitCode::noRoom, "not enough memory for the picture's triangles");
  std::copy(mesh.triangles.begin(), mesh.triangles.end(), to);
}

RTCRayHit rayHit(const Ray& ray, float far) {
  RTCRayHit query{};
  query.ray = {ray.origin.x,
               ray.origin.y,
               ray.origin.z,
               ray.near,
               ray.direction.x,
               ray.direction.y,
               ray.direction.z,
               ray.time,
               far,
               ~0u,
               0,
               0};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return query;
}

/// What a ray has passed on its way to a light.
struct GlassPassed {
  Vec3f passing{1, 1, 1};
  Vec3f opticalDepth{};  ///< sum of absorption times way inside: leaving distances minus entering ones
  /// A ray through an edge may miss one of two surfaces: glass never adds light for that.
  Vec3f light() const {
    if (opticalDepth == Vec3f{}) return passing;
    return passing * beerTransmittance(max(opticalDepth, Vec3f{}), 1);
  }
};

/// Embree hands its context to the filter; ours begins with it.
struct ShadowQuery {
  RTCIntersectContext context;
  const DrawnBodies& bodies;
  GlassShade glass;
  GlassPassed passed[SceneGeometry::packet]{};  ///< by the rays' ids
};

bool isLeaving(const RTCRay& ray, const RTCHit& hit) {
  return dot(Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z), Vec3f(ray.dir_x, ray.dir_y, ray.dir_z)) > 0;
}

bool passesGlass(ShadowQuery& shadow, const RTCRay& ray, const RTCHit& hit) {
  const Material& material = shadow.bodies.settings(hit.geomID, hit.primID);
  const bool passable = material.glass && shadow.glass == GlassShade::passes;
  if (material.castsShadow && !passable) return false;
  if (!material.castsShadow) return true;
  GlassPassed& passed = shadow.passed[ray.id];
  passed.passing *= 1 - fresnelReflectance(1, static_cast<float>(1 / material.refractiveIndex));
  passed.opticalDepth += material.absorption * (isLeaving(ray, hit) ? ray.tfar : -ray.tfar);
  return true;
}

/// What remains valid is a hit: there the light is blocked.
void passGlass(const RTCFilterFunctionNArguments* query) {
  auto& shadow = *reinterpret_cast<ShadowQuery*>(query->context);
  for (unsigned n = 0; n < query->N; ++n)
    if (query->valid[n] &&
        passesGlass(shadow, rtcGetRayFromRayN(query->ray, query->N, n), rtcGetHitFromHitN(query->hit, query->N, n)))
      query->valid[n] = 0;
}

/// Looks for the other surface of a touching pair.
struct TouchQuery {
  RTCIntersectContext context;
  const DrawnBodies& bodies;
  const SurfaceHit& first;
  bool leaving;  ///< the first surface is hit from inside
};

void findCounterpart(const RTCFilterFunctionNArguments* query) {
  const auto& touch = *reinterpret_cast<const TouchQuery*>(query->context);
  const RTCRay ray = rtcGetRayFromRayN(query->ray, query->N, 0);
  const RTCHit hit = rtcGetHitFromHitN(query->hit, query->N, 0);
  if (hit.geomID == touch.first.body || isLeaving(ray, hit) == touch.leaving ||
      touch.bodies.material(hit.geomID, hit.primID) != touch.first.material)
    query->valid[0] = 0;
}

template <class Query>
RTCIntersectContext* prepared(Query& query, RTCFilterFunctionN filter) {
  rtcInitIntersectContext(&query.context);
  query.context.filter = filter;
  return &query.context;
}

constexpr float endless = std::numeric_limits<float>::infinity();

/// Which lanes of a packet hold rays.
struct alignas(64) ValidLanes {
  int value[SceneGeometry::packet];
  explicit ValidLanes(std::size_t count) {
    for (int n = 0; n < SceneGeometry::packet; ++n) value[n] = n < static_cast<int>(count) ? -1 : 0;
  }
};

void setRay(RTCRay16& to, int lane, const Ray& ray, float far) {
  to.org_x[lane] = ray.origin.x;
  to.org_y[lane] = ray.origin.y;
  to.org_z[lane] = ray.origin.z;
  to.tnear[lane] = ray.near;
  to.dir_x[lane] = ray.direction.x;
  to.dir_y[lane] = ray.direction.y;
  to.dir_z[lane] = ray.direction.z;
  to.time[lane] = ray.time;
  to.tfar[lane] = far;
  to.mask[lane] = ~0u;
  to.id[lane] = static_cast<unsigned>(lane);
  to.flags[lane] = 0;
}

}  // namespace

struct SceneGeometry::Bodies {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  DrawnBodies list;

  explicit Bodies(const MaterialTable& materials) : list(materials) {
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  }
  ~Bodies() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  float add(const FrameBody& body, double openTime);
  void build();
};

/// Returns the body's largest coordinate.
float SceneGeometry::Bodies::add(const FrameBody& body, double openTime) {
  list.add(body);
  if (body.mesh->triangles.empty()) return 0;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const bool blurred = openTime > 0 && body.moves;
  float largest;
  if (blurred) {
    rtcSetGeometryTimeStepCount(geometry, 2);
    largest = std::max(placeVertices(geometry, 0, *body.mesh, poseAfter(body, -openTime / 2)),
                       placeVertices(geometry, 1, *body.mesh, poseAfter(body, openTime / 2)));
  } else {
    largest = placeVertices(geometry, 0, *body.mesh, body.pose);
  }
  placeTriangles(geometry, *body.mesh);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, list.size() - 1);
  rtcReleaseGeometry(geometry);
  return largest;
}

/// One thread builds: where two triangles are equally near (pieces that touch), the tree decides, and a tree built by
/// several threads may differ from run to run.
void SceneGeometry::Bodies::build() {
  tbb::task_arena alone(1);
  alone.execute([&] { rtcJoinCommitScene(scene); });
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw Error(ExitCode::noRoom, "not enough memory for the picture's bounding volumes");
}

SceneGeometry::SceneGeometry(const std::vector<FrameBody>& bodies, const MaterialTable& materials, double openTime)
    : bodies_(std::make_unique<Bodies>(materials)), resolution_(smallestResolution) {
  for (const FrameBody& body : bodies)
    resolution_ = std::max(resolution_, relativeResolution * bodies_->add(body, openTime));
  bodies_->build();
}

SceneGeometry::~SceneGeometry() = default;

FoundTriangle SceneGeometry::find(const Ray& ray) const {
  RTCRayHit query = rayHit(ray, endless);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(bodies_->scene, &context, &query);
  const RTCHit& hit = query.hit;
  return {hit.geomID, hit.primID, query.ray.tfar, hit.u, hit.v, {hit.Ng_x, hit.Ng_y, hit.Ng_z}};
}

void SceneGeometry::find(std::span<const Ray> rays, std::span<FoundTriangle> found) const {
  const ValidLanes valid(rays.size());
  RTCRayHit16 query;
  for (int lane = 0; lane < std::ssize(rays); ++lane) {
    setRay(query.ray, lane, rays[lane], endless);
    query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.value, bodies_->scene, &context, &query);
  const RTCHit16& hit = query.hit;
  for (int lane = 0; lane < std::ssize(rays); ++lane)
    found[lane] = {hit.geomID[lane], hit.primID[lane], query.ray.tfar[lane],
                   hit.u[lane],      hit.v[lane],      {hit.Ng_x[lane], hit.Ng_y[lane], hit.Ng_z[lane]}};
}

bool SceneGeometry::closest(const Ray& ray, SurfaceHit& hit) const {
  const FoundTriangle found = find(ray);
  if (found.isNone()) return false;
  hit = surfaceAt(found);
  return true;
}

SurfaceHit SceneGeometry::surfaceAt(const FoundTriangle& found) const { return bodies_->list.surfaceAt(found); }

Vec3f SceneGeometry::lightPassing(const Ray& ray, float distance, GlassShade glass) const {
  RTCRay query = rayHit(ray, distance).ray;
  ShadowQuery shadow{{}, bodies_->list, glass};
  rtcOccluded1(bodies_->scene, prepared(shadow, bodies_->list.anyLetsLightPass() ? passGlass : nullptr), &query);
  const bool blocked = query.tfar < 0;  // how Embree says that something is in the way
  return blocked ? Vec3f{} : shadow.passed[0].light();
}

void SceneGeometry::lightPassing(std::span<const Ray> rays, std::span<const float> distances,
                                 std::span<Vec3f> passing) const {
  const ValidLanes valid(rays.size());
  RTCRay16 query;
  for (int lane = 0; lane < std::ssize(rays); ++lane) setRay(query, lane, rays[lane], distances[lane]);
  ShadowQuery shadow{{}, bodies_->list, GlassShade::passes};
  RTCIntersectContext* context = prepared(shadow, bodies_->list.anyLetsLightPass() ? passGlass : nullptr);
  context->flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid.value, bodies_->scene, context, &query);
  for (int lane = 0; lane < std::ssize(rays); ++lane)
    passing[lane] = query.tfar[lane] < 0 ? Vec3f{} : shadow.passed[lane].light();
}

bool SceneGeometry::touchesSameGlass(const Ray& ray, const SurfaceHit& hit) const {
  Ray around = ray;
  around.near = std::max(0.0f, hit.distance - resolution_);
  RTCRay query = rayHit(around, hit.distance + resolution_).ray;
  TouchQuery touch{{}, bodies_->list, hit, dot(ray.direction, hit.normal) > 0};
  rtcOccluded1(bodies_->scene, prepared(touch, findCounterpart), &query);
  return query.tfar < 0;
}

}  // namespace brisance
