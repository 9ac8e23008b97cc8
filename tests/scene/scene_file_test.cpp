// What a scene means, and that writing it keeps it.
#include "scene/scene_file.h"

#include "scene/estimate.h"
#include "scene_fixture.h"

namespace brisance {
namespace {

Scene parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parseScene(text, "s.toml", overrides);
}

/// Uses every table and every alternative.
std::string fullScene() {
  return R"(
[scene]
seed = 42
frames = 7
fps = 30
time_scale = 0.1
checkpoint_every = 3
[gas]
corner = [-1, 0.1, -1]
size = [2.0, 1.0, 2.0]
resolution = 30
faces = { y_lower = "free_slip", z_upper = "no_slip" }
advection = { type = "donor_cell", upwind_weight = 0.9 }
pressure = { type = "multigrid", tolerance = 1e-7 }
force = [0.1, -0.2, 0.3]
wall_velocity = { z_upper = [0.5, -1, 0] }
[[gas.stirring]]
centre = [0, 0.6, 0]
radius = 0.4
angular_speed = -2
[[gas.stirring]]
length = 0.1
[explosion]
burn_rate = 0.21
soot_once = true
[[explosion.charges]]
position = [0, 0.5, 0]
particles = 100
[[explosion.charges]]
position = [0.1, 0.5, 0]
time = 0.25
emission_rate = 33.3
[rigid]
gravity = [0, -1.62, 0]
push = { quadrature = "vertex_sum", parallel_only = true }
[[bodies]]
name = "pane"
shape = { type = "pane", width = 1.44, height = 1.92, triangulation = "delaunay" }
fracture = { method = "breadth_first", pieces = 16 }
rotation_degrees = [10, 20, 30]
mass_per_area = 12.5
[[bodies]]
name = "ball"
shape = "sphere"
mass = 2
material = "iron"
release_time = 0.5
[[bodies]]
name = "ground"
shape = { type = "rectangle", width = 10, uv_repeat = [3, 4] }
[[bodies]]
name = "wall"
shape = { type = "box", size = [1, 2, 0.1] }
moves = false
blocks_gas = true
density = 1800
[camera]
focal_length_mm = 35
shutter = 0.5
[[camera.keys]]
time = 0
position = [0, 1, 7]
[[camera.keys]]
time = 0.1
position = [1, 1, 7]
fov_degrees = 25
[[materials]]
name = "iron"
colour = [0.1, 0.2, 0.3]
reflection = [0.7, 0.7, 0.7]
[[lights]]
type = "sun"
[[lights]]
type = "point"
position = [1, 2, 3]
falloff = 0
[[lights]]
type = "fire"
[render]
width = 64
[render.volume]
blackbody = "tuned_blackbody"
[film]
rate_factor = 20
)";
}

TEST(SceneFile, WrittenOutAndReadBackItIsTheSame) {
  for (const std::string& text : {std::string(), fullScene()}) {
    const Scene scene = parsed(text);
    const std::string written = writeScene(scene);
    const Scene again = parsed(written);
    EXPECT_EQ(writeScene(again), written);
    EXPECT_EQ(again.simulation.frameTime, scene.simulation.frameTime);
    EXPECT_EQ(again.simulation.fluid.cells, scene.simulation.fluid.cells);
    EXPECT_EQ(again.simulation.fluid.cellSize, scene.simulation.fluid.cellSize);
    EXPECT_EQ(again.simulation.fluid.faces, scene.simulation.fluid.faces);
    EXPECT_EQ(again.render.volume.cellSize, scene.render.volume.cellSize);
    ASSERT_EQ(again.simulation.bodies.size(), scene.simulation.bodies.size());
    for (std::size_t i = 0; i < scene.simulation.bodies.size(); ++i) {
      EXPECT_EQ(again.simulation.bodies[i].pose, scene.simulation.bodies[i].pose);
      EXPECT_EQ(again.simulation.bodies[i].moves, scene.simulation.bodies[i].moves);
      EXPECT_EQ(again.simulation.bodies[i].mass.index(), scene.simulation.bodies[i].mass.index());
    }
    ASSERT_EQ(again.render.camera.keys.size(), scene.render.camera.keys.size());
    for (std::size_t i = 0; i < scene.render.camera.keys.size(); ++i)
      EXPECT_EQ(again.render.camera.keys[i].fovDegrees, scene.render.camera.keys[i].fovDegrees);
  }
}

