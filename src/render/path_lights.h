// Light that comes to a place straight from the lights: one draw from each kind.
#pragma once

#include "render/path_tracer.h"

namespace brisance {

/// How a place returns light of a direction (from the place) to the way it was come upon.
struct Returned {
  Vec3f value;    ///< [1/sr] times the cosine on a surface
  float density;  ///< [1/sr] with which that direction is drawn when the path goes on
};

/// Sums up what the lights send to `place`, each counted by its share of the two ways in which the path may find it
/// (Veach & Guibas 1995, balance heuristic). `scatter(direction)` gives Returned.
template <class Scatter>
class ArrivingLights {
 public:
  ArrivingLights(const PathWorld& world, const Vec3f& place, float time, float phase, const Scatter& scatter)
      : world_(world), place_(place), time_(time), phase_(phase), scatter_(scatter) {}

  Vec3f sum(SampleSequence& numbers) const {
    Vec3f light;
    for (const LightSource& source : world_.lights) light += fromSource(source, numbers);
    if (!world_.shining.isDark()) light += fromSurface(numbers);
    if (!world_.environment.isEven()) light += fromEnvironment(numbers);
    return light;
  }

 private:
  /// What bodies and gas let through. Glass lets light of points and suns through straight, as no path would find
  /// those beyond it; all other light through glass is found by the paths that go on.
  Vec3f passing(const Vec3f& direction, float distance, GlassShade glass) const {
    const Ray ray{place_, direction, world_.geometry.resolution(), time_};
    if (!(distance > ray.near)) return {1, 1, 1};  // as near as two surfaces that are one
    const Vec3f bodies = world_.geometry.lightPassing(ray, distance, glass);
    if (!world_.gas || bodies == Vec3f{}) return bodies;
    return bodies * world_.gas->transmittance({place_, direction, 0, distance, phase_});
  }

  Vec3f fromSource(const LightSource& source, SampleSequence& numbers) const {
    const Vec2<float> where = source.cosine < 1 ? numbers.pair() : Vec2<float>{};
    const ArrivingLight arriving = source.at(place_, where);
    const Vec3f returned = scatter_(arriving.toLight).value * (arriving.intensity * static_cast<float>(pi));
    return returned == Vec3f{} ? returned : returned * passing(arriving.toLight, arriving.distance, GlassShade::passes);
  }

  Vec3f fromSurface(SampleSequence& numbers) const {
    const float choice = numbers.number();
    const AreaSample drawn = world_.shining.sample(choice, numbers.pair(), time_);
    const Vec3f way = drawn.place - place_;
    const float distance2 = dot(way, way), distance = std::sqrt(distance2);
    const Vec3f direction = way / distance;
    const float cosine = std::abs(dot(direction, drawn.normal));
    if (!(distance > 0) || !(cosine > 0)) return {};
    const Returned returned = scatter_(direction);
    if (returned.value == Vec3f{}) return {};
    const float density = drawn.density * distance2 / cosine;
    const float clear = distance - 4 * world_.geometry.resolution();  // of the shining surface itself
    return returned.value * drawn.radiance * passing(direction, clear, GlassShade::blocks) /
           (density + returned.density);
  }

  Vec3f fromEnvironment(SampleSequence& numbers) const {
    const Vec2<float> where = numbers.pair();
    const std::optional<EnvironmentSample> drawn = world_.environment.sample(where.x, where.y);
    if (!drawn) return {};
    const Returned returned = scatter_(drawn->direction);
    if (returned.value == Vec3f{}) return {};
    constexpr float far = std::numeric_limits<float>::max();
    return returned.value * drawn->radiance * passing(drawn->direction, far, GlassShade::blocks) /
           (drawn->density + returned.density);
  }

  const PathWorld& world_;
  Vec3f place_;
  float time_, phase_;
  const Scatter& scatter_;
};

}  // namespace brisance
