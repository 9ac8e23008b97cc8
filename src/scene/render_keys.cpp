// The tables of the picture: camera, materials, lights, render.
#include "scene/scene_keys.h"

namespace brisance {
namespace {

constexpr std::string_view lightNames[] = {"point", "sun", "fire"};
constexpr std::string_view blackbodyNames[] = {"physical_blackbody", "tuned_blackbody"};
constexpr std::string_view patternNames[] = {"none", "wood", "marble", "checkerboard"};
constexpr std::string_view lightingNames[] = {"phong", "ashikhmin_shirley"};
constexpr std::string_view volumeSourceNames[] = {"particles", "gas"};
constexpr std::string_view integratorNames[] = {"whitted", "path"};
constexpr double brightest = 1e6;  // keeps products of colours finite in single precision

void describeView(KeyVisitor& v, CameraViewKeys& view) {
  visit(v, {"position", "m", anyValue, "of the eye"}, view.key.position);
  visit(v, {"look_at", "m", anyValue, "what is in the middle of the picture"}, view.key.lookAt);
  visit(v, {"up", "", anyValue, "which way is up in the picture"}, view.key.up);
  visit(v, {"fov_degrees", "degrees", {0, 175, false}, "vertical field of view", {}, "40"}, view.fovDegrees);
  visit(v, {"focal_length_mm", "mm", above(0), "in place of fov_degrees", {}, "from fov_degrees"}, view.focalLengthMm);
  visit(v, {"sensor_height_mm", "mm", above(0), "that focal_length_mm refers to"}, view.sensorHeightMm);
  visit(v, {"lens_radius", "m", atLeast(0), "of a thin lens: depth of field; 0 is a pinhole"}, view.key.lensRadius);
  visit(v, {"focus_distance", "m", above(0), "along the view, where a lens draws sharply", {}, "that of look_at"},
        view.focusDistance);
}

void describeCameraKey(KeyVisitor& v, CameraViewKeys& view) {
  visit(v, {"time", "s", anyValue, "of film, rising from key to key"}, view.key.time);
  describeView(v, view);
}

struct LightKeys {
  void operator()(KeyVisitor& v, PointLight& light) const {
    visit(v, {"position", "m", anyValue, "of the light"}, light.position);
    visit(v, {"intensity", "", between(0, brightest), "radiance at one metre: red, green, blue"}, light.intensity);
    visit(v, {"falloff", "", between(0, 4), "power of the distance: 2 is physical, 0 none"}, light.falloff);
  }
  void operator()(KeyVisitor& v, SunLight& light) const {
    visit(v, {"direction", "", anyValue, "the way the light travels"}, light.direction);
    visit(v, {"radiance", "", between(0, brightest), "red, green, blue"}, light.radiance);
    visit(v, {"angle_degrees", "degrees", between(0, 90), "across the sun: half-shadows of the path integrator"},
          light.angleDegrees);
  }
  void operator()(KeyVisitor& v, FireLight& light) const {
    visit(v, {"strength", "", between(0, brightest), "1 is as bright as the fire is seen"}, light.strength);
    visit(v, {"lights", "", between(1, 4096), "point lights that stand for the fire of a frame"}, light.lights);
  }
};

struct BlackbodyKeys {
  void operator()(KeyVisitor& v, PhysicalBlackbody& map) const {
    visit(v, {"exposure_temperature", "K", between(500, 20000), "whose luminance is 1"}, map.exposureTemperature);
  }
  void operator()(KeyVisitor&, TunedBlackbody&) const {}
};

void describeVolumeLook(KeyVisitor& v, VolumeSettings& volume) {
  visit(v, {"blur", "m", atLeast(0), "deviation of the Gaussian over the particles", {"alpha", "5.1, 5.3"}},
        volume.blur);
  visit(v,
        {"filter_size",
         "",
         between(0, 255),
         "width of the Gaussian in cells, odd; 0 is three deviations",
         {"n_f", "5.1, 5.3"}},
        volume.filterSize);
  visit(v,
        {"min_density", "", between(0, 1), "mapped density of the thinnest gas that is drawn", {"min_d", "5.1, 5.3"}},
        volume.minDensity);
  visit(v, {"max_density", "", {0, 1, false}, "mapped density of full_density", {"max_d", "5.1, 5.3"}},
        volume.maxDensity);
  visit(v, {"full_density", "kg/m3", above(0), "mapped to max_density; one range for the whole run"},
        volume.fullDensity);
  visit(v, {"opacity", "1/m", atLeast(0), "per mapped density", {"tau", "5.1, 5.3"}}, volume.opacity);
  visit(v, {"fuel_weight", "", atLeast(0), "how much burning fuel counts, times its mass"}, volume.fuelWeight);
  visit(v, {"emission", "", between(0, brightest), "times the blackbody colour"}, volume.emission);
  visit(v, {"smoke_colour", "", between(0, brightest), "what smoke scatters of the light that meets it"},
        volume.smokeColour);
  visit(v,
        {"anisotropy", "", between(-0.99, 0.99), "mean cosine of scattering (Henyey and Greenstein), path integrator"},
        volume.anisotropy);
  v.enter({"blackbody", "", anyValue, "how temperature becomes colour"}, true);
  visitAlternatives(v, blackbodyNames, volume.blackbody, BlackbodyKeys{});
  v.leave();
}

struct PatternKeys {
  void operator()(KeyVisitor&, NoPattern&) const {}
  void operator()(KeyVisitor& v, Wood& wood) const { describeSolid(v, wood); }
  void operator()(KeyVisitor& v, Marble& marble) const { describeSolid(v, marble); }
  void operator()(KeyVisitor& v, Checkerboard& board) const {
    describeColours(v, board);
    visit(v, {"size", "", between(1, 1e4), "SIZE: fields over u and over v from 0 to 1"}, board.size);
  }