TEST(SceneFile, EveryTableLandsInItsSettings) {
  const Scene scene = parsed(fullScene());
  const SimulationSettings& s = scene.simulation;
  EXPECT_EQ(s.seed, 42u);
  EXPECT_EQ(s.frames, 7);
  EXPECT_EQ(s.frameTime, 0.1 / 30);
  EXPECT_EQ(s.fluid.cells, Vec3i(30, 15, 30));
  EXPECT_EQ(s.fluid.cellSize, 2.0 / 30);
  EXPECT_EQ(s.fluid.faces[2], FaceKind::freeSlip);
  EXPECT_EQ(s.fluid.faces[5], FaceKind::noSlip);
  EXPECT_EQ(s.fluid.faces[0], FaceKind::open);
  EXPECT_EQ(std::get<DonorCell>(s.fluid.advection).upwindWeight, 0.9);
  EXPECT_EQ(s.particles.burning.burnRate, 0.21);
  ASSERT_EQ(s.particles.charges.size(), 2u);
  EXPECT_EQ(s.particles.charges[1].time, 0.25);
  EXPECT_TRUE(std::holds_alternative<VertexSum>(std::get<Drag>(s.rigid.push).quadrature));
  EXPECT_EQ(s.bodies[0].fracture.pieces, 16);
  EXPECT_TRUE(std::holds_alternative<Delaunay>(std::get<PaneSettings>(s.bodies[0].shape).triangulation));
  EXPECT_EQ(std::get<MassPerArea>(s.bodies[0].mass).perArea, 12.5);
  EXPECT_EQ(std::get<MassGiven>(s.bodies[1].mass).mass, 2.0);
  EXPECT_EQ(s.bodies[0].material, "plain");
  EXPECT_FALSE(s.bodies[2].moves);
  EXPECT_TRUE(s.bodies[3].blocksGas);
  EXPECT_EQ(scene.render.seed, 42u);
  EXPECT_EQ(scene.render.volume.corner, s.fluid.corner);
  EXPECT_TRUE(std::holds_alternative<TunedBlackbody>(scene.render.volume.blackbody));
  EXPECT_EQ(std::get<PointLight>(scene.render.lights[1]).position, Vec3d(1, 2, 3));
  EXPECT_EQ(std::get<SolidColour>(scene.render.materials.at("iron").diffuse).colour, Vec3f(.1f, .2f, .3f));
}

TEST(SceneFile, BodiesBreakByEveryMethodWithItsOwnKnobs) {
  const auto fractureOf = [](const std::string& fracture) {
    return parsed("[[bodies]]\nname = 'a'\nshape = 'sphere'\nfracture = { pieces = 8, " + fracture + " }\n")
        .simulation.bodies[0]
        .fracture;
  };
  EXPECT_TRUE(std::holds_alternative<BreadthFirst>(fractureOf("refine = true").method));
  const FractureSettings curved =
      fractureOf("method = { type = 'curvature', weights = 'raw', parts = 2, inside = 'smallest' }, solid = true");
  EXPECT_EQ(std::get<Curvature>(curved.method).weights, CurvatureWeights::raw);
  EXPECT_EQ(std::get<Curvature>(curved.method).parts, 2);
  EXPECT_EQ(std::get<Curvature>(curved.method).inside, InsideParts::smallest);
  EXPECT_TRUE(curved.solid.enabled);
  EXPECT_EQ(std::get<Spectral>(fractureOf("method = { type = 'spectral', weights = 'length' }").method).weights,
            EdgeWeights::length);
  EXPECT_EQ(
      std::get<BreadthFirstThesis>(fractureOf("method = { type = 'breadth_first_thesis', split = 'level' }").method)
          .split,
      ThesisSplit::level);
  const FractureSettings cells =
      fractureOf("method = { type = 'voronoi', impact = [0, 0.5, 0], crowding = 3 }, cells_per_piece = 4, flat = true");
  EXPECT_EQ(std::get<Voronoi>(cells.method).impact, Vec3d(0, 0.5, 0));
  EXPECT_EQ(std::get<Voronoi>(cells.method).crowding, 3);
  EXPECT_EQ(cells.solid.cellsPerPiece, 4);
  EXPECT_TRUE(cells.solid.flat);
}

