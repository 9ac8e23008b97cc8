#include "mesh/mesh_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "base/check.h"
#include "base/random.h"
#include "mesh/mesh_samples.h"
#include "mesh/mesh_topology.h"
#include "mesh/shapes.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

class MeshFile : public testing::Test {
 protected:
  std::filesystem::path path() const { return scratch_ / "mesh.obj"; }
  TriangleMesh read(const std::string& text) const {
    std::ofstream(path(), std::ios::binary) << text;
    return readObj(path());
  }
  /// The message of the DamagedFile that reading throws, without the file's name; empty if it throws nothing.
  std::string complaint(const std::string& text) const {
    try {
      read(text);
    } catch (const DamagedFile& error) {
      EXPECT_EQ(error.code, ExitCode::badInput);
      EXPECT_TRUE(std::string_view(error.what()).starts_with(path().string() + ":"));
      EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
      return std::string(error.what()).substr(path().string().size() + 1);
    }
    return "";
  }

  ScratchDirectory scratch_;
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(MeshFile, ReadsBackWhatItWrote) {
  TriangleMesh painted = boxMesh({0.1, 1.0 / 3, 2e-7}, false);
  painted.materialNames = {"glass", "old brick"};
  for (std::size_t t = 0; t < painted.triangles.size(); ++t) painted.materials.push_back(t < 5 ? 0 : t % 2 == 0);
  TriangleMesh bare = cornerTetrahedron(), pictured = boxMesh({1, 2, 3});
  pictured.normals.clear();
  TriangleMesh sphere = sphereMesh(0.7, 16, false);
  for (const TriangleMesh& mesh : {bare, painted, pictured, boxMesh({1, 2, 3}), rectangleMesh(3, 2), sphere}) {
    writeObj(path(), mesh);
    EXPECT_EQ(readObj(path()), mesh);
  }
}

TEST_F(MeshFile, FansPolygonsAndCountsBackwards) {
  const TriangleMesh mesh = read(square + "f -4 -3 -2 -1\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty() && mesh.materials.empty() && mesh.materialNames.empty());
}

TEST_F(MeshFile, SplitsAPositionOnlyWhereItIsUsedDifferently) {
  const TriangleMesh mesh = read(square + "vt 0 0\nvt 1 1\nf 1/1 2/1 3/1\nf 1/1 3/2 4/1\n");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[4], mesh.vertices[2]);
  EXPECT_EQ(mesh.triangles[1], (Triangle{0, 4, 3}));
  EXPECT_EQ(mesh.uvs[2], (Vec2d{0, 0}));
  EXPECT_EQ(mesh.uvs[4], (Vec2d{1, 1}));
}

TEST_F(MeshFile, TakesTheWaysInWhichPeopleWriteObj) {
  const TriangleMesh mesh = read(
      "# made by hand\r\nmtllib a.mtl\r\no thing\r\n\tv  +0 0 0 1.0 \r\nv 1e0 0 0\r\nv 1 1 0 0.5 0.5 0.5\r\n"
      "v 0 1 .0 # last\r\ns off\r\nf 1 2 \\\r\n 3 4\r\nl 1 2");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices[2], (Vec3d{1, 1, 0}));
}

TEST_F(MeshFile, KeepsMaterialsByName) {
  const TriangleMesh mesh =
      read(square + "f 1 2 3\nusemtl red paint \nf 1 3 4\nusemtl blue\nf 1 2 4\nusemtl red paint\nf 2 3 4\n");
  EXPECT_EQ(mesh.materialNames, (std::vector<std::string>{"default", "red paint", "blue"}));
  EXPECT_EQ(mesh.materials, (std::vector<std::uint16_t>{0, 1, 2, 1}));
}

TEST_F(MeshFile, MakesUpANormalThatIsMissing) {
  const TriangleMesh mesh = read(square + "vn 0 1 0\nvn 0 0 0\nf 1//1 2//2 3\n");
  ASSERT_EQ(mesh.normals.size(), 4u);
  EXPECT_EQ(mesh.normals[0], (Vec3d{0, 1, 0}));
  EXPECT_EQ(mesh.normals[1], (Vec3d{0, 0, 1}));
  EXPECT_EQ(mesh.normals[2], (Vec3d{0, 0, 1}));
}

TEST_F(MeshFile, KeepsTrianglesThatBoundNothingAsTheyAreWritten) {
  EXPECT_EQ(read(square + "f 1 1 2\nf 1 2 3\n").triangles, (std::vector<Triangle>{{0, 0, 1}, {0, 1, 2}}));
}

