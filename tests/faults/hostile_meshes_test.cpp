// Meshes that are broken, or made to break a reader: through the real program, in little time and memory.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "faults/one_line.h"

namespace brisance::test {
namespace {

/// Of the processor: what grows as the square of such a mesh takes minutes.
constexpr double mostSeconds = 20;

double secondsOfChildren() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
}
constexpr long mostKilobytes = 256L * 1024;

struct Hostile {
  std::string file;  ///< name; the extension chooses the reader
  std::string content;
  int exitCode = 3;
  std::vector<std::string> words;  ///< in the one line that refuses it, or in the report
};

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int n = 0; n < times; ++n) all += text;
  return all;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string plyHead = "ply\nformat binary_little_endian 1.0\nelement vertex ";
const std::string plyFloats = "\nproperty float x\nproperty float y\nproperty float z\n";
const std::string gltfHead = R"({"asset":{"version":"2.0"},)";

std::string binaryStl(std::uint32_t promised, std::size_t facets) {
  std::string bytes(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&promised), sizeof promised);
  return bytes + std::string(50 * facets, '\0');
}

std::string glb(std::uint32_t promised, const std::string& json) {
  const std::uint32_t words[] = {2, promised, static_cast<std::uint32_t>(json.size())};
  std::string bytes = "glTF" + std::string(reinterpret_cast<const char*>(words), sizeof words);
  return bytes + "JSON" + json;
}

/// A hundred thousand triangles that all overlap: the worst for a search for crossings.
std::string heap() {
  std::string text;
  for (int n = 0; n < 50000; ++n)
    text += "v " + std::to_string(n % 97) + " 0 " + std::to_string(n % 89) + "\nv 0 " + std::to_string(n % 83) +
            " 1\nv 1 1 " + std::to_string(n) + "\nf -1 -2 -3\n";
  return text;
}

/// Shells around shells: the worst for telling which lie inside which.
std::string onion(int shells) {
  std::string text;
  for (int n = 1; n <= shells; ++n) {
    text += fmt::format("v -{0} -{0} -{0}\nv {0}0 0 0\nv 0 {0}0 0\nv 0 0 {0}0\n", n);
    text += "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n";
  }
  return text;
}

std::vector<Hostile> refusedMeshes() {
  return {
      {"index.obj", square + "f 1 2 9\n", 3, {":5: vertex 9", "must be 1 to 4"}},
      {"nan.obj", "v 0 nan 0\nf 1 1 1\n", 3, {":1: 'nan': must be a finite number"}},
      {"empty.obj", "", 3, {"no face"}},
      {"empty.ply", "", 3, {":1: "}},
      {"empty.stl", "", 3, {"ends early"}},
      {"empty.gltf", "", 3, {"byte"}},
      {"empty.glb", "", 3, {"byte"}},
      {"spaces.obj", "f 1 " + std::string(4'000'000, ' ') + "#", 3, {":1: vertex 1: no vertex"}},
      {"promise.ply",
       plyHead + "1000000000000" + plyFloats + "end_header\n",
       3,
       {":3: ", "1000000000000", "at most 0"}},
      {"infinite.ply",
       plyHead + "1" + plyFloats + "end_header\n" + std::string("\0\0\x80\x7f\0\0\0\0\0\0\0\0", 12),
       3,
       {"byte", "x: inf, must be a finite number"}},
      {"nothing.ply", plyHead + "18446744073709551615\nend_header\n", 3, {"no face"}},
      {"list.ply",
       plyHead + "3" + plyFloats + "element face 1\nproperty list int int vertex_indices\nend_header\n" +
           std::string(36, '\0') + "\xff\xff\xff\x7f",
       3,
       {"a list of 2147483647"}},
      {"header.ply", "ply\n" + repeated("comment\n", 500000), 3, {"header ends early"}},
      {"promise.stl", binaryStl(0xFFFFFFFF, 3), 3, {"byte 80", "promises 4294967295", "at most 3"}},
      {"truncated.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", 3, {":4: ends within a facet"}},
      {"nest.gltf", repeated("[", 5'000'000), 3, {"byte 64: nests deeper"}},
      {"nest2.gltf", repeated("{\"a\":", 1'000'000), 3, {"nests deeper"}},
      {"values.gltf", gltfHead + "\"a\":[" + repeated("{},", 4'000'000) + "0]}", 3, {"more than 1048576 values"}},
      {"promise.glb", glb(0xFFFFFFFF, "{}"), 3, {"byte 8: promises 4294967295"}},
      {"promise.gltf",
       gltfHead + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,
"componentType":5126,"count":1000000000000,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":4}],
"buffers":[{"byteLength":4,"uri":"data:;base64,AAAAAAAA"}]})",
       3,
       {"accessors 0: promises 1000000000000 rows, must be at most 0"}},
      {"escape.gltf",
       gltfHead + R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,
"componentType":5126,"count":1,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":12}],
"buffers":[{"byteLength":12,"uri":"../../../../etc/passwd"}]})",
       3,
       {"buffers 0: uri", "must be a file in the folder"}},
      {"missing.obj", "", 2, {"does not exist"}},
  };
}