TEST(SceneFile, PanesHaveOutlinesAndPatterns) {
  const auto paneOf = [](const std::string& shape) {
    const std::string text = "[scene]\nmetres_per_unit = 0.5\n[[bodies]]\nname = 'a'\nshape = " + shape + "\n";
    const Scene scene = parsed(text);
    EXPECT_EQ(writeScene(parsed(writeScene(scene))), writeScene(scene));
    return std::get<PaneSettings>(scene.simulation.bodies[0].shape);
  };
  EXPECT_EQ(paneOf("{ type = 'pane', width = 3 }").outline, Outline(RectangleOutline{1.5, 1}));
  EXPECT_EQ(paneOf("{ type = 'pane', outline = 'disc' }").outline, Outline(DiscOutline{0.5}));
  EXPECT_EQ(paneOf("{ type = 'pane', outline = { type = 'disc', radius = 4 } }").outline, Outline(DiscOutline{2}));
  EXPECT_EQ(paneOf("{ type = 'pane', outline = { type = 'polygon', corners = [[0, 0], [2, 0], [0, 4.5]] } }").outline,
            Outline(PolygonOutline{{{0, 0}, {1, 0}, {0, 2.25}}}));
  EXPECT_EQ(paneOf("{ type = 'pane', pattern = 'blue_noise' }").pattern, PointPattern(BlueNoisePoints{}));
  ImpactPoints blow;
  blow.impact = {0.1, -0.2};
  blow.spokes = 12;
  EXPECT_EQ(paneOf("{ type = 'pane', pattern = { type = 'impact', impact = [0.2, -0.4], spokes = 12 } }").pattern,
            PointPattern(blow));
}

TEST(SceneFile, FocalLengthAndSensorGiveTheFieldOfView) {
  const Scene scene = parsed(fullScene());
  ASSERT_EQ(scene.render.camera.keys.size(), 2u);
  EXPECT_DOUBLE_EQ(scene.render.camera.keys[0].fovDegrees, 2 * std::atan(12.0 / 35) * 180 / pi);
  EXPECT_EQ(scene.render.camera.keys[1].fovDegrees, 25.0);
}

TEST(SceneFile, RotationsTurnAboutXThenYThenZ) {
  const Scene scene = parsed("[[bodies]]\nname = 'a'\nshape = 'box'\nrotation_degrees = [90, 0, 90]\n");
  // z goes to -y about x, and -y to x about z.
  const Vec3d turned = rotate(scene.simulation.bodies[0].pose.orientation, Vec3d(0, 0, 1));
  EXPECT_NEAR(length(turned - Vec3d(1, 0, 0)), 0, 1e-14);
}

TEST(SceneFile, LengthsCountInSceneUnitsAndNothingElseDoes) {
  const std::string body =
      "[[bodies]]\nname = 'a'\nshape = { type = 'box', size = [100, 50, 25] }\nposition = [10, 0, 0]\n";
  const Scene scene =
      parsed("[scene]\nmetres_per_unit = 0.01\n[gas]\nsize = [480, 480, 480]\nviscosity = 0.5\n" + body);
  EXPECT_NEAR(scene.simulation.fluid.cellSize * 64, 4.8, 1e-12);
  EXPECT_EQ(scene.simulation.fluid.viscosity, 0.5);
  EXPECT_DOUBLE_EQ(std::get<BoxShape>(scene.simulation.bodies[0].shape).size.x, 1.0);
  EXPECT_DOUBLE_EQ(scene.simulation.bodies[0].pose.position.x, 0.1);
  EXPECT_EQ(parsed("[scene]\nmetres_per_unit = 0.01\n").simulation.particles.burning.radius, BurnSettings{}.radius);
  const std::string written = writeScene(scene);
  EXPECT_EQ(writeScene(parsed(written)), written);
}

