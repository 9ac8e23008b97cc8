#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "frame/frame_samples.h"
#include "frame/gltf_export.h"
#include "mesh/mesh_formats.h"

namespace brisance {
namespace {

nlohmann::json jsonOf(const std::string& glb) {
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, sizeof length);
  return nlohmann::json::parse(glb.substr(20, length));
}

/// The same pieces whichever group of material comes first.
TriangleMesh sortedByMaterial(const TriangleMesh& mesh) {
  TriangleMesh sorted = mesh;
  sorted.triangles.clear();
  sorted.materials.clear();
  for (std::uint16_t material = 0; material < mesh.materialNames.size(); ++material)
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (mesh.materials[t] == material) {
        sorted.triangles.push_back(mesh.triangles[t]);
        sorted.materials.push_back(material);
      }
  return sorted;
}

TEST(Glb, ReadsBackNamesMeshesMaterialsAndPoses) {
  const auto bodies = sampleBodies();
  const auto read = piecesFromGlb(piecesToGlb(bodies), "pieces.glb");
  ASSERT_EQ(read.size(), bodies.size());
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    EXPECT_EQ(read[n].name, bodies[n].name);
    EXPECT_EQ(read[n].material, bodies[n].material);
    EXPECT_EQ(read[n].moves, bodies[n].moves);
    EXPECT_EQ(read[n].pose, bodies[n].pose);
  }
  EXPECT_EQ(*read[0].mesh, *bodies[0].mesh);
  EXPECT_EQ(*read[2].mesh, sortedByMaterial(*bodies[2].mesh));
  EXPECT_EQ(read[0].mesh, read[1].mesh);  // shared as it was
}

TEST(Glb, VerticesAreKeptToSinglePrecision) {
  TriangleMesh mesh = sampleTetrahedron();
  mesh.vertices[3] = {1.0 / 3, -2e7 / 3, 1e-9 / 3};
  auto body = sampleBodies().front();
  body.mesh = std::make_shared<const TriangleMesh>(mesh);
  const auto read = piecesFromGlb(piecesToGlb({body}), "pieces.glb");
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(static_cast<float>(read[0].mesh->vertices[3][axis]), static_cast<float>(mesh.vertices[3][axis]));
  EXPECT_EQ(*read[0].mesh, *piecesFromGlb(piecesToGlb(read), "pieces.glb")[0].mesh);
}

TEST(Glb, IsAValidGltfHeaderAndLayout) {
  const std::string glb = piecesToGlb(sampleBodies());
  std::uint32_t words[5];
  std::memcpy(words, glb.data(), sizeof words);
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(words[1], 2u);
  EXPECT_EQ(words[2], glb.size());
  EXPECT_EQ(words[3] % 4, 0u);
  EXPECT_EQ(glb.substr(16, 4), "JSON");
  EXPECT_EQ(glb.substr(20 + words[3] + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(jsonOf(glb)["asset"]["version"], "2.0");
}

TEST(Glb, EveryAccessorFitsItsViewAndEveryViewTheBuffer) {
  const auto json = jsonOf(piecesToGlb(sampleBodies()));
  const std::map<std::string, std::size_t> components{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}};
  const std::size_t buffer = json["buffers"][0]["byteLength"];
  for (const auto& accessor : json["accessors"]) {
    const auto& view = json["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::size_t bytes = accessor["count"].get<std::size_t>() * components.at(accessor["type"]) * 4;
    EXPECT_EQ(view["byteLength"], bytes);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + bytes, buffer);
    EXPECT_EQ(view["target"], accessor["componentType"] == 5125 ? 34963 : 34962);
  }
}

TEST(Glb, PositionsCarryTheirBounds) {
  const auto json = jsonOf(piecesToGlb(sampleBodies()));
  for (const auto& mesh : json["meshes"])
    for (const auto& primitive : mesh["primitives"]) {
      const auto& position = json["accessors"].at(primitive["attributes"]["POSITION"].get<std::size_t>());
      EXPECT_EQ(position["min"], (nlohmann::json{0.0, 0.0, 0.0}));
      EXPECT_EQ(position["max"], (nlohmann::json{1.0, 1.0, 1.5}));
    }
}

TEST(Glb, NothingToShowIsStillValid) {
  const std::string empty = piecesToGlb({});
  EXPECT_TRUE(piecesFromGlb(empty, "pieces.glb").empty());
  const auto json = jsonOf(empty);
  for (const auto& [name, part] : json.items()) EXPECT_FALSE(part.is_array() && part.empty()) << name;
  FrameBody body{"nothing", std::make_shared<const TriangleMesh>(), "glass", {}, {}, {}, 300, true};
  const auto read = piecesFromGlb(piecesToGlb({body}), "pieces.glb");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_TRUE(read[0].mesh->triangles.empty());
}

/// What other programs make of pieces: nodes that move them, an outside and an inside that share their vertices.
TEST(Glb, AReaderOfAnyGltfSeesThePiecesWhereTheyLie) {
  TriangleMesh mesh = sampleTetrahedron();
  mesh.materialNames = {"outside", "inside"};
  mesh.materials = {1, 0, 0, 1};
  auto body = sampleBodies().front();
  body.mesh = std::make_shared<const TriangleMesh>(mesh);
  body.pose = {{1, 2, 3}, {}};
  const TriangleMesh read = gltfFromBytes(piecesToGlb({body}), "pieces.glb", {});
  ASSERT_EQ(read.vertices.size(), mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_EQ(read.vertices[v], mesh.vertices[v] + Vec3d(1, 2, 3));
  EXPECT_EQ(read.materialNames, mesh.materialNames);
  EXPECT_EQ(read.materials, (std::vector<std::uint16_t>{0, 0, 1, 1}));
  EXPECT_EQ(read.triangles[0], mesh.triangles[1]);
  EXPECT_EQ(read.triangles[2], mesh.triangles[0]);
  EXPECT_EQ(read.normals, mesh.normals);
  EXPECT_EQ(read.uvs.size(), mesh.uvs.size());
}

TEST(Glb, EveryTruncationIsRefused) {
  const std::string whole = piecesToGlb(sampleBodies());
  for (std::size_t length = 0; length < whole.size(); ++length)
    ASSERT_THROW(piecesFromGlb(whole.substr(0, length), "pieces.glb"), DamagedFile) << length;
}

/// A damaged byte is either refused, or changes values alone: no vertex number reaches past its vertices.
TEST(Glb, AnyChangedByteIsRefusedOrHarmless) {
  const std::string whole = piecesToGlb(sampleBodies());
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int flip : {0x01, 0x10, 0x80}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ flip);
      try {
        for (const FrameBody& body : piecesFromGlb(damaged, "pieces.glb"))
          for (const Triangle& triangle : body.mesh->triangles)
            for (const std::uint32_t vertex : triangle) ASSERT_LT(vertex, body.mesh->vertices.size());
      } catch (const DamagedFile& refused) {
        ASSERT_EQ(std::string(refused.what()).find("pieces.glb: "), 0u);
      }
    }
}

}  // namespace
}  // namespace brisance