 private:
  template <class Pattern>
  static void describeColours(KeyVisitor& v, Pattern& pattern) {
    visit(v, {"colour_1", "", between(0, brightest), "scene-linear red, green, blue"}, pattern.colour1);
    visit(v, {"colour_2", "", between(0, brightest), "scene-linear red, green, blue"}, pattern.colour2);
  }
  template <class Pattern>
  static void describeSolid(KeyVisitor& v, Pattern& pattern) {
    describeColours(v, pattern);
    visit(v, {"unit", "m", above(0), "of the pattern: larger is coarser"}, pattern.unit);
  }
};

struct LightingKeys {
  void operator()(KeyVisitor&, PhongLighting&) const {}
  void operator()(KeyVisitor& v, AshikhminLighting& model) const {
    visit(v, {"exponent_u", "", between(0, 1e6), "n_u: the larger, the narrower the highlight along u"},
          model.exponentU);
    visit(v, {"exponent_v", "", between(0, 1e6), "n_v: likewise along v"}, model.exponentV);
  }
};

struct IntegratorKeys {
  void operator()(KeyVisitor&, WhittedIntegrator&) const {}
  void operator()(KeyVisitor& v, PathIntegrator& path) const {
    visit(v, {"max_bounces", "", between(0, 1000), "of light off surfaces and smoke"}, path.maxBounces);
    visit(v, {"faint", "", between(0, 1), "share of a path's light at the camera under which it may end by chance"},
          path.faint);
    visit(
        v,
        {"splits", "", between(0, 8), "mirrors and glass surfaces from the camera on at which both ways are followed"},
        path.splits);
    visit(v, {"adaptive", "", anyValue, "more samples where light is noisier, in the mean as many; not with denoise"},
          path.adaptive);
  }
};

void describeEnvironment(KeyVisitor& v, EnvironmentSettings& environment) {
  visit(v, {"file", "", anyValue, "OpenEXR, PNG or JPEG of all directions: longitude, latitude", {}, "background"},
        environment.file);
  visit(v, {"strength", "", between(0, brightest), "times the picture's light"}, environment.strength);
  visit(v, {"rotation_degrees", "degrees", anyValue, "about the y axis"}, environment.rotationDegrees);
}

}  // namespace

void describeCamera(KeyVisitor& v, SceneDraft& draft) {
  visit(v, {"shutter", "", between(0, 1), "fraction of a frame for which it is open"},
        draft.scene.render.camera.shutter);
  describeView(v, draft.camera);
  CameraViewKeys fresh = draft.camera;  // a key says what changes; the rest is as in [camera]
  fresh.fovDegrees.reset();
  fresh.focalLengthMm.reset();
  fresh.focusDistance.reset();
  visitArray(v, {"keys", "", anyValue, "where the camera is when; what a key does not say is as in [camera]"},
             draft.cameraKeys, fresh, describeCameraKey);
}

void describeMaterial(KeyVisitor& v, MaterialKeys& keys) {
  Material& material = keys.material;
  Key name{"name", "", anyValue, "by which bodies and mesh files call it"};
  name.required = true;
  visit(v, name, keys.name);
  visit(v, {"colour", "", between(0, brightest), "diffuse, scene-linear red, green, blue", {}, "[0.7, 0.7, 0.7]"},
        keys.colour);
  visit(v, {"texture", "", anyValue, "PNG or JPEG in place of colour, relative to the scene file", {}, "none"},
        keys.texture);
  v.enter({"pattern", "", anyValue, "in place of colour or texture"}, true);
  visitAlternatives(v, patternNames, keys.pattern, PatternKeys{});
  v.leave();
  v.enter({"lighting", "", anyValue, "how the surface returns light"}, true);
  visitAlternatives(v, lightingNames, material.lighting, LightingKeys{});
  v.leave();
  visit(v, {"diffuse_weight", "", between(0, 1), "R_d of the lighting model"}, material.diffuseWeight);
  visit(v, {"specular", "", between(0, 1), "R_s of the lighting model"}, material.specular);
  visit(v, {"specular_exponent", "", between(0, 1e6), "f of Phong's model"}, material.specularExponent);
  visit(v, {"ambient", "", between(0, 1), "R_a of Phong's model, times the diffuse colour"}, material.ambient);
  visit(v, {"emission", "", between(0, brightest), "times the colour or texture"}, material.emission);
  visit(v, {"reflection", "", between(0, 1), "share that an opaque surface mirrors"}, material.reflection);
  visit(v, {"glass", "", anyValue, "dielectric: Fresnel's shares of reflection and refraction"}, material.glass);
  visit(v, {"refractive_index", "", between(1, 5), "of glass"}, material.refractiveIndex);
  visit(v, {"roughness", "", between(0, 1), "of glass, path integrator: 0 is clear, 0.3 frosted (alpha of GGX)"},
        material.roughness);
  visit(v, {"absorption", "1/m", between(0, brightest), "inside glass"}, material.absorption);
  visit(v, {"smooth", "", anyValue, "normals go smoothly between vertices"}, material.smooth);
  visit(v, {"casts_shadow", "", anyValue, "false lets light through"}, material.castsShadow);
  visit(v, {"piece_tint", "", between(0, 1), "how far the hues of pieces with one colour lie apart"},
        material.pieceTint);
  visit(v,
        {"glow", "", between(0, brightest), "times the blackbody colour of a piece's temperature, it shines with that"},
        material.glow);
}

void describeFlow(KeyVisitor& v, FlowSettings& flow) {
  visit(v, {"drawn", "", anyValue, "true draws them"}, flow.drawn);
  visit(v, {"lower", "m", anyValue, "corner of the box that they fill; it may be flat"}, flow.lower);
  visit(v, {"upper", "m", anyValue, "opposite corner"}, flow.upper);
  visit(v, {"spacing", "m", above(0), "between arrows"}, flow.spacing);
  visit(v, {"seconds", "s", above(0), "of the gas' way that an arrow is long"}, flow.seconds);
  visit(v, {"colour", "", between(0, brightest), "of the arrows; they cast no shadow"}, flow.colour);
}

void describeBitsLook(KeyVisitor& v, BitsLook& bits) {
  visit(v, {"spark_width", "m", above(0), "of a spark's streak"}, bits.sparkWidth);
  visit(v, {"spark_seconds", "s", atLeast(0), "of the spark's way that its streak is long, simulated time"},
        bits.sparkSeconds);
  visit(v, {"spark_emission", "", between(0, brightest), "times the blackbody colour of its temperature"},
        bits.sparkEmission);
  visit(v, {"grain_size", "m", above(0), "of a grain of dust, across"}, bits.grainSize);
  visit(v, {"grain_colour", "", between(0, 1), "of dust: diffuse red, green, blue"}, bits.grainColour);
  visit(v, {"grain_reflection", "", between(0, 1), "share that dust mirrors"}, bits.grainReflection);
}

void describeLight(KeyVisitor& v, Light& light) { visitAlternatives(v, lightNames, light, LightKeys{}); }

void describeRender(KeyVisitor& v, SceneDraft& draft) {
  RenderSettings& render = draft.scene.render;
  visit(v, {"width", "pixels", between(1, 16384), "of the picture"}, render.width);
  visit(v, {"height", "pixels", between(1, 16384), "of the picture"}, render.height);
  visit(v,
        {"samples", "", between(1, 64),
         "n of the n x n samples of a pixel; whole, unless they are adaptive: 1.5 stands for 2.25 in the mean"},
        render.samples);
  v.enter({"integrator", "", anyValue, "whitted: lights, mirrors, glass; path: all ways of light"}, true);
  visitAlternatives(v, integratorNames, render.integrator, IntegratorKeys{});
  v.leave();
  visit(v, {"denoise", "", anyValue, "path integrator: take noise from the picture, guided by what the camera sees"},
        render.denoise);
  visit(v, {"max_depth", "", between(0, 64), "of reflection and refraction"}, render.maxDepth);
  visit(v, {"seed", "", atLeast(0), "of the samples' places", {}, "scene.seed"}, draft.renderSeed);
  visit(v, {"background", "", between(0, brightest), "red, green, blue beyond the scene"}, render.background);
  visit(v, {"ambient_light", "", between(0, brightest), "red, green, blue from everywhere"}, render.ambientLight);
  visitTable(v, "environment", "light from far away", render.environment, describeEnvironment);
  visit(v, {"exposure_stops", "", between(-30, 30), "pictures are brighter by 2 to this"}, render.exposureStops);
  visit(v, {"write_exr", "", anyValue, "also the unclipped picture, as OpenEXR"}, render.writeExr);
  visit(v, {"layers", "", anyValue, "in the OpenEXR file: depth, normal, albedo, motion, bodies, gas, variance"},
        render.layers);
  visitTable(v, "volume", "the gas as it is drawn", draft, [](KeyVisitor& inner, SceneDraft& whole) {
    visit(inner, {"drawn", "", anyValue, "false leaves fire and smoke out of the picture"},
          whole.scene.render.volume.drawn);
    visitChoice(inner,
                {"source", "", anyValue,
                 "particles, over the cells below and blurred; or gas: soot, flame and heat of the gas' own cells"},
                volumeSourceNames, whole.scene.render.volume.source);
    describeLattice(inner, whole.volume, {"vx, vy, vz", "5.1, 5.3"});
    describeVolumeLook(inner, whole.scene.render.volume);
  });
  visitTable(v, "flow", "the gas' velocity, drawn as arrows", render.flow, describeFlow);
  visitTable(v, "bits", "how sparks and dust are drawn", render.bits, describeBitsLook);
}

}  // namespace brisance