TEST(SceneFile, AnyTwoMeasuresOfABoxGiveTheThird) {
  const auto gas = [](const std::string& keys) { return parsed("[gas]\n" + keys).simulation.fluid; };
  EXPECT_EQ(gas("size = [2, 1, 1]\ncells = [20, 10, 10]").cellSize, 0.1);
  EXPECT_EQ(gas("size = [2, 1, 1]\ncell_size = 0.1").cells, Vec3i(20, 10, 10));
  EXPECT_EQ(gas("cells = [20, 10, 10]\ncell_size = 0.1").cells, Vec3i(20, 10, 10));
  EXPECT_EQ(gas("cells = [20, 10, 10]").cellSize, 0.05);
  EXPECT_EQ(gas("size = [1, 0.55, 1]\nresolution = 10").cells, Vec3i(10, 6, 10)) << "whole cells cover the size";
}

TEST(SceneFile, TheVolumeCoversTheGasUnlessItSaysOtherwise) {
  const Scene scene = parsed("[gas]\ncorner = [1, 2, 3]\nsize = [4, 2, 2]\n[render.volume]\nresolution = 40\n");
  EXPECT_EQ(scene.render.volume.corner, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.render.volume.cells, Vec3i(40, 20, 20));
  EXPECT_EQ(scene.render.volume.cellSize, 0.1);
  const Scene cube = parsed("[gas]\nsize = [4, 2, 2]\n[render.volume]\ncells = [30, 30, 30]\n");
  EXPECT_DOUBLE_EQ(cube.render.volume.cellSize * 30, 4.0);
}

TEST(Presets, ChangeDefaultsAndYieldToEveryWrittenKey) {
  const Scene plain = parsed(""), draft = parsed("[scene]\nquality = 'draft'\n"),
              fine = parsed("", {"scene.quality=final"});
  EXPECT_LT(draft.render.width, plain.render.width);
  EXPECT_LT(draft.simulation.fluid.cells.x, plain.simulation.fluid.cells.x);
  EXPECT_LT(draft.render.volume.cells.x, plain.render.volume.cells.x);
  EXPECT_GT(fine.render.width, plain.render.width);
  EXPECT_GT(fine.simulation.fluid.cells.x, plain.simulation.fluid.cells.x);
  const Scene kept = parsed("[scene]\nquality = 'draft'\n[render]\nwidth = 500\n[gas]\ncells = [70, 70, 70]\n");
  EXPECT_EQ(kept.render.width, 500);
  EXPECT_EQ(kept.simulation.fluid.cells.x, 70);
  EXPECT_EQ(kept.render.height, draft.render.height);
}

TEST(Overrides, ReachEveryKeyByNameAndByNumber) {
  const Scene scene = parsed(
      fullScene(), {"bodies.pane.fracture.pieces=32", "bodies.1.mass=3.5", "scene.quality=draft",
                    "gas.advection.upwind_weight=0.5", "camera.position=[0, 0, 9]", "bodies.ball.shape.radius=0.25",
                    "explosion.charges.1.time=0.5", "render.volume.drawn=false", "lights.0.radiance=[2, 2, 2]"});
  EXPECT_EQ(scene.simulation.bodies[0].fracture.pieces, 32);
  EXPECT_EQ(std::get<MassGiven>(scene.simulation.bodies[1].mass).mass, 3.5);
  EXPECT_EQ(std::get<SphereShape>(scene.simulation.bodies[1].shape).radius, 0.25) << "a type alone becomes a table";
  EXPECT_EQ(std::get<DonorCell>(scene.simulation.fluid.advection).upwindWeight, 0.5);
  EXPECT_EQ(scene.simulation.particles.charges[1].time, 0.5);
  EXPECT_EQ(scene.render.samples, 1);
  EXPECT_FALSE(scene.render.volume.drawn);
  EXPECT_EQ(std::get<SunLight>(scene.render.lights[0]).radiance, Vec3f(2, 2, 2));
  EXPECT_EQ(parsed("", {"gas.viscosity=0.25"}).simulation.fluid.viscosity, 0.25) << "a table that was not there";
}

