#include "frame/usd_export.h"

#include <map>

#include "base/check.h"
#include "frame/usd_materials.h"
#include "frame/usd_text.h"

namespace brisance {

namespace {

using usd::inQuotes;
using usd::value;
using usd::Writer;

void writeHead(Writer& out, const RunMotion& motion, double fps) {
  out.line("#usda 1.0");
  out.line("(");
  out.line("    defaultPrim = \"World\"");
  out.line("    startTimeCode = {}", motion.frames.front());
  out.line("    endTimeCode = {}", motion.frames.back());
  out.line("    framesPerSecond = {}", fps);
  out.line("    timeCodesPerSecond = {}", fps);
  out.line("    metersPerUnit = 1");
  out.line("    upAxis = \"Y\"");
  out.line(")");
  out.line("");
}

/// `name` with the values at its keys, or with the only value there is.
template <class T>
void writeTrack(Writer& out, const std::string& name, const std::vector<int>& frames, const std::vector<T>& values) {
  const std::vector<std::size_t> keys = neededKeys(values);
  if (keys.empty()) {
    out.line("{} = {}", name, value(values.front()));
    return;
  }
  out.begin("{}.timeSamples = {{", name);
  for (const std::size_t n : keys) out.line("{}: {},", frames[n], value(values[n]));
  out.close();
}

void writePoses(Writer& out, const BodyMotion& motion) {
  std::vector<Vec3d> places;
  std::vector<Quaternion> turns;
  for (const Pose& pose : withContinuousSigns(motion.poses)) {
    places.push_back(pose.position);
    turns.push_back(pose.orientation);
  }
  writeTrack(out, "double3 xformOp:translate", motion.frames, places);
  writeTrack(out, "quatf xformOp:orient", motion.frames, turns);
  out.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
}

std::string extent(const Box3& box) { return usd::list(std::vector{Vec3f(box.lower), Vec3f(box.upper)}); }

std::vector<Vec3f> pointsOf(const TriangleMesh& mesh) { return {mesh.vertices.begin(), mesh.vertices.end()}; }

/// A mesh that changes its shape: its points at the frames in which it does.
void writeShapes(Writer& out, const BodyMotion& motion) {
  std::vector<std::size_t> changes;
  for (std::size_t n = 0; n < motion.shapes.size(); ++n)
    if (n == 0 || motion.shapes[n] != motion.shapes[n - 1]) changes.push_back(n);
  out.begin("float3[] extent.timeSamples = {{");
  for (const std::size_t n : changes) out.line("{}: {},", motion.frames[n], extent(bounds(*motion.shapes[n])));
  out.close();
  out.begin("point3f[] points.timeSamples = {{");
  for (const std::size_t n : changes) out.line("{}: {},", motion.frames[n], usd::list(pointsOf(*motion.shapes[n])));
  out.close();
}

void writeCorners(Writer& out, const BodyMotion& motion) {
  const TriangleMesh& mesh = *motion.body.mesh;
  std::vector<Vec3f> normals;
  std::vector<Vec2<float>> uvs;
  for (const Vec3d& n : mesh.normals) normals.emplace_back(n);
  for (const Vec2d& uv : mesh.uvs) uvs.push_back({static_cast<float>(uv.x), static_cast<float>(uv.y)});
  if (motion.shapes.empty()) {
    out.line("float3[] extent = {}", extent(bounds(mesh)));
    out.line("point3f[] points = {}", usd::list(pointsOf(mesh)));
  } else {
    writeShapes(out, motion);
    normals.clear();  // those of one shape
  }
  if (!normals.empty()) {
    out.line("normal3f[] normals = {} (", usd::list(normals));
    out.line("    interpolation = \"vertex\"");
    out.line(")");
  }
  if (uvs.empty()) return;
  out.line("texCoord2f[] primvars:st = {} (", usd::list(uvs));
  out.line("    interpolation = \"vertex\"");
  out.line(")");
}

void writeTriangles(Writer& out, const TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const Triangle& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  out.line("int[] faceVertexCounts = {}", usd::list(std::vector<std::uint32_t>(mesh.triangles.size(), 3)));
  out.line("int[] faceVertexIndices = {}", usd::list(corners));
}

/// The faces of each material; together they are all faces.
void writeSubsets(Writer& out, const FrameBody& body, usd::Materials& materials) {
  const TriangleMesh& mesh = *body.mesh;
  std::map<std::uint16_t, std::vector<std::uint32_t>> faces;
  for (std::size_t t = 0; t < mesh.materials.size(); ++t)
    faces[mesh.materials[t]].push_back(static_cast<std::uint32_t>(t));
  usd::Names names;
  out.line("uniform token subsetFamily:materialBind:familyType = \"partition\"");
  for (const auto& [material, ofMaterial] : faces) {
    const std::string& part = mesh.materialNames.at(material);
    out.line("def GeomSubset \"{}\" (", names.unique(part));
    out.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
    out.open(")");
    out.line("uniform token elementType = \"face\"");
    out.line("uniform token familyName = \"materialBind\"");
    out.line("int[] indices = {}", usd::list(ofMaterial));
    out.line("rel material:binding = <{}>", materials.pathOf(body, part));
    out.close();
  }
}

void writeMesh(Writer& out, const BodyMotion& motion, usd::Materials& materials) {
  const FrameBody& body = motion.body;
  out.line("def Mesh \"mesh\" (");
  out.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
  out.open(")");
  writeCorners(out, motion);
  writeTriangles(out, *body.mesh);
  out.line("uniform bool doubleSided = 1");  // shells have an inside that is seen
  out.line("uniform token subdivisionScheme = \"none\"");
  if (body.mesh->materials.empty())
    out.line("rel material:binding = <{}>", materials.pathOf(body, ""));
  else
    writeSubsets(out, body, materials);
  out.close();
}

void writeBodies(Writer& out, const RunMotion& motion, usd::Materials& materials) {
  usd::Names names;
  out.open("def Xform \"Bodies\"");
  for (const BodyMotion& moving : motion.bodies) {
    out.line("def Xform \"{}\" (", names.unique(moving.body.name));
    out.line("    customData = {{ string name = {} }}", inQuotes(moving.body.name));
    out.open(")");
    writePoses(out, moving);
    if (moving.body.mesh && !moving.body.mesh->triangles.empty()) writeMesh(out, moving, materials);
    out.close();
  }
  out.close();
}

void writeField(Writer& out, const std::vector<GasFile>& files, const std::string& name, bool isVector) {
  out.open("def OpenVDBAsset \"{}\"", name);
  out.line("token fieldName = \"{}\"", name);
  out.line("token fieldDataType = \"{}\"", isVector ? "float3" : "float");
  out.line("token fieldClass = \"fogVolume\"");
  if (isVector) out.line("token vectorDataRoleHint = \"Vector\"");
  out.begin("asset filePath.timeSamples = {{");
  for (const GasFile& file : files) out.line("{}: {},", file.frame, usd::asset(file.path));
  out.close();
  out.close();
}

void writeGas(Writer& out, const UsdSettings& settings) {
  const std::pair<const char*, bool> fields[] = {
      {"density", false}, {"temperature", false}, {"flame", false}, {"vel", true}};
  out.open("def Volume \"Gas\"");
  out.line("float3[] extent = {}", extent(settings.gasBox));
  for (const auto& [name, isVector] : fields) out.line("rel field:{} = </World/Gas/{}>", name, name);
  for (const auto& [name, isVector] : fields) writeField(out, settings.gas, name, isVector);
  out.close();
}

}  // namespace

std::string motionToUsda(const RunMotion& motion, const UsdSettings& settings) {
  CHECK(!motion.frames.empty(), "a film of no frames");
  Writer out;
  usd::Materials materials(settings.looks);
  writeHead(out, motion, settings.fps);
  out.open("def Xform \"World\"");
  writeBodies(out, motion, materials);
  materials.write(out);
  if (!settings.gas.empty()) writeGas(out, settings);
  out.close();
  return out.take();
}

}  // namespace brisance
