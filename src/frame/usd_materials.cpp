#include "frame/usd_materials.h"

namespace brisance::usd {

namespace {

constexpr char scope[] = "/World/Materials";
/// UsdPreviewSurface has no transmission: glass is a thin sheet that lets most light pass.
constexpr double glassOpacity = 0.15;

/// A picture times a colour, under the name of what it feeds.
void writePicture(Writer& out, const std::string& name, const std::string& material, const SurfaceLook& look,
                  const Vec3f& colour) {
  out.open("def Shader \"{}\"", name);
  out.line("uniform token info:id = \"UsdUVTexture\"");
  out.line("asset inputs:file = {}", asset(look.picture.string()));
  out.line("float4 inputs:scale = ({}, {}, {}, 1)", colour.x, colour.y, colour.z);
  out.line("token inputs:sourceColorSpace = \"sRGB\"");
  out.line("float2 inputs:st.connect = <{}/st.outputs:result>", material);
  out.line("token inputs:wrapS = \"repeat\"");
  out.line("token inputs:wrapT = \"repeat\"");
  out.line("float3 outputs:rgb");
  out.close();
}

void writePictures(Writer& out, const std::string& material, const SurfaceLook& look, bool glows) {
  out.open("def Shader \"st\"");
  out.line("uniform token info:id = \"UsdPrimvarReader_float2\"");
  out.line("string inputs:varname = \"st\"");
  out.line("float2 outputs:result");
  out.close();
  writePicture(out, "diffuse", material, look, look.colour);
  if (glows) writePicture(out, "glow", material, look, look.emission);
}

void writeMaterial(Writer& out, const std::string& name, const std::string& prim, const SurfaceLook& look) {
  const std::string path = fmt::format("{}/{}", scope, prim);
  const bool pictured = !look.picture.empty(), glows = !(look.emission == Vec3f{});
  out.line("def Material \"{}\" (", prim);
  out.line("    customData = {{ string name = {} }}", inQuotes(name));
  out.open(")");
  out.line("token outputs:surface.connect = <{}/surface.outputs:surface>", path);
  out.open("def Shader \"surface\"");
  out.line("uniform token info:id = \"UsdPreviewSurface\"");
  if (pictured)
    out.line("color3f inputs:diffuseColor.connect = <{}/diffuse.outputs:rgb>", path);
  else
    out.line("color3f inputs:diffuseColor = {}", value(look.colour));
  if (glows && pictured) out.line("color3f inputs:emissiveColor.connect = <{}/glow.outputs:rgb>", path);
  if (glows && !pictured) out.line("color3f inputs:emissiveColor = {}", value(look.emission));
  out.line("float inputs:roughness = {}", look.roughness);
  out.line("float inputs:metallic = {}", look.metallic);
  if (look.glass) {
    out.line("float inputs:opacity = {}", glassOpacity);
    out.line("float inputs:ior = {}", look.refractiveIndex);
  }
  out.line("token outputs:surface");
  out.close();
  if (pictured) writePictures(out, path, look, glows);
  out.close();
}

}  // namespace

std::string Materials::pathOf(const FrameBody& body, const std::string& part) {
  const NamedLook named = lookOf(looks_, body, part);
  const auto [place, isNew] = entries_.try_emplace(named.name, Entry{"", named.look});
  if (isNew) place->second.prim = names_.unique(named.name);
  return fmt::format("{}/{}", scope, place->second.prim);
}

void Materials::write(Writer& out) const {
  out.open("def Scope \"Materials\"");
  for (const auto& [name, entry] : entries_) writeMaterial(out, name, entry.prim, entry.look);
  out.close();
}

}  // namespace brisance::usd
