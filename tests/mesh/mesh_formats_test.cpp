// PLY, STL and glTF; OBJ has mesh_file_test.cpp.
#include "mesh/mesh_formats.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "base/check.h"
#include "mesh/mesh_file.h"
#include "mesh/mesh_samples.h"
#include "mesh/shapes.h"
#include "scratch_directory.h"

namespace brisance {
namespace {

/// What a reader complains of, without the name before it; empty if it takes the bytes.
template <class Reader>
std::string complaint(const Reader& read, const std::string& bytes) {
  try {
    read(bytes, "mesh");
  } catch (const DamagedFile& refused) {
    EXPECT_TRUE(std::string_view(refused.what()).starts_with("mesh:"));
    EXPECT_EQ(std::string_view(refused.what()).find('\n'), std::string_view::npos);
    return std::string(refused.what()).substr(5);
  }
  return "";
}

TriangleMesh gltf(std::string_view bytes, const std::string& file) { return gltfFromBytes(bytes, file, {}); }

template <class T>
void put(std::string& bytes, T value, bool bigEndian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (bigEndian) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

TEST(Ply, BringsBackWhatWasWritten) {
  TriangleMesh painted = boxMesh({0.1, 1.0 / 3, 2e-7});
  painted.materialNames = {"outside", "old brick"};
  for (std::size_t t = 0; t < painted.triangles.size(); ++t) painted.materials.push_back(t % 2);
  TriangleMesh bare = cornerTetrahedron(), pictured = boxMesh({1, 2, 3});
  pictured.normals.clear();
  for (const TriangleMesh& mesh : {bare, painted, pictured, boxMesh({1, 2, 3}), rectangleMesh(3, 2)}) {
    EXPECT_EQ(plyFromBytes(plyBytes(mesh), "mesh"), mesh);
    const ScratchDirectory scratch;
    for (const char* name : {"mesh.ply", "mesh.OBJ"}) {
      writeMesh(scratch / name, mesh);
      EXPECT_EQ(readMesh(scratch / name), mesh) << name;
    }
  }
}

const std::string plySquare =
    "element vertex 4\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n"
    "property float u\nproperty float v\nelement face 1\nproperty int group\nproperty list uchar int vertex_index\n"
    "element edge 1\nproperty list int float what\nend_header\n";

std::string binaryPlySquare(bool bigEndian) {
  std::string bytes = fmt::format("ply\nformat binary_{}_endian 1.0\n", bigEndian ? "big" : "little") + plySquare;
  for (const auto& [x, y] : {std::pair(0.f, 0.f), {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}}) {
    put(bytes, x, bigEndian), put(bytes, std::uint8_t{9}), put(bytes, y, bigEndian), put(bytes, 0.f, bigEndian);
    put(bytes, 1 - x, bigEndian), put(bytes, y, bigEndian);
  }
  put(bytes, 7, bigEndian), put(bytes, std::uint8_t{4});
  for (const int corner : {0, 1, 2, 3}) put(bytes, corner, bigEndian);
  put(bytes, 1, bigEndian), put(bytes, 3.f, bigEndian);
  return bytes;
}

TEST(Ply, IsTheSameInEveryEncoding) {
  const TriangleMesh little = plyFromBytes(binaryPlySquare(false), "mesh");
  EXPECT_EQ(little.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(little.vertices[2], (Vec3d{1, 1, 0}));
  EXPECT_EQ(little.uvs[1], (Vec2d{0, 0}));
  EXPECT_EQ(plyFromBytes(binaryPlySquare(true), "mesh"), little);
  const std::string ascii = "ply\r\nformat ascii 1.0\r\ncomment x\r\n" + plySquare +
                            "0 9 0 0 1 0\n1 9 0 0 0 0\n1 9 1 0 0 1\n 0 9 1 0 1 1\n7 4 0 1 2 3\n1 3\n";
  EXPECT_EQ(plyFromBytes(ascii, "mesh"), little);
}

TEST(Ply, NeverBelievesACount) {
  const std::string lead = "ply\nformat ascii 1.0\nelement vertex 1000000000000\n";
  EXPECT_EQ(complaint(plyFromBytes, lead + "property float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"),
            "3: element vertex: promises 1000000000000, must be at most 1 in a file of this size");
  EXPECT_EQ(complaint(plyFromBytes, lead + "end_header\n"), " no face, must hold an element 'face' of at least one");
  std::string list = "ply\nformat binary_little_endian 1.0\nelement what 1\nproperty list uint double x\nend_header\n";
  put(list, std::uint32_t{4000000000});
  EXPECT_EQ(complaint(plyFromBytes, list), "byte 94: x: a list of 4000000000, must be 0 to 0 in a file of this size");
}

TEST(Ply, NamesWhatIsWrongAndWhere) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(complaint(plyFromBytes, head + vertices + "3 0 1 2\n"), "");
  EXPECT_EQ(complaint(plyFromBytes, head + vertices + "3 0 1 3\n"), "13: vertex 3: must be 0 to 2");
  EXPECT_EQ(complaint(plyFromBytes, head + vertices + "3 0 -1 2\n"), "13: vertex -1: must be 0 to 2");
  EXPECT_EQ(complaint(plyFromBytes, head + vertices + "2 0 1\n"), "13: a face of 2 corners, must be at least 3");
  EXPECT_EQ(complaint(plyFromBytes, head + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"), "11: y: nan, must be a finite number");
  EXPECT_EQ(complaint(plyFromBytes, head + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), "11: 'x': must be a number");
  EXPECT_EQ(complaint(plyFromBytes, head + vertices), "13: ends early, must hold all values that the header promises");
  EXPECT_EQ(complaint(plyFromBytes, "ply\nformat ascii 2.0\n"),
            "2: format 'ascii 2.0': must be ascii, binary_little_endian or binary_big_endian 1.0");
  EXPECT_EQ(complaint(plyFromBytes, "ply\nelement vertex 1\nproperty half x\n"),
            "3: type 'half': must be char, uchar, short, ushort, int, uint, float or double");
  EXPECT_EQ(complaint(plyFromBytes, "ply\n"), "2: the header ends early, must end with the line 'end_header'");
}

const std::string stlFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(Stl, WeldsCornersAtTheSamePlace) {
  std::string bytes(80, ' ');
  const TriangleMesh box = boxMesh({1, 2, 3}, false);
  put(bytes, static_cast<std::uint32_t>(box.triangles.size()));
  for (const Triangle& t : box.triangles) {
    bytes.append(12, '\0');
    for (const std::uint32_t v : t)
      for (int axis = 0; axis < 3; ++axis) put(bytes, static_cast<float>(box.vertices[v][axis]));
    put(bytes, std::uint16_t{0});
  }
  const TriangleMesh read = stlFromBytes(bytes, "mesh");
  EXPECT_EQ(read.vertices.size(), 8u);
  EXPECT_TRUE(isClosed(read));
  std::memcpy(bytes.data(), "solid facet", 11);  // many writers begin a binary file so
  EXPECT_EQ(stlFromBytes(bytes, "mesh"), read);
  bytes.pop_back();
  bytes[0] = ' ';
  EXPECT_EQ(complaint(stlFromBytes, bytes),
            "byte 80: promises 12 triangles, must be at most 11 in a file of this size");
}

TEST(Stl, TakesTextAndNamesItsLines) {
  const TriangleMesh mesh = stlFromBytes("solid a b\n" + stlFacet + stlFacet + "endsolid\n", "mesh");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(complaint(stlFromBytes, "solid\n" + stlFacet + "facet\nvertex 0 0 inf\n"),
            "10: 'inf': must be a finite number");
  EXPECT_EQ(complaint(stlFromBytes, "solid\nfacet\nvertex 0 0 0\nendfacet\n"),
            "4: a facet of 1 vertices, must be three");
  EXPECT_EQ(complaint(stlFromBytes, "solid\nvertex 0 0 0\n"), "2: a vertex too many, must be three in each facet");
  EXPECT_EQ(complaint(stlFromBytes, "solid\nfacet\n"), "2: ends within a facet, must end with 'endsolid'");
  EXPECT_EQ(complaint(stlFromBytes, "solid\nendsolid\n"), " no facet, must hold at least one");
  EXPECT_EQ(complaint(stlFromBytes, ""), "byte 0: ends early, must be STL: a header of 84 bytes, or the word 'solid'");
}

/// One triangle (0,0,0) (1,0,0) (0,1,0) and indices of bytes 0 1 2 in a data uri; the JSON has holes to fill.
std::string gltfText(const std::string& root, const std::string& primitive = "", const std::string& accessor = "",
                     const std::string& view = "") {
  return R"({"asset":{"version":"2.0"},)" + root +
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1)" + primitive + R"(}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR")" +
         accessor + R"(}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":3)" +
         view + R"(}],
"buffers":[{"byteLength":39,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAEC"}]})";
}

TEST(Gltf, ReadsAMeshWithoutScene) {
  const TriangleMesh mesh = gltf(gltfText(""), "mesh");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(mesh.materialNames.empty() && mesh.uvs.empty() && mesh.normals.empty());
}

TEST(Gltf, MovesMeshesByTheirNodesAndTurnsMirroredOnes) {
  const TriangleMesh mesh = gltf(
      gltfText(R"("scene":1,"scenes":[{"nodes":[2]},{"nodes":[0]}],"nodes":[{"translation":[10,0,0],"children":[1,2]},
{"mesh":0,"scale":[-1,2,1]},{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,5,1]}],)"),
      "mesh");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices[1], (Vec3d{9, 0, 0}));
  EXPECT_EQ(mesh.vertices[2], (Vec3d{10, 2, 0}));
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 2, 1}));
  EXPECT_EQ(mesh.vertices[4], (Vec3d{10, 1, 5}));  // a quarter turn about z
  EXPECT_EQ(mesh.triangles[1], (Triangle{3, 4, 5}));
}

