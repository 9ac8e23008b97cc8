// Every kind of mistake in a scene is one line that names the place, what is wrong and what would be right.
#include <chrono>

#include "scene/estimate.h"
#include "scene_fixture.h"

namespace brisance {
namespace {

void expectLine(const std::string& text, const std::string& line, ExitCode code = ExitCode::badScene) {
  const Trouble trouble = troubleOf(text);
  EXPECT_EQ(trouble.line, line);
  EXPECT_EQ(trouble.code, code);
}

TEST(SceneErrors, AnEmptySceneIsRight) { expectLine("", "nothing", ExitCode::done); }

TEST(SceneErrors, AnUnknownKeySuggestsTheNearestKnownOne) {
  expectLine("[gas]\nviscosty = 1\n", "s.toml:2: gas.viscosty: unknown key; did you mean viscosity?");
  expectLine("[explosion]\n\nburnrate = 1\n", "s.toml:3: explosion.burnrate: unknown key; did you mean burn_rate?");
  expectLine("[gass]\n", "s.toml:1: gass: unknown key; did you mean gas?");
  expectLine("[film]\nxyzzyplugh = 1\n", "s.toml:2: film.xyzzyplugh: unknown key; must be one of rate_factor");
}

TEST(SceneErrors, AKeyOfAnotherTypeOfShapeIsUnknown) {
  expectLine("[[bodies]]\nname = 'a'\nshape = { type = 'box', radius = 1 }\n",
             "s.toml:3: bodies.a.shape.radius: unknown key; must be one of type, size, uv_repeat");
}

TEST(SceneErrors, AWrongTypeNamesTheRightOne) {
  expectLine("[gas]\nviscosity = 'thick'\n", "s.toml:2: gas.viscosity: must be a number [m2/s], got \"thick\"");
  expectLine("[scene]\nframes = 1.5\n", "s.toml:2: scene.frames: must be a whole number, got 1.5");
  expectLine("[scene]\nframes = true\n", "s.toml:2: scene.frames: must be a whole number, got true");
  expectLine("[render]\nwrite_exr = 1\n", "s.toml:2: render.write_exr: must be true or false, got 1");
  expectLine("[camera]\nposition = [1, 2]\n",
             "s.toml:2: camera.position: must be 3 numbers in brackets [m], got [1, 2]");
  expectLine("[[bodies]]\nname = 3\n", "s.toml:2: bodies.0.name: must be a text in quotes, got 3");
  expectLine("gas = 3\n", "s.toml:1: gas: must be a table, got 3");
  expectLine("[bodies]\nname = 'a'\n", "s.toml:1: bodies: must be tables [[bodies]], got { name = \"a\" }");
  expectLine("bodies = [1]\n", "s.toml:1: bodies.0: must be a table, got 1");
  expectLine("[scene]\nseed = 1979-05-27\n", "s.toml:2: scene.seed: must be a whole number, got a date or time");
}

TEST(SceneErrors, AValueOutOfRangeNamesTheRangeAndTheUnit) {
  expectLine("[explosion]\nburn_rate = -0.21\n", "s.toml:2: explosion.burn_rate: must be above 0 [kg/s], got -0.21");
  expectLine("[explosion]\nburn_rate = 0\n", "s.toml:2: explosion.burn_rate: must be above 0 [kg/s], got 0");
  expectLine("[gas]\nviscosity = -1e-3\n", "s.toml:2: gas.viscosity: must be at least 0 [m2/s], got -0.001");
  expectLine("[gas]\nadvection = { type = 'donor_cell', upwind_weight = 1.5 }\n",
             "s.toml:2: gas.advection.upwind_weight: must be from 0 to 1, got 1.5");
  expectLine("[camera]\nfov_degrees = 180\n",
             "s.toml:2: camera.fov_degrees: must be above 0 and at most 175 [degrees], got 180");
  expectLine("[scene]\nmetres_per_unit = 0.01\n[gas]\ncell_size = 0\n",
             "s.toml:4: gas.cell_size: must be above 0 [scene units], got 0");
}

TEST(SceneErrors, NoiseIsTakenFromPathsOfTwoSamplesOrMore) {
  expectLine(
      "[render]\ndenoise = true\n",
      "s.toml:2: render.denoise: must be false unless render.integrator is path: the other has no noise of chance");
  for (const char* settings :
       {"", "integrator = 'path'\ndenoise = true\n", "integrator = { type = 'path', adaptive = false }\n"})
    expectLine(
        std::string("[render]\nsamples = 2.5\n") + settings,
        "s.toml:2: render.samples: must be whole unless render.integrator is path, adaptive and without denoise, "
        "got 2.5");
  expectLine("[render]\ndenoise = true\nintegrator = 'path'\nsamples = 1\n",
             "s.toml:2: render.denoise: needs render.samples of at least 2: half of them judge the other half");
}

TEST(SceneErrors, WallsMoveAlongThemselvesAndStirringHasAnAxis) {
  expectLine("[gas]\nwall_velocity = { y_upper = [1, 0, 0] }\n",
             "s.toml:2: gas.wall_velocity.y_upper: must be zero: this face is not no_slip");
  expectLine("[gas]\nfaces = { y_upper = 'no_slip' }\nwall_velocity = { y_upper = [1, 2, 0] }\n",
             "s.toml:3: gas.wall_velocity.y_upper: must lie in the face, got [1, 2, 0] [m/s]");
  expectLine("[[gas.stirring]]\naxis = [0, 0, 0]\n", "s.toml:2: gas.stirring.0.axis: must not be zero");
}

TEST(SceneErrors, OnlySemiLagrangianStepsMayBeLongerThanACell) {
  expectLine("[gas]\nadvection = 'maccormack'\ncourant = 1.5\n",
             "s.toml:3: gas.courant: must be at most 1 unless gas.advection is semi_lagrangian, got 1.5");
}

TEST(SceneErrors, NumbersThatAreNoneAreRefusedEverywhere) {
  for (const std::string& number : std::vector<std::string>{"nan", "inf", "-inf", "1e300"}) {
    const std::string shown = number == "1e300" ? "1e+300" : number;
    expectLine("[gas]\nviscosity = " + number + "\n",
               "s.toml:2: gas.viscosity: must be a number within 1e+15 [m2/s], got " + shown);
    expectLine("[camera]\nposition = [0, " + number + ", 0]\n",
               "s.toml:2: camera.position: must be a number within 1e+15 [m], got " + shown);
  }
}

TEST(SceneErrors, AChoiceListsWhatThereIs) {
  expectLine("[gas]\nfaces = { x_lower = 'shut' }\n",
             "s.toml:2: gas.faces.x_lower: must be one of open, no_slip, free_slip, periodic, got \"shut\"");
  expectLine("[gas]\npressure = 'multi_grid'\n",
             "s.toml:2: gas.pressure.type: must be one of auto, fast_poisson, multigrid, conjugate_gradient, got "
             "\"multi_grid\"");
  expectLine("[[lights]]\ntype = 'lamp'\n", "s.toml:2: lights.0.type: must be one of point, sun, fire, got \"lamp\"");
}

TEST(SceneErrors, WhatMakesNoSenseWithoutAValueIsAskedFor) {
  expectLine("[[bodies]]\nshape = 'box'\n",
             "s.toml:1: bodies.0.name: is missing, must be given: unique; letters, digits, _ and -");
  expectLine("[[bodies]]\nname = 'a'\n", "s.toml:1: bodies.a.shape: is missing, must be given: what it is");
  expectLine("[[bodies]]\nname = 'a'\nshape = { width = 1 }\n",
             "s.toml:3: bodies.a.shape.type: is missing, must be given: which kind");
  expectLine("[[bodies]]\nname = 'a'\nshape = 'mesh'\n",
             "s.toml:3: bodies.a.shape.file: is missing, must be given: OBJ, PLY, STL or binary glTF (.glb), "
             "relative to the scene file");
}

TEST(SceneErrors, BrokenTomlIsNamedByItsLine) {
  const Trouble trouble = troubleOf("[gas]\nviscosity = \n");
  EXPECT_EQ(trouble.code, ExitCode::badScene);
  EXPECT_EQ(trouble.line.find("s.toml:2: not TOML: "), 0u) << trouble.line;
  EXPECT_EQ(troubleOf("[gas]\n[gas]\n").line.find("s.toml:2: not TOML: "), 0u);
}

TEST(SceneErrors, ASceneOrFileThatDoesNotExistIsTheUsersMistake) {
  const FreshDirectory directory;
  try {
    readScene(directory.path() / "none.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::badScene);
    EXPECT_EQ(error.what(),
              (directory.path() / "none.toml").string() + ": must be a scene file, and there is no such file");
  }
  const auto scene = directory.write("s.toml", "[[materials]]\nname = 'a'\ntexture = 'no.png'\n");
  try {
    readScene(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ExitCode::badScene);
    EXPECT_EQ(error.what(), scene.string() + ":3: materials.a.texture: must name a file, and there is none at " +
                                (directory.path() / "no.png").string() + ", got \"no.png\"");
  }
}

TEST(SceneErrors, APaneThatCannotBeIsRefused) {
  const auto refused = [](const std::string& keys, const std::string& line) {
    expectLine("[[bodies]]\nname = 'a'\nshape = { type = 'pane', " + keys + " }\n", "s.toml:3: bodies.a.shape." + line);
  };
  refused("outline = { type = 'polygon', corners = [[0, 0], [1, 1]] }", "outline: must have at least 3 corners, got 2");
  refused("outline = { type = 'polygon', corners = [[0, 0], [1, 1], [1, 0], [0, 1]] }",
          "outline: must not cross or touch itself, its edges 1-2 and 3-4 do (corners count from 1)");
  refused("outline = { type = 'polygon' }",
          "outline.corners: is missing, must be given: in order around it, either way; it may be concave, and must not "
          "touch itself");
  refused("outline = { type = 'polygon', corners = [[0, 0], [1], [1, 0]] }",
          "outline.corners: must be places [[x, y], ...] [m], got [1]");
  refused("outline = { type = 'polygon', corners = 5 }", "outline.corners: must be places [[x, y], ...] [m], got 5");
  refused("outline = { type = 'polygon', corners = [[0, 0], [nan, 0], [1, 0]] }",
          "outline.corners: must be a number within 1e+15 [m], got nan");
  refused("outline = 'disc', width = 2",
          "width: unknown key; must be one of type, outline, thickness, points, pattern, triangulation");
  refused("pattern = { type = 'impact', impact = [0.5, 0] }",
          "pattern: impact must lie inside the outline, 0.04 m or more (twice finest) from it, got [0.5, 0]");
}

TEST(SceneErrors, ABodysMaterialMustExist) {
  expectLine("[[bodies]]\nname = 'a'\nshape = 'box'\nmaterial = 'gold'\n[[materials]]\nname = 'iron'\n",
             "s.toml:4: bodies.a.material: must name one of the materials (iron, plain), got \"gold\"");
}

TEST(SceneErrors, NamesAreUniqueAndPlain) {
  expectLine("[[bodies]]\nname = 'a'\nshape = 'box'\n[[bodies]]\nname = 'a'\nshape = 'box'\n",
             "s.toml:5: bodies.1.name: must be unique, \"a\" is there twice");
  expectLine("[[materials]]\nname = 'a'\n[[materials]]\nname = 'a'\n",
             "s.toml:4: materials.1.name: must be unique, \"a\" is there twice");
  expectLine("[[bodies]]\nname = '../a'\nshape = 'box'\n",
             "s.toml:2: bodies.0.name: must be at most 100 letters, digits, _ and -, got \"../a\"");
}

const std::string walls =
    "[gas.faces]\nx_lower = 'no_slip'\nx_upper = 'no_slip'\ny_lower = 'free_slip'\n"
    "y_upper = 'no_slip'\nz_lower = 'no_slip'\nz_upper = 'no_slip'\n";
const std::string charge = "[[explosion.charges]]\nposition = [0.5, 0.5, 0.5]\n";

TEST(SceneErrors, ASealedBoxWithAChargeIsRefusedUnlessTheMeanMayGo) {
  expectLine(walls + charge,
             "s.toml:1: gas.faces: must leave a face open: a charge makes gas and all six faces are walls "
             "(or set gas.remove_mean_source = true)");
  expectLine(walls, "nothing", ExitCode::done);
  expectLine("gas.remove_mean_source = true\n" + walls + charge, "nothing", ExitCode::done);
}

TEST(SceneErrors, AChargeLiesInsideTheBoxOfGas) {
  for (const std::string& side : std::vector<std::string>{"-1", "2"})
    expectLine("[[explosion.charges]]\nposition = [0.5, " + side + ", 0.5]\n",
               "s.toml:2: explosion.charges.0.position: must lie with its radius 0.1 inside the gas box [0, 0, 0] to "
               "[1, 1, 1] [m], got [0.5, " +
                   side + ", 0.5]");
  expectLine(charge + "particles = 5\n", "s.toml:1: explosion.charges.0.ignited: must be at most particles, 5, got 10");
}

TEST(SceneErrors, TheMeasuresOfABoxOfGasAgree) {
  expectLine("[gas]\nsize = [1, 1, 1]\ncells = [10, 10, 20]\n",
             "s.toml:3: gas.cells: must fill gas.size with cubes: 10 cells of 0.05 m along x make 0.5 m, got 1 m");
  expectLine("[gas]\ncells = [10, 10, 10]\nresolution = 20\n",
             "s.toml:3: gas.resolution: must not stand beside cells, which says the same");
  expectLine("[gas]\ncell_size = 1e-9\n",
             "s.toml:2: gas.cell_size: must make at most 4096 cells along a side, makes 1e+09");
}

TEST(SceneErrors, AnAbsurdGridFailsAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  expectLine("[gas]\ncells = [1000000, 1000000, 1000000]\n",
             "s.toml:2: gas.cells: must be from 1 to 4096, got 1000000");
  const Trouble trouble = troubleOf("[gas]\ncells = [4096, 4096, 4096]\n");
  EXPECT_EQ(trouble.code, ExitCode::noRoom);
  EXPECT_EQ(trouble.line.find("s.toml: gas of 68719476736 cells, "), 0u) << trouble.line;
  EXPECT_NE(trouble.line.find("this machine has"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
}

TEST(SceneErrors, MoreParticlesThanAnybodyCanHoldAreRefused) {
  expectLine("[explosion]\nsoot_threshold = 1e-300\n",
             "s.toml:2: explosion.soot_threshold: must be at least 3.6e-08 [kg], so that a fuel particle makes at most "
             "10000 soot particles, got 1e-300");
  const Trouble trouble = troubleOf(charge + "particles = 100000000\n");
  EXPECT_EQ(trouble.code, ExitCode::noRoom) << trouble.line;
}

TEST(SceneErrors, ACameraLooksSomewhere) {
  expectLine("[camera]\nposition = [1, 2, 3]\nlook_at = [1, 2, 3]\n",
             "s.toml:3: camera.look_at: must differ from position, got the same place");
  expectLine("[camera]\nup = [0, 0, -2]\n",
             "s.toml:2: camera.up: must not lie along the line of sight and not be zero");
  expectLine("[camera]\nfov_degrees = 30\nfocal_length_mm = 50\n",
             "s.toml:3: camera.focal_length_mm: must not stand beside fov_degrees, which says the same");
  expectLine("[[camera.keys]]\ntime = 1\n[[camera.keys]]\ntime = 1\n",
             "s.toml:4: camera.keys.1.time: must be above that of the key before, 1 [s], got 1");
}

TEST(SceneErrors, ABodyHasOneMassAndOneOrientation) {
  const std::string body = "[[bodies]]\nname = 'a'\nshape = 'sphere'\n";
  expectLine(body + "density = 1\nmass = 2\n",
             "s.toml:5: bodies.a.mass: must stand alone: at most one of density, mass and mass_per_area");
  expectLine(body + "rotation_degrees = [0, 0, 1]\norientation = [1, 0, 0, 0]\n",
             "s.toml:5: bodies.a.orientation: must not stand beside rotation_degrees, which says the same");
  expectLine(body + "orientation = [0, 0, 0, 0]\n", "s.toml:4: bodies.a.orientation: must not be zero");
}

TEST(SceneErrors, SceneryAndWhatMovesAreToldApart) {
  const std::string body = "[[bodies]]\nname = 'a'\n";
  expectLine(body + "shape = 'rectangle'\nmoves = true\n",
             "s.toml:4: bodies.a.moves: must be false: a rectangle is scenery");
  expectLine(
      body + "shape = 'box'\nblocks_gas = true\n",
      "s.toml:4: bodies.a.blocks_gas: must be false: only solid scenery (moves = false, no rectangle) blocks gas");
  expectLine(
      body + "shape = 'pane'\nswells = true\n",
      "s.toml:4: bodies.a.swells: must be false: only a hollow body that moves swells, no pane and no solid pieces");
  expectLine("gas.bodies = 'block'\n" + body + "shape = 'box'\nswells = true\n",
             "s.toml:5: bodies.a.swells: must be false where gas.bodies is block: gas passes through what it swells");
  expectLine(body + "shape = 'box'\nfracture.pieces = 13\n",
             "s.toml:4: bodies.a.fracture.pieces: must be at most the 12 triangles of the shape, got 13");
}

TEST(SceneErrors, WhatAMethodCannotBreakIsRefused) {
  const std::string box = "[[bodies]]\nname = 'a'\nshape = 'box'\n";
  expectLine(box + "fracture = { method = 'breadth_first_thesis', pieces = 6 }\n",
             "s.toml:4: bodies.a.fracture.pieces: must be a power of two for breadth_first_thesis, got 6");
  expectLine(
      box + "fracture = { method = 'breadth_first_thesis', pieces = 8, solid = true }\n",
      "s.toml:4: bodies.a.fracture.method: must be another for solid pieces: breadth_first_thesis cuts triangles");
  expectLine(box + "fracture = { method = { type = 'curvature', split = 'list' }, pieces = 2 }\n",
             "s.toml:4: bodies.a.fracture.method.split: unknown key; must be one of type, weights, parts, inside");
}

TEST(SceneErrors, PicturesNumbersAgree) {
  expectLine("[render.volume]\nmin_density = 0.5\nmax_density = 0.5\n",
             "s.toml:2: render.volume.min_density: must be below max_density, 0.5, got 0.5");
  expectLine("[render.volume]\nfilter_size = 4\n",
             "s.toml:2: render.volume.filter_size: must be odd, or 0 for three deviations, got 4");
  expectLine("[[lights]]\ntype = 'sun'\ndirection = [0, 0, 0]\n", "s.toml:3: lights.0.direction: must not be zero");
  expectLine("[gas]\nmaximum_temperature = 300\n",
             "s.toml:2: gas.maximum_temperature: must be above gas.ambient_temperature, 300 [K], got 300");
}

/// One line of bounded length with exit code 2.
void expectOneLine(const std::string& text) {
  const Trouble trouble = troubleOf(text);
  EXPECT_EQ(trouble.code, ExitCode::badScene);
  EXPECT_LT(trouble.line.size(), 600u);  // room for the names of all keys of a table
  EXPECT_EQ(trouble.line.find_first_of("\n\r\t\x1b"), std::string::npos) << trouble.line;
}

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

TEST(HostileScenes, DeepNestingEndsInOneLine) {
  expectOneLine("a = " + repeated("[", 100000));
  expectOneLine("a = " + repeated("{a=", 100000));
  expectOneLine(repeated("a.", 100000) + "a = 1\n");
  expectOneLine(std::string("[") + repeated("a.", 100000) + "a]\n");
  expectOneLine(std::string("[") + repeated("'a' . ", 100000) + "a]\n");
  expectOneLine("a = " + repeated("[{" + repeated("a.", 30) + "a = ", 120) + "1" + repeated("}]", 120) + "\n");
}

TEST(HostileScenes, BinaryAndHugeTextsEndInOneLine) {
  std::string binary;
  for (int i = 0; i < 4096; ++i) binary += static_cast<char>((i * 7919) >> 3);
  expectOneLine(binary);
  expectOneLine(std::string("[gas]\0", 6));
  expectOneLine("\xff\xfe\x80");
  expectOneLine("[gas]\nviscosity = '" + std::string(1000000, 'x') + "'\n");
  expectOneLine("[gas]\n\"" + std::string(1000000, 'x') + "\" = 1\n");
  expectOneLine("[[bodies]]\nname = \"a\\u001b[31m\\n\"\nshape = 'box'\n");
  expectOneLine("[gas]\n\"a\\u001b\\nb\" = 1\n");
  expectOneLine("[gas]\nviscosity = [" + repeated("1, ", 100000) + "]\n");
  expectOneLine("a = 99999999999999999999\n");
  expectOneLine(std::string((16u << 20) + 1, '#'));
}

}  // namespace
}  // namespace brisance
