#include "render/scene_geometry.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.h"
#include "render/dielectric.h"

namespace brisance {

Pose poseAfter(const FrameBody& body, double seconds) {
  const double speed = length(body.angularVelocity);
  const Vec3d position = body.pose.position + body.linearVelocity * seconds;
  if (speed * seconds == 0) return {position, body.pose.orientation};
  return {position, normalized(axisAngle(body.angularVelocity / speed, speed * seconds) * body.pose.orientation)};
}

namespace {

/// Of the largest coordinate: some sixteen steps of a float, the error of a hit's place.
constexpr float relativeResolution = 2e-6f;
constexpr float smallestResolution = 1e-7f;  // [m]

/// What a hit looks up about a body.
struct DrawnBody {
  std::shared_ptr<const TriangleMesh> mesh;
  std::vector<std::uint16_t> materials;  ///< one, or one per triangle
  std::vector<Vec3d> normals;            ///< of vertices where the mesh has none and a material is smooth
  Mat3 rotation;

  std::uint16_t material(std::uint32_t triangle) const {
    return materials.size() == 1 ? materials[0] : materials[triangle];
  }
  const std::vector<Vec3d>& smoothNormals() const { return normals.empty() ? mesh->normals : normals; }
};

DrawnBody drawnBody(const FrameBody& body, const MaterialTable& materials) {
  DrawnBody drawn{body.mesh, materials.ofTriangles(body), {}, rotationMatrix(body.pose.orientation)};
  const bool smooth = std::any_of(drawn.materials.begin(), drawn.materials.end(),
                                  [&](std::uint16_t m) { return materials[m].settings.smooth; });
  if (smooth && body.mesh->normals.empty()) drawn.normals = vertexNormals(*body.mesh);
  return drawn;
}

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

Vec3f normalOf(const RTCHit& hit) { return normalized(Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z)); }

template <class T>
T atCorners(const std::vector<T>& values, const Triangle& triangle, double u, double v) {
  return values[triangle[0]] * (1 - u - v) + values[triangle[1]] * u + values[triangle[2]] * v;
}

/// The way u grows over a triangle (uVec of appendix A.1.2, up to its length); zero where no u v tells.
Vec3d alongU(const TriangleMesh& mesh, const Triangle& t) {
  if (mesh.uvs.empty()) return {};
  const Vec2d a = mesh.uvs[t[1]] - mesh.uvs[t[0]], b = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const double m = a.x * b.y - a.y * b.x;
  const Vec3d along =
      (mesh.vertices[t[1]] - mesh.vertices[t[0]]) * b.y - (mesh.vertices[t[2]] - mesh.vertices[t[0]]) * a.y;
  return m < 0 ? -along : m > 0 ? along : Vec3d{};
}

/// The bodies by Embree's geometry number.
struct DrawnBodies {
  const MaterialTable& materials;
  std::vector<DrawnBody> drawn{};
  bool anyLetsLightPass = false;  ///< glass, or a material that casts no shadow

  std::uint16_t materialNumber(const RTCHit& hit) const { return drawn[hit.geomID].material(hit.primID); }
  const Material& material(const RTCHit& hit) const { return materials[materialNumber(hit)].settings; }
  void add(const FrameBody& body) {
    drawn.push_back(drawnBody(body, materials));
    for (const std::uint16_t m : drawn.back().materials)
      anyLetsLightPass |= materials[m].settings.glass || !materials[m].settings.castsShadow;
  }
};

/// Embree hands its context to the filter; ours begins with it.
struct ShadowQuery {
  RTCIntersectContext context;
  const DrawnBodies& bodies;
  GlassShade glass;
  Vec3f passing{1, 1, 1};
  Vec3f opticalDepth{};  ///< sum of absorption times way inside: leaving distances minus entering ones
};

bool isLeaving(const RTCRay& ray, const RTCHit& hit) {
  return dot(Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z), Vec3f(ray.dir_x, ray.dir_y, ray.dir_z)) > 0;
}

void passGlass(const RTCFilterFunctionNArguments* query) {
  auto& shadow = *reinterpret_cast<ShadowQuery*>(query->context);
  const RTCRay ray = rtcGetRayFromRayN(query->ray, query->N, 0);
  const RTCHit hit = rtcGetHitFromHitN(query->hit, query->N, 0);
  const Material& material = shadow.bodies.material(hit);
  const bool passable = material.glass && shadow.glass == GlassShade::passes;
  if (material.castsShadow && !passable) return;  // a hit: the light is blocked
  query->valid[0] = 0;
  if (!material.castsShadow) return;
  shadow.passing *= 1 - fresnelReflectance(1, static_cast<float>(1 / material.refractiveIndex));
  shadow.opticalDepth += material.absorption * (isLeaving(ray, hit) ? ray.tfar : -ray.tfar);
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
      touch.bodies.materialNumber(hit) != touch.first.material)
    query->valid[0] = 0;
}

template <class Query>
RTCIntersectContext* prepared(Query& query, RTCFilterFunctionN filter) {
  rtcInitIntersectContext(&query.context);
  query.context.filter = filter;
  return &query.context;
}

}  // namespace

struct SceneGeometry::Bodies {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  DrawnBodies list;

  explicit Bodies(const MaterialTable& materials) : list{materials} {
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
  rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(list.drawn.size() - 1));
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

bool SceneGeometry::closest(const Ray& ray, SurfaceHit& hit) const {
  RTCRayHit query = rayHit(ray, std::numeric_limits<float>::infinity());
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(bodies_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

  const DrawnBody& body = bodies_->list.drawn[query.hit.geomID];
  const Triangle& triangle = body.mesh->triangles[query.hit.primID];
  hit.distance = query.ray.tfar;
  hit.normal = normalOf(query.hit);
  hit.body = query.hit.geomID;
  hit.material = body.material(query.hit.primID);
  const double u = query.hit.u, v = query.hit.v;
  const SurfaceMaterial& material = bodies_->list.materials[hit.material];
  hit.shadingNormal = material.settings.smooth
                          ? Vec3f(normalized(body.rotation * atCorners(body.smoothNormals(), triangle, u, v)))
                          : hit.normal;
  const Vec2d uv = body.mesh->uvs.empty() ? Vec2d{} : atCorners(body.mesh->uvs, triangle, u, v);
  hit.texture.uv = {static_cast<float>(uv.x), static_cast<float>(uv.y)};
  if (material.isSolidPattern()) hit.texture.inBody = Vec3f(atCorners(body.mesh->vertices, triangle, u, v));
  if (material.isAnisotropic()) hit.alongU = Vec3f(body.rotation * alongU(*body.mesh, triangle));
  return true;
}

Vec3f SceneGeometry::lightPassing(const Ray& ray, float distance, GlassShade glass) const {
  RTCRay query = rayHit(ray, distance).ray;
  ShadowQuery shadow{{}, bodies_->list, glass};
  rtcOccluded1(bodies_->scene, prepared(shadow, bodies_->list.anyLetsLightPass ? passGlass : nullptr), &query);
  if (query.tfar < 0) return {};  // how Embree says that something is in the way
  return shadow.opticalDepth == Vec3f{} ? shadow.passing : shadow.passing * beerTransmittance(shadow.opticalDepth, 1);
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