std::vector<Hostile> namedMeshes() {
  return {
      {"one.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
       0,
       {"open (3 open edges)", "holes: 1, the first at (0.5, 0, 0)"}},
      {"point.obj", "v 0 0 0\nf 1 1 1\n", 0, {"triangles that come back to a corner: 1"}},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", 0, {"triangles of no area: 1"}},
      {"twice.obj", tetrahedron + "f 1 3 2\n", 0, {"duplicate triangles: 1", "edges of more than two triangles: 3"}},
      {"open.obj", square + "f 1 2 3 4\n", 0, {"open (4 open edges)"}},
      {"fin.obj",
       tetrahedron + "v 2 2 2\nf 1 2 5\n",
       0,
       {"edges of more than two triangles: 1, the first at (0.5, 0, 0)"}},
      {"crossed.obj", tetrahedron + "v 0.1 0.1 -1\nv 0.2 0.1 1\nv 0.1 0.2 1\nf 5 6 7\n", 0, {"cut through each other"}},
      {"inside_out.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n",
       0,
       {"parts that are inside out: 1"}},
      {"huge.obj", "v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", 0, {"open"}},
      {"heap.obj", heap(), 0, {"at least"}},
      {"onion.obj", onion(1000), 0, {"1000 parts", "inside out: 500"}},
      {"onions.obj", onion(10000), 0, {"10000 parts", "which parts lie inside others would take too long"}},
  };
}

class HostileMeshes : public testing::Test {
 protected:
  void judge(const Hostile& mesh) {
    SCOPED_TRACE(mesh.file);
    const fs::path file = place_ / mesh.file;
    if (mesh.exitCode != 2) writeText(file, mesh.content);
    const double before = secondsOfChildren();
    const Outcome outcome = runProgram({"info", file});
    EXPECT_LT(secondsOfChildren() - before, mostSeconds);
    if (mesh.exitCode != 0) {
      expectOneLine(outcome, mesh.exitCode, mesh.words);
      EXPECT_TRUE(outcome.err.starts_with(file.string() + ":")) << outcome.err;
      return;
    }
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    for (const std::string& word : mesh.words)
      EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in: " << outcome.out;
  }
  /// The most that any program held which this test started.
  static long peakKilobytes() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss;
  }

  ScratchDirectory place_;
};

TEST_F(HostileMeshes, AreRefusedInOneLine) {
  for (const Hostile& mesh : refusedMeshes()) judge(mesh);
  EXPECT_LT(peakKilobytes(), mostKilobytes);
}

TEST_F(HostileMeshes, AreDescribedWithThePlaceOfWhatIsWrong) {
  for (const Hostile& mesh : namedMeshes()) judge(mesh);
  EXPECT_LT(peakKilobytes(), mostKilobytes);
}

TEST_F(HostileMeshes, ADirectoryOrAPipeIsNoMesh) {
  fs::create_directory(place_ / "folder.obj");
  EXPECT_NE(runProgram({"info", place_ / "folder.obj"}).exitCode, 0);
  ASSERT_EQ(mkfifo((place_ / "pipe.ply").c_str(), 0600), 0);
  expectOneLine(runProgram({"info", place_ / "pipe.ply"}), 2, {"is no file"});
}

TEST_F(HostileMeshes, InfoTellsScriptsTheSame) {
  writeText(place_ / "twice.obj", tetrahedron + "f 1 3 2\n");
  const Outcome outcome = runProgram({"info", place_ / "twice.obj", "--json"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
  for (const char* word : {R"("kind":"mesh")", R"("triangles":5)", R"("closed":false)", R"("duplicates":{"count":1)"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in: " << outcome.out;
}

}  // namespace
}  // namespace brisance::test