TEST(Gltf, NamesMaterialsAndReadsStripsAndFans) {
  for (const char* mode : {"5", "6"}) {
    const TriangleMesh mesh =
        gltf(gltfText(R"("materials":[{},{"name":"clay"}],)", R"(,"material":1,"mode":)" + std::string(mode)), "mesh");
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
    EXPECT_EQ(mesh.materialNames, (std::vector<std::string>{"clay"}));
  }
}

TEST(Gltf, RefusesWhatItDoesNotReadByName) {
  EXPECT_EQ(complaint(gltf, gltfText(R"("extensionsRequired":["KHR_draco_mesh_compression"],)")),
            "extensionsRequired: 'KHR_draco_mesh_compression' is not read, must be stored without it");
  EXPECT_EQ(complaint(gltf, gltfText("", "", R"(,"sparse":{})")), "accessors 1: is sparse, must be stored whole");
  EXPECT_EQ(complaint(gltf, gltfText("", R"(,"mode":0)")), "meshes: no triangle in the scene, must hold at least one");
}

TEST(Gltf, NamesBrokenReferences) {
  EXPECT_EQ(complaint(gltf, gltfText("", "", R"(,"count":1000000000000)")),
            "accessors 1: promises 1000000000000 rows, must be at most 3 in its bufferView");
  EXPECT_EQ(complaint(gltf, gltfText("", "", R"(,"byteOffset":18446744073709551615)")),
            "accessors 1: promises 3 rows, must be at most 0 in its bufferView");
  EXPECT_EQ(complaint(gltf, gltfText("", "", "", R"(,"byteLength":4)")),
            "bufferViews 1: bytes 36 to 36 + 4: must be at most the buffer's 39");
  EXPECT_EQ(complaint(gltf, gltfText("", R"(,"indices":7)")), "accessors 7: is not there, must be one of 2");
  EXPECT_EQ(complaint(gltf, gltfText(R"("nodes":[{"children":[1]},{"children":[1]}],)")),
            "nodes 1: has two parents, must have one");
  EXPECT_EQ(complaint(gltf, gltfText(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}],)")),
            "nodes 0: has two parents, must have one");
  EXPECT_EQ(complaint(gltf, std::string(100000, '[')), "byte 64: nests deeper than 64 levels, must not");
  EXPECT_EQ(complaint(gltf, "{\"asset\":"), "byte 10: is not JSON here, must be glTF 2.0");
  EXPECT_EQ(complaint(gltf, "{}"), "asset: names no version, must be glTF 2.0");
}

