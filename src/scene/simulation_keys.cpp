// The tables of the simulation: gas, explosion, rigid bodies.
#include "scene/scene_keys.h"

#include "fracture/partition.h"

namespace brisance {
namespace {

constexpr std::string_view faceNames[] = {"open", "no_slip", "free_slip", "periodic"};
constexpr const char* faceKeys[] = {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"};
constexpr std::string_view advectionNames[] = {"donor_cell", "maccormack", "semi_lagrangian"};
constexpr std::string_view pressureNames[] = {"auto", "fast_poisson", "multigrid", "conjugate_gradient"};
constexpr std::string_view pushNames[] = {"drag", "pressure"};
constexpr std::string_view collisionNames[] = {"none", "contacts"};
constexpr std::string_view bodiesInGasNames[] = {"pass", "block"};
constexpr std::string_view quadratureNames[] = {"area_quadrature", "vertex_sum"};
constexpr std::string_view shapeNames[] = {"sphere", "box", "rectangle", "mesh", "pane"};
constexpr std::string_view outlineNames[] = {"rectangle", "disc", "polygon"};
constexpr std::string_view patternNames[] = {"uniform", "blue_noise", "impact"};
constexpr std::string_view triangulationNames[] = {"trisection", "delaunay"};
constexpr std::string_view splitNames[] = {"list", "level"};
constexpr std::string_view curvatureWeightNames[] = {"clipped", "raw"};
constexpr std::string_view insideNames[] = {"all", "smallest", "largest"};
constexpr std::string_view edgeWeightNames[] = {"unit", "length"};

void describeFaces(KeyVisitor& v, Faces& faces) {
  for (std::size_t i = 0; i < faces.size(); ++i)
    visitChoice(v,
                {faceKeys[i], "", anyValue,
                 "open lets gas through; no_slip and free_slip are walls; periodic, on both faces of an axis: gas "
                 "comes in again "
                 "opposite"},
                faceNames, faces[i]);
}

void describeAdvection(KeyVisitor& v, DonorCell& scheme) {
  visit(v, {"upwind_weight", "", between(0, 1), "0 is central, 1 upwind differences"}, scheme.upwindWeight);
}

void describeAdvection(KeyVisitor& v, MacCormack& scheme) {
  visit(v, {"clamped", "", anyValue, "to the values of the cell and its neighbours, so that nothing overshoots"},
        scheme.clamped);
}
void describeAdvection(KeyVisitor&, SemiLagrangian&) {}

void describeWallVelocity(KeyVisitor& v, std::array<Vec3d, 6>& velocity) {
  for (std::size_t i = 0; i < velocity.size(); ++i)
    visit(v, {faceKeys[i], "m/s", anyValue, "of a no_slip face, along itself"}, velocity[i]);
}

void describeStirring(KeyVisitor& v, Stirring& stirring) {
  visit(v, {"centre", "m", anyValue, "of the cylinder of gas that is kept turning"}, stirring.centre);
  visit(v, {"axis", "", anyValue, "of rotation, counter-clockwise seen from its tip"}, stirring.axis);
  visit(v, {"radius", "m", above(0), "of the cylinder"}, stirring.radius);
  visit(v, {"length", "m", above(0), "of the cylinder, along the axis", {}, "through the whole box"}, stirring.length);
  visit(v, {"angular_speed", "rad/s", anyValue, "at which it turns; negative: the other way"}, stirring.angularSpeed);
  visit(v, {"relaxation", "s", above(0), "in which its gas comes up to speed to 1/e"}, stirring.relaxation);
}

constexpr const char* giveUp = "after which it gives up and says so";

void describeVelocityTolerance(KeyVisitor& v, double& tolerance) {
  visit(v,
        {"tolerance", "", {1e-14, 0.1}, "of the final velocity's divergence, relative to the one there was to remove"},
        tolerance);
}

void describePressure(KeyVisitor& v, AutomaticSolver& solver) {
  describeVelocityTolerance(v, solver.tolerance);
  visit(v,
        {"patience", "", between(1, 1e6),
         "iterations of fast_poisson among solids, after which multigrid goes on from there"},
        solver.patience);
}
void describePressure(KeyVisitor& v, FastPoisson& solver) {
  describeVelocityTolerance(v, solver.tolerance);
  visit(v, {"max_iterations", "", between(1, 1e6), giveUp}, solver.maxIterations);
}
void describePressure(KeyVisitor& v, MultigridSolver& solver) {
  describeVelocityTolerance(v, solver.tolerance);
  visit(v, {"max_iterations", "", between(1, 1e6), giveUp}, solver.maxIterations);
}
void describePressure(KeyVisitor& v, ConjugateGradient& solver) {
  visit(v, {"tolerance", "", {1e-14, 0.1}, "residual relative to the right-hand side at which it stops"},
        solver.tolerance);
  visit(v, {"max_iterations", "", between(1, 1e6), giveUp}, solver.maxIterations);
}

void describeGasPhysics(KeyVisitor& v, FluidSettings& gas) {
  visit(v, {"viscosity", "m2/s", atLeast(0), "kinematic viscosity, 1/Re of the thesis", {"Re", "2.2"}}, gas.viscosity);
  visit(v, {"conductivity", "m2/s", atLeast(0), "thermal diffusivity", {"c_k", "2.2, 5.1, 5.3"}}, gas.conductivity);
  visit(
      v,
      {"cooling_rate", "K/s", atLeast(0), "cooling by radiation at the maximum temperature", {"c_r", "2.2, 5.1, 5.3"}},
      gas.coolingRate);
  visit(v, {"ambient_temperature", "K", atLeast(0), "of the surroundings", {"T_a", "2.2, 5.1, 5.3"}},
        gas.ambientTemperature);
  visit(v, {"maximum_temperature", "K", above(0), "scale of the cooling term, not a cap", {"T_max", "2.2, 5.1, 5.3"}},
        gas.maximumTemperature);
  visit(v, {"heat_capacity", "J/(m3 K)", above(0), "of a volume of gas"}, gas.heatCapacity);
  visit(v, {"density", "kg/m3", above(0), "of the gas whose pressure pushes bodies (rigid.push)"}, gas.density);
  visit(v, {"force", "m/s2", anyValue, "on all gas alike", {"g_x, g_y, g_z", "2.2"}}, gas.force);
  visit(v, {"buoyancy", "m/(s2 K)", atLeast(0), "upward acceleration per kelvin above ambient"}, gas.buoyancy);
  visit(v, {"vorticity_confinement", "", atLeast(0), "how much of the whirls that the grid damps is given back"},
        gas.vorticityConfinement);
  visit(v, {"flame_lifetime", "s", above(0), "over which the flame fades to 1/e"}, gas.flameLifetime);
  visit(v, {"wind", "m/s", anyValue, "of the air outside and, at first, inside"}, gas.wind);
  visit(v, {"start_velocity", "m/s", atLeast(0), "deviation of random start velocities, which break symmetry"},
        gas.startVelocity);
}

void describeBurning(KeyVisitor& v, BurnSettings& burning) {
  visit(v, {"mass", "kg", above(0), "of a fresh fuel particle", {"m", "2.1, 5.1, 5.3"}}, burning.mass);
  visit(v, {"radius", "m", above(0), "of a particle, in drag and heating", {"r", "2.1"}}, burning.radius);
  visit(v, {"burn_rate", "kg/s", above(0), "fuel that a burning particle consumes", {"z_f", "5.1, 5.3"}},
        burning.burnRate);
  visit(v, {"soot_burn_rate", "kg/s", atLeast(0), "mass that a soot particle loses", {"z_s", "5.1, 5.3"}},
        burning.sootBurnRate);
  visit(v, {"heat_per_mass", "J/kg", atLeast(0), "released by burning", {"b_h", "5.1, 5.3"}}, burning.heatPerMass);
  visit(v, {"gas_per_mass", "m3/kg", atLeast(0), "volume released by burning", {"b_g", "5.1, 5.3"}},
        burning.gasPerMass);
  visit(v, {"soot_per_mass", "kg/kg", atLeast(0), "soot made by burning", {"b_s", "5.1, 5.3"}}, burning.sootPerMass);
  visit(v, {"soot_threshold", "kg", above(0), "gathered soot that becomes a particle", {"c_soot", "5.1, 5.3"}},
        burning.sootThreshold);
  visit(v, {"soot_once", "", anyValue, "at most one soot particle per fuel particle, as in the thesis"},
        burning.sootOnce);
}

void describeSootAndHeat(KeyVisitor& v, BurnSettings& burning) {
  visit(v, {"soot_position_spread", "m", atLeast(0), "deviation of where soot starts from its fuel particle"},
        burning.sootPositionSpread);
  visit(v, {"soot_velocity_spread", "", atLeast(0), "deviation of its start velocity, relative to the fuel particle's"},
        burning.sootVelocitySpread);
  visit(v, {"thermal_mass", "J/K", above(0), "of a particle", {"c_m", "2.1, 5.1, 5.3"}}, burning.thermalMass);
  visit(v, {"heating", "W/(m2 K)", atLeast(0), "heat exchange of particle and gas", {"alpha_h", "5.1, 5.3"}},
        burning.heating);
  visit(v, {"drag", "kg/m3", atLeast(0), "of the gas on a particle", {"alpha_d", "5.1, 5.3"}}, burning.drag);
  visit(v, {"ignition_temperature", "K", atLeast(0), "above which fuel burns", {"T_i", "2.1, 5.1, 5.3"}},
        burning.ignitionTemperature);
  visit(v, {"fuel_mass_threshold", "kg", atLeast(0), "lighter fuel is gone", {"thres_mf", "5.1, 5.3"}},
        burning.fuelMassThreshold);
  visit(
      v,
      {"soot_mass_threshold", "kg", atLeast(0), "lighter soot moves with the gas or is gone", {"thres_ms", "5.1, 5.3"}},
      burning.sootMassThreshold);
  visit(v,
        {"thermal_mass_threshold",
         "J/K",
         atLeast(0),
         "below it a particle has the gas' temperature",
         {"thres_cm", "5.1, 5.3"}},
        burning.thermalMassThreshold);
  visit(v, {"deposit_radius", "m", above(0), "of the kernel that spreads heat and gas, the same on every grid"},
        burning.depositRadius);
}

void describeCharge(KeyVisitor& v, Charge& charge) {
  constexpr double mostParticles = 1e8;
  visit(v, {"position", "m", anyValue, "of the detonation", {"pos_det", "5.1, 5.3"}}, charge.position);
  visit(v, {"radius", "m", atLeast(0), "of the sphere on which fuel is laid out", {"r_d", "5.1, 5.3"}}, charge.radius);
  visit(v, {"time", "s", atLeast(0), "of the detonation, simulated time"}, charge.time);
  visit(v, {"particles", "", between(0, mostParticles), "of fuel at that time", {"n_p", "5.1, 5.3"}}, charge.particles);
  visit(v, {"ignited", "", between(0, mostParticles), "of them that burn from the start", {"np_i", "5.1, 5.3"}},
        charge.ignited);
  visit(v, {"emission_rate", "1/s", between(0, mostParticles), "new fuel particles afterwards", {"np_it", "5.1, 5.3"}},
        charge.emissionRate);
  visit(v, {"emission_time", "s", atLeast(0), "for how long they come, simulated time"}, charge.emissionTime);
  visit(v, {"sparks", "", between(0, 1e6), "thrown out at the detonation"}, charge.sparks);
  visit(v, {"spark_speed", "m/s", atLeast(0), "of the fastest spark"}, charge.sparkSpeed);
  visit(v, {"spark_temperature", "K", atLeast(0), "of sparks at first"}, charge.sparkTemperature);
}

struct ShapeKeys {
  void operator()(KeyVisitor& v, SphereShape& sphere) const {
    visit(v, {"radius", "m", above(0), "of the sphere"}, sphere.radius);
    visit(v, {"segments", "", between(8, 1024), "around the equator: 128 leave no corners that are seen"},
          sphere.segments);
  }
  void operator()(KeyVisitor& v, BoxShape& box) const {
    visit(v, {"size", "m", above(0), "along x, y, z"}, box.size);
    visit(v, {"uv_repeat", "", above(0), "how often a texture repeats over a face"}, box.uvRepeat);
  }
  void operator()(KeyVisitor& v, RectangleShape& rectangle) const {
    visit(v, {"width", "m", above(0), "along x"}, rectangle.width);
    visit(v, {"height", "m", above(0), "along y; it faces +z"}, rectangle.height);
    visit(v, {"uv_repeat", "", above(0), "how often a texture repeats"}, rectangle.uvRepeat);
  }
  void operator()(KeyVisitor& v, MeshShape& mesh) const {
    Key file{"file", "", anyValue, "OBJ, PLY, STL or binary glTF (.glb), relative to the scene file"};
    file.required = true;
    visit(v, file, mesh.file);
    visit(v, {"scale", "m", above(0), "length of one unit of the file"}, mesh.scale);
    visit(v, {"shell_thickness", "m", above(0), "of the wall of open pieces, for their mass"}, mesh.shellThickness);
  }
  void operator()(KeyVisitor& v, PaneSettings& pane) const {
    v.enter({"outline", "", anyValue, "of the pane"}, true);
    visitAlternatives(v, outlineNames, pane.outline,
                      [](KeyVisitor& inner, auto& outline) { describeOutline(inner, outline); });
    v.leave();
    // A rectangle's measures stand in the shape itself; no other outline has any there.
    if (auto* rectangle = std::get_if<RectangleOutline>(&pane.outline)) {
      visit(v, {"width", "m", above(0), "along x, of a rectangular pane"}, rectangle->width);
      visit(v, {"height", "m", above(0), "along y, of a rectangular pane"}, rectangle->height);
    }
    visit(v, {"thickness", "m", above(0), "along z"}, pane.thickness);
    visit(v, {"points", "", between(0, 1e6), "inside the pane, which become corners of shards"}, pane.points);
    v.enter({"pattern", "", anyValue, "where the points lie"}, true);
    visitAlternatives(v, patternNames, pane.pattern,
                      [](KeyVisitor& inner, auto& pattern) { describePattern(inner, pattern); });
    v.leave();
    visitType(v, {"triangulation", "", anyValue, "trisection gives splinters, delaunay even shards"},
              triangulationNames, pane.triangulation);
  }

 private:
  static void describeOutline(KeyVisitor&, RectangleOutline&) {}
  static void describeOutline(KeyVisitor& v, DiscOutline& disc) {
    visit(v, {"radius", "m", above(0), "of the disc"}, disc.radius);
  }
  static void describeOutline(KeyVisitor& v, PolygonOutline& polygon) {
    Key corners{"corners", "m", anyValue,
                "in order around it, either way; it may be concave, and must not touch itself"};
    corners.required = true;
    visit(v, corners, polygon.corners);
  }
  static void describePattern(KeyVisitor&, UniformPoints&) {}
  static void describePattern(KeyVisitor&, BlueNoisePoints&) {}
  static void describePattern(KeyVisitor& v, ImpactPoints& pattern) {
    visit(v, {"impact", "m", anyValue, "where the pane was struck, inside the outline"}, pattern.impact);
    visit(v, {"spokes", "", between(3, 1000), "radial cracks"}, pattern.spokes);
    visit(v, {"finest", "m", above(0), "radius of the innermost arc of cracks; further ones lie ever farther apart"},
          pattern.finest);
    visit(v, {"irregularity", "", between(0, 1), "0 is a spider's web"}, pattern.irregularity);
  }
};

void describeBodyPlace(KeyVisitor& v, BodyKeys& keys) {
  visit(v, {"position", "m", anyValue, "of the shape's origin", {"pos (body)", "3.1"}}, keys.body.pose.position);
  visit(v,
        {"rotation_degrees",
         "degrees",
         anyValue,
         "about the x, then y, then z axis of the scene",
         {"alpha (body)", "3.1"},
         "no rotation"},
        keys.rotationDegrees);
  visit(v, {"orientation", "", anyValue, "quaternion w, x, y, z, in place of rotation_degrees", {}, "no rotation"},
        keys.orientation);
  visit(v, {"moves", "", anyValue, "false for scenery", {}, "true; false for a rectangle"}, keys.moves);
  visit(v, {"blocks_gas", "", anyValue, "scenery that gas flows around"}, keys.body.blocksGas);
  visit(v, {"release_time", "s", atLeast(0), "until then it rests in place; simulated time"}, keys.body.releaseTime);
  visit(v, {"swells", "", anyValue, "until its release gas carries the vertices of its surface: a balloon"},
        keys.body.swells);
}

void describeBodyMass(KeyVisitor& v, BodyKeys& keys) {
  visit(v,
        {"density",
         "kg/m3",
         above(0),
         "mass by volume; one of density, mass and mass_per_area",
         {},
         "2500, unless mass or mass_per_area is written"},
        keys.density);
  visit(v, {"mass", "kg", above(0), "of the whole body, shared out by volume", {"m (body)", "3.1"}, "from density"},
        keys.mass);
  visit(v, {"mass_per_area", "kg/m2", above(0), "mass by surface, as the thesis' windows have it", {}, "from density"},
        keys.massPerArea);
}

void describeMethod(KeyVisitor&, BreadthFirst&) {}
void describeMethod(KeyVisitor& v, BreadthFirstThesis& method) {
  visitChoice(v, {"split", "", anyValue, "where Algorithm 5 cuts: half of the list, or half of the levels"}, splitNames,
              method.split);
}
void describeMethod(KeyVisitor& v, Curvature& method) {
  visitChoice(v, {"weights", "", anyValue, "clipped suits noisy meshes, raw is the formula as it stands"},
              curvatureWeightNames, method.weights);
  visit(v, {"parts", "", between(0, 1e5), "cut by curvature, and further breadth-first inside; 0: all by curvature"},
        method.parts);
  visitChoice(v, {"inside", "", anyValue, "which parts are broken further"}, insideNames, method.inside);
}
void describeMethod(KeyVisitor& v, Spectral& method) {
  visitChoice(v, {"weights", "", anyValue, "all edges alike, or by their length"}, edgeWeightNames, method.weights);
}
void describeMethod(KeyVisitor& v, Voronoi& method) {
  visit(v, {"impact", "m", anyValue, "pieces are smaller near this point of the body", {}, "none: even cells"},
        method.impact);
  visit(v, {"crowding", "", between(0, 10), "how much smaller"}, method.crowding);
}

void describePush(KeyVisitor& v, Drag& push) {
  visit(v, {"force_constant", "kg/m3", atLeast(0), "force per area = this |dv| dv", {"F_c", "5.1, 5.3"}},
        push.forceConstant);
  visitType(v, {"quadrature", "", anyValue, "vertex_sum is the thesis' choice: finer meshes are pushed harder"},
            quadratureNames, push.quadrature);
  visit(v, {"parallel_only", "", anyValue, "the thesis' choice: only the force along the arm accelerates"},
        push.parallelOnly);
  visit(v, {"small_piece_favour", "", between(0, 10), "force times (mean area / area) to this power"},
        push.smallPieceFavour);
}
void describePush(KeyVisitor&, Pressure&) {}

void describeCollisions(KeyVisitor&, NoCollisions&) {}
void describeCollisions(KeyVisitor& v, Contacts& contacts) {
  visit(v, {"friction", "", between(0, 10), "Coulomb's coefficient, of all bodies"}, contacts.friction);
  visit(v, {"restitution", "", between(0, 1), "speed of parting over speed of meeting"}, contacts.restitution);
}

void describeFracture(KeyVisitor& v, FractureSettings& fracture) {
  v.enter({"method", "", anyValue, "how pieces are chosen"}, true);
  visitAlternatives(v, fractureMethodNames, fracture.method,
                    [](KeyVisitor& inner, auto& method) { describeMethod(inner, method); });
  v.leave();
  visit(v, {"pieces", "", between(1, 1e5), "1 leaves it whole", {"n_r", "5.1, 5.3"}}, fracture.pieces);
  visit(v, {"refine", "", anyValue, "shorten the cuts and even out the sizes afterwards"}, fracture.refine);
  visit(v,
        {"minimum_share", "", between(0, 1),
         "least size of a piece, relative to the mean; of solid ones by curvature or spectral 0.1 or more"},
        fracture.minimumShare);
  visit(v, {"solid", "", anyValue, "pieces of a closed mesh are solids instead of shells"}, fracture.solid.enabled);
  visit(v,
        {"cells_per_piece", "", between(0, 1e4), "of solid pieces: how rough the inside faces are; 0: by the method"},
        fracture.solid.cellsPerPiece);
  visit(v, {"flat", "", anyValue, "inside faces of solid pieces are flat"}, fracture.solid.flat);
}

}  // namespace

void describeGas(KeyVisitor& v, SceneDraft& draft) {
  FluidSettings& gas = draft.scene.simulation.fluid;
  describeLattice(v, draft.gas, {"nx, ny, nz", "5.1, 5.3"});
  visitTable(v, "faces", "what the faces of the box are", gas.faces, describeFaces);
  visitTable(v, "wall_velocity", "of faces that are no_slip walls", gas.wallVelocity, describeWallVelocity);
  visitChoice(v,
              {"bodies", "", anyValue,
               "bodies that move: gas passes through them, as in the thesis, or they block and carry it"},
              bodiesInGasNames, draft.scene.simulation.bodiesInGas);
  visit(v, {"remove_mean_source", "", anyValue, "in a sealed space: let the gas that has no way out vanish"},
        gas.removeMeanSource);
  v.enter({"advection", "", anyValue, "how the flow carries things"}, true);
  visitAlternatives(v, advectionNames, gas.advection,
                    [](KeyVisitor& inner, auto& scheme) { describeAdvection(inner, scheme); });
  v.leave();
  v.enter({"pressure", "", anyValue, "how the pressure is solved for"}, true);
  visitAlternatives(v, pressureNames, gas.pressure,
                    [](KeyVisitor& inner, auto& solver) { describePressure(inner, solver); });
  v.leave();
  describeGasPhysics(v, gas);
  visitArray(v, {"stirring", "", anyValue, "cylinders of gas that are kept turning"}, gas.stirring, Stirring{},
             describeStirring);
  visit(v, {"courant", "", {0.01, 10}, "cells that the gas may cross in one sub-step"}, gas.courant);
  visit(v, {"max_substeps", "", between(1, 1e6), "per frame, beyond which the run stops as unstable"}, gas.maxSubsteps);
}

void describeBits(KeyVisitor& v, BitSettings& bits) {
  visit(v, {"radius", "m", above(0), "of each: the smaller, the sooner gas has slowed it or carries it"}, bits.radius);
  visit(v, {"density", "kg/m3", above(0), "of their matter"}, bits.density);
  visit(v, {"cooling_time", "s", above(0), "in which they come to the gas' temperature, to 1/e"}, bits.coolingTime);
}

void describeExplosion(KeyVisitor& v, ParticleSettings& particles) {
  describeBurning(v, particles.burning);
  describeSootAndHeat(v, particles.burning);
  visitArray(v, {"charges", "", anyValue, "fuel laid out on a sphere at a time"}, particles.charges, Charge{},
             describeCharge);
  visitTable(v, "sparks", "what sparks are; charges throw them", particles.sparks, describeBits);
  visitTable(v, "dust", "what dust is; bodies give it", particles.dust, describeBits);
}

void describeRigid(KeyVisitor& v, RigidSettings& rigid) {
  visit(v, {"gravity", "m/s2", anyValue, "on bodies"}, rigid.gravity);
  Key push{"push", "", anyValue, "how gas pushes bodies"};
  push.fallback = "drag";
  v.enter(push, true);
  visitAlternatives(v, pushNames, rigid.push, [](KeyVisitor& inner, auto& kind) { describePush(inner, kind); });
  v.leave();
  Key collisions{"collisions", "", anyValue,
                 "none: bodies pass through one another, as in the thesis; contacts: they stop one another"};
  collisions.fallback = "none";
  v.enter(collisions, true);
  visitAlternatives(v, collisionNames, rigid.collisions,
                    [](KeyVisitor& inner, auto& kind) { describeCollisions(inner, kind); });
  v.leave();
}

void describeBody(KeyVisitor& v, BodyKeys& keys) {
  Key name{"name", "", anyValue, "unique; letters, digits, _ and -"};
  name.required = true;
  visit(v, name, keys.body.name);
  Key shape{"shape", "", anyValue, "what it is"};
  shape.required = true;
  v.enter(shape, true);
  visitAlternatives(v, shapeNames, keys.body.shape, ShapeKeys{});
  v.leave();
  describeBodyPlace(v, keys);
  visit(v, {"material", "", anyValue, "name of one of the materials"}, keys.body.material);
  describeBodyMass(v, keys);
  visit(v, {"temperature", "K", atLeast(0), "of the body"}, keys.body.temperature);
  visit(v,
        {"warming_time",
         "s",
         atLeast(0),
         "in which a piece comes to the mean temperature of the gas at its surface, to 1/e",
         {},
         "none: it keeps its temperature"},
        keys.body.warmingTime);
  visit(v, {"dust", "", between(0, 1e6), "grains that come off its pieces when they are released"}, keys.body.dust);
  visit(v,
        {"bond_strength", "Pa", atLeast(0),
         "tension, shear and bending between pieces at which they come apart; until then they move as one; 0: they are "
         "apart from the start"},
        keys.body.bondStrength);
  visitTable(v, "fracture", "how it breaks, before time starts", keys.body.fracture, describeFracture);
}

}  // namespace brisance