TEST(Overrides, MistakesNameTheOption) {
  const auto line = [](const std::string& assignment) { return troubleOf(fullScene(), {assignment}).line; };
  EXPECT_EQ(line("gas.viscosity=-1"), "--set: gas.viscosity: must be at least 0 [m2/s], got -1");
  EXPECT_EQ(line("gas.viscosty=1"), "--set: gas.viscosty: unknown key; did you mean viscosity?");
  EXPECT_EQ(line("bodies.door.mass=1"),
            "--set: bodies.door.mass: there is no door; there are pane, ball, ground, wall");
  EXPECT_EQ(line("gas.viscosity"), "--set: must be key.path=value, got gas.viscosity");
  EXPECT_EQ(line("=1"), "--set: must be key.path=value, got =1");
  EXPECT_EQ(line("gas..viscosity=1"), "--set: gas..viscosity: must be names joined by dots");
  EXPECT_EQ(line("gas.viscosity.x=1"), "--set: gas.viscosity: must be a number [m2/s], got { x = 1 }");
  EXPECT_EQ(line("camera.position=[1, 2"), "--set: camera.position: must be a TOML value or a plain word, got [1, 2");
  EXPECT_EQ(line("scene.frames.x=1"), "--set: scene.frames.x: x stands inside a value that is no table");
  EXPECT_EQ(line("bodies.pane.material=gold"),
            "--set: bodies.pane.material: must name one of the materials (iron, plain), got \"gold\"");
}

TEST(Inputs, AreAbsoluteAndCanBeMovedIntoARun) {
  const FreshDirectory directory;
  directory.write("assets/a.png", "a");
  directory.write("assets/m.obj", "m");
  const auto file = directory.write("scenes/s.toml",
                                    "[[bodies]]\nname = 'm'\nshape = { type = 'mesh', file = '../assets/m.obj' }\n"
                                    "[[materials]]\nname = 'a'\ntexture = '../assets/a.png'\n"
                                    "[[materials]]\nname = 'b'\ntexture = '../assets/a.png'\n");
  const Scene scene = readScene(file);
  const auto mesh = directory.path() / "assets/m.obj", picture = directory.path() / "assets/a.png";
  ASSERT_EQ(scene.inputs, (std::vector<std::filesystem::path>{mesh, picture}));
  const Scene moved = withInputs(scene, {{mesh, "inputs/1.obj"}, {picture, "inputs/2.png"}});
  directory.write("run/inputs/1.obj", "m");
  directory.write("run/inputs/2.png", "a");
  const std::string written = writeScene(moved);
  EXPECT_NE(written.find("file = \"inputs/1.obj\""), std::string::npos);
  const Scene again = readScene(directory.write("run/scene.toml", written));
  EXPECT_EQ(again.inputs, (std::vector<std::filesystem::path>{directory.path() / "run/inputs/1.obj",
                                                              directory.path() / "run/inputs/2.png"}));
  EXPECT_EQ(std::get<ImageTexture>(again.render.materials.at("b").diffuse).file, directory.path() / "run/inputs/2.png");
}

/// Empty files stand in for pictures and meshes that are made elsewhere.
TEST(Scenes, EverySceneOfTheProjectReads) {
  const std::filesystem::path source(BRISANCE_SOURCE_DIR);
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    const FreshDirectory directory;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t at = text.find("\"../"); at != std::string::npos; at = text.find("\"../", at + 1))
      directory.write(text.substr(at + 4, text.find('"', at + 1) - at - 4), "");
    const Scene scene = readScene(directory.write("scenes/s.toml", text));
    EXPECT_GT(estimate(scene).pieces, 0) << entry.path();
    EXPECT_EQ(writeScene(readScene(directory.write("scenes/t.toml", writeScene(scene)))), writeScene(scene));
  }
  EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace brisance