/// A thousand nodes of a mesh are copies that its file does not hold.
TEST(Gltf, BoundsTheCopiesThatNodesMake) {
  std::string nodes = "\"nodes\":[{\"mesh\":0}";
  for (int n = 1; n < 200000; ++n) nodes += ",{\"mesh\":0}";
  std::string text = gltfText(nodes + "],");
  EXPECT_EQ(gltf(text, "mesh").triangles.size(), 200000u);  // 1.2 million numbers: the file's own bytes count too
  std::string binary = text;
  const std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string primitives;
  for (int n = 0; n < 40; ++n) primitives += primitive + ",";
  binary.replace(binary.find(primitive), 0, primitives);
  EXPECT_EQ(complaint(gltf, binary), "nodes: copies of meshes make more than 1000000 vertices, must be fewer");
}

TEST(Gltf, LooksForBuffersInItsOwnFolderAlone) {
  const ScratchDirectory scratch;
  std::filesystem::create_directory(scratch / "inner");
  std::string bytes;
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) put(bytes, x);
  bytes += std::string("\0\1\2", 3);
  for (const char* name : {"outer.bin", "inner/my file.bin"}) std::ofstream(scratch / name, std::ios::binary) << bytes;
  std::filesystem::create_symlink(scratch / "outer.bin", scratch / "inner/link.bin");
  const auto readWith = [&](const std::string& uri) {
    std::string text = gltfText("");
    const std::size_t at = text.find("data:");
    text.replace(at, text.find('"', at) - at, uri);
    std::ofstream(scratch / "inner/mesh.gltf") << text;
    return readMesh(scratch / "inner/mesh.gltf");
  };
  EXPECT_EQ(readWith("my%20file.bin").triangles.size(), 1u);
  for (const char* uri :
       {"../outer.bin", "%2e%2e/outer.bin", "link.bin", "none.bin", "", "http://a/b", "..\\\\outer.bin"})
    EXPECT_THROW(readWith(uri), DamagedFile) << uri;
  EXPECT_THROW(readWith((scratch / "outer.bin").string()), DamagedFile);
}

TEST(MeshFileFormat, IsToldByContentBeforeTheName) {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "a.obj", std::ios::binary) << plyBytes(cornerTetrahedron());
  EXPECT_EQ(readMesh(scratch / "a.obj"), cornerTetrahedron());
  std::ofstream(scratch / "a.txt") << "v 0 0 0\n";
  EXPECT_THROW(readMesh(scratch / "a.txt"), InputError);
  EXPECT_THROW(readMesh(scratch / "none.ply"), InputError);
  EXPECT_THROW(readMesh(scratch.path()), InputError);
  EXPECT_THROW(writeMesh(scratch / "a.stl", cornerTetrahedron()), InputError);
}

}  // namespace
}  // namespace brisance