TEST_F(MeshFile, NamesTheLineOfABadIndex) {
  EXPECT_EQ(complaint(square + "f 1 2 5\n"), "5: vertex 5: must be 1 to 4, or -4 to -1");
  EXPECT_EQ(complaint(square + "\nf 0 1 2\n"), "6: vertex 0: must be 1 to 4, or -4 to -1");
  EXPECT_EQ(complaint(square + "f 1 2 -5\n"), "5: vertex -5: must be 1 to 4, or -4 to -1");
  EXPECT_EQ(complaint(square + "f 1/1 2/1 3/1\n"), "5: texture coordinate 1: no texture coordinate comes before it");
  EXPECT_EQ(complaint(square + "vn 0 0 1\nf 1//1 2//2 3//1\n"), "6: normal 2: must be 1 to 1, or -1 to -1");
  EXPECT_EQ(complaint("f 1 2 3\n" + square), "1: vertex 1: no vertex comes before it");
  for (const char* index : {"99999999999999999999", "1.5", "x", "1e0", "4294967297", "-9223372036854775808"})
    EXPECT_TRUE(complaint(square + "f 1 2 " + index + "\n").starts_with("5: vertex ")) << index;
}

TEST_F(MeshFile, NamesTheLineOfABadNumber) {
  for (const char* number : {"nan", "inf", "-inf", "1e999", "abc", "1,5", "0x10", "--1", "+-1", "1.0f"})
    EXPECT_EQ(complaint("v 0 0 0\nv 1 " + std::string(number) + " 0\n"),
              "2: '" + std::string(number) + "': must be a finite number");
  EXPECT_EQ(complaint("v 0 0\n"), "1: 2 numbers, must be at least 3");
  EXPECT_EQ(complaint("v 0 0 0\nvt\n"), "2: 0 numbers, must be at least 1");
  EXPECT_EQ(complaint("vn 0 0\n"), "1: 2 numbers, must be at least 3");
}

TEST_F(MeshFile, NamesTheLineOfABadFace) {
  EXPECT_EQ(complaint(square + "f 1 2\n"), "5: a face of 2 corners, must be at least 3");
  EXPECT_EQ(complaint(square + "f\n"), "5: a face of 0 corners, must be at least 3");
  EXPECT_EQ(complaint(square + "f /1 2 3\n"), "5: '/1': must begin with a vertex number");
  EXPECT_EQ(complaint(square + "f 1/1/1/1 2 3\n"), "5: '1/1/1/1': must be like 1, 1/2, 1//3 or 1/2/3");
  EXPECT_EQ(complaint(square + "usemtl\nf 1 2 3\n"), "5: usemtl: must be followed by a material's name");
}

TEST_F(MeshFile, RefusesAFileWithoutFaces) {
  const std::string noFace = " no face, must hold at least one line 'f'";
  EXPECT_EQ(complaint(""), noFace);
  EXPECT_EQ(complaint(square), noFace);
  EXPECT_EQ(complaint("\n\n\\\n\\"), noFace);
  EXPECT_EQ(complaint(std::string(1000, '\0') + std::string(1000, '\xff')), noFace);
}

TEST_F(MeshFile, DoesNotRepeatControlCharactersInItsMessages) {
  EXPECT_EQ(complaint("v \x1b[31m 0 0\n"), "1: '?[31m': must be a finite number");
  EXPECT_LT(complaint("v " + std::string(100000, 'x') + " 0 0\n").size(), 100u);
}

TEST_F(MeshFile, EveryTruncationEitherReadsOrIsRefused) {
  writeObj(path(), rectangleMesh(1, 2));
  std::ifstream in(path(), std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    if (!complaint(part).empty()) continue;
    EXPECT_LE(readObj(path()).triangles.size(), 2u);
  }
}

TEST_F(MeshFile, EveryDamagedByteEitherReadsOrIsRefused) {
  writeObj(path(), boxMesh({1, 2, 3}));
  std::ifstream in(path(), std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  const Random random(1, Stream::test);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    std::string damaged = whole;
    for (std::uint64_t k = 0; k < 3; ++k)
      damaged[random.below(whole.size(), 6 * i + 2 * k)] =
          "0123456789-/.ev fnt\n\\#\xff"[random.below(23, 6 * i + 2 * k + 1)];
    if (!complaint(damaged).empty()) continue;
    const TriangleMesh mesh = readObj(path());
    EXPECT_EQ(edgeNeighbours(mesh).size(), mesh.triangles.size());
  }
}

TEST_F(MeshFile, SaysThatAFileIsNotThere) {
  EXPECT_THROW(readObj(scratch_ / "none.obj"), InputError);
  EXPECT_THROW(readObj(scratch_.path()), InputError);
  // A pipe that nobody writes to would never end.
  ASSERT_EQ(mkfifo((scratch_ / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(readObj(scratch_ / "pipe"), InputError);
}

TEST_F(MeshFile, ReadsAFaceOfManyCornersAndOneVertexOfManyNormals) {
  std::string text, face = "f";
  constexpr int corners = 20000;
  for (int i = 1; i <= corners; ++i) {
    text += fmt::format("v {} {} 0\nvt {} 0\n", i, i * i, i);
    face += fmt::format(" {}/{}", i, i);
  }
  for (int i = 1; i + 1 < corners; i += 2) face += fmt::format("\nf 1/{} {}/{} {}/{}", i, i + 1, i + 1, i + 2, i + 2);
  const TriangleMesh mesh = read(text + face + "\n");
  EXPECT_EQ(mesh.triangles.size(), corners - 2 + corners / 2 - 1u);
}

}  // namespace
}  // namespace brisance
