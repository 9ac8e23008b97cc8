// Embree alone: one mesh, its own structures.
#include <embree3/rtcore.h>

#include <atomic>
#include <limits>
#include <mutex>

#include "base/parallel.h"
#include "render_inputs.h"

namespace brisance::bench {
namespace {

struct RawScene {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);

  RawScene(const std::vector<FrameBody>& bodies, bool robust) {
    rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    for (const FrameBody& body : bodies) {
      const TriangleMesh& mesh = *body.mesh;
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float), mesh.vertices.size()));
      for (const Vec3d& place : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) *vertex++ = static_cast<float>(place[axis]);
      auto* triangle = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
      std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangle);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
  }
  ~RawScene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  RawScene(const RawScene&) = delete;
  RawScene& operator=(const RawScene&) = delete;
};

/// Sums count(first, last) over pieces of the rays on all threads.
template <class Count>
RayCounts counted(std::size_t rays, const Count& count) {
  constexpr std::int64_t grain = 4096;
  RayCounts all;
  std::mutex adding;
  parallelFor(0, static_cast<std::int64_t>(rays), grain, [&](std::int64_t first, std::int64_t last) {
    const RayCounts some = count(first, last);
    const std::lock_guard lock(adding);
    all.hits += some.hits;
    all.distances += some.distances;
  });
  return all;
}

RayCounts packets(const RawScene& raw, const std::vector<Ray>& rays, std::int64_t first, std::int64_t last) {
  RayCounts counts;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (; first < last; first += 16) {
    alignas(64) int valid[16];
    RTCRayHit16 query;
    for (int n = 0; n < 16; ++n) {
      const Ray& ray = rays[std::min<std::int64_t>(first + n, std::ssize(rays) - 1)];
      valid[n] = first + n < last ? -1 : 0;
      query.ray.org_x[n] = ray.origin.x;
      query.ray.org_y[n] = ray.origin.y;
      query.ray.org_z[n] = ray.origin.z;
      query.ray.dir_x[n] = ray.direction.x;
      query.ray.dir_y[n] = ray.direction.y;
      query.ray.dir_z[n] = ray.direction.z;
      query.ray.tnear[n] = ray.near;
      query.ray.tfar[n] = std::numeric_limits<float>::infinity();
      query.ray.time[n] = 0;
      query.ray.mask[n] = ~0u;
      query.ray.flags[n] = 0;
      query.hit.geomID[n] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, raw.scene, &context, &query);
    for (int n = 0; n < 16; ++n)
      if (valid[n] && query.hit.geomID[n] != RTC_INVALID_GEOMETRY_ID) {
        ++counts.hits;
        counts.distances += query.ray.tfar[n];
      }
  }
  return counts;
}

RayCounts singles(const RawScene& raw, const std::vector<Ray>& rays, std::int64_t first, std::int64_t last) {
  RayCounts counts;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (; first < last; ++first) {
    const Ray& ray = rays[first];
    RTCRayHit query;
    query.ray = {ray.origin.x,
                 ray.origin.y,
                 ray.origin.z,
                 ray.near,
                 ray.direction.x,
                 ray.direction.y,
                 ray.direction.z,
                 0,
                 std::numeric_limits<float>::infinity(),
                 ~0u,
                 0,
                 0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(raw.scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    ++counts.hits;
    counts.distances += query.ray.tfar;
  }
  return counts;
}

}  // namespace

EmbreeRays makeEmbreePackets(const std::vector<FrameBody>& bodies, bool robust) {
  return [raw = std::make_shared<RawScene>(bodies, robust)](const std::vector<Ray>& rays) {
    return counted(rays.size(), [&](auto first, auto last) { return packets(*raw, rays, first, last); });
  };
}

EmbreeRays makeEmbreeSingles(const std::vector<FrameBody>& bodies, bool robust) {
  return [raw = std::make_shared<RawScene>(bodies, robust)](const std::vector<Ray>& rays) {
    return counted(rays.size(), [&](auto first, auto last) { return singles(*raw, rays, first, last); });
  };
}

}  // namespace brisance::bench
