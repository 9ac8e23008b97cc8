#include <nlohmann/json.hpp>

#include "base/check.h"
#include "mesh/mesh_report.h"

namespace brisance {
namespace {

using Json = nlohmann::ordered_json;

struct NamedDefect {
  const char* key;
  const char* text;
  const Defect MeshReport::*defect;
};
constexpr NamedDefect defects[] = {
    {"holes", "holes", &MeshReport::holes},
    {"tangled_edges", "edges of more than two triangles", &MeshReport::tangledEdges},
    {"flipped_edges", "edges between triangles that face opposite ways", &MeshReport::flippedEdges},
    {"pinched_vertices", "pinched vertices", &MeshReport::pinched},
    {"repeated_corners", "triangles that come back to a corner", &MeshReport::repeated},
    {"slivers", "triangles of no area", &MeshReport::slivers},
    {"duplicates", "duplicate triangles", &MeshReport::duplicates},
    {"inside_out", "parts that are inside out", &MeshReport::insideOut}};

Defect crossingOf(const MeshReport& report) {
  return {report.crossing.pairs, report.crossingAt, report.crossing.triangle};
}

std::string namesOf(const std::vector<std::string>& names) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), most); ++n) text += (n > 0 ? ", " : "") + names[n];
  return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

std::string shapeText(const MeshReport& report) {
  const std::string parts = fmt::format("{} part{}", report.parts, report.parts == 1 ? "" : "s");
  if (report.openEdges > 0) return fmt::format("open ({} open edges), {}", report.openEdges, parts);
  if (!report.closed) return "no single surface, " + parts;
  return fmt::format("closed, {}, {} handle{}", parts, report.genus, report.genus == 1 ? "" : "s");
}

std::string carriedText(const MeshReport& report) {
  std::string text;
  if (report.hasNormals) text += "normals";
  if (report.hasUvs) text += text.empty() ? "texture coordinates" : ", texture coordinates";
  if (report.materialNames.empty()) return text;
  return text + (text.empty() ? "" : ", ") +
         fmt::format("{} material{}: {}", report.materialNames.size(), report.materialNames.size() == 1 ? "" : "s",
                     namesOf(report.materialNames));
}

Json placeOf(const Defect& defect) {
  Json place{{"count", defect.count}};
  if (defect.count == 0) return place;
  place["at"] = {defect.at.x, defect.at.y, defect.at.z};
  place["triangle"] = defect.triangle + std::uint64_t{1};
  return place;
}

}  // namespace

std::string meshReportText(const MeshReport& report) {
  const Vec3d size = report.box.size(), low = report.box.lower;
  std::string text = fmt::format("mesh: {} vertices, {} triangles, {}, {:.4g} x {:.4g} x {:.4g}\n", report.vertices,
                                 report.triangles, shapeText(report), size.x, size.y, size.z);
  text += fmt::format("from ({:.6g}, {:.6g}, {:.6g}); area {:.6g}", low.x, low.y, low.z, report.area);
  text += report.closed ? fmt::format(", volume {:.6g}\n", report.volume) : "\n";
  if (const std::string carried = carriedText(report); !carried.empty()) text += "with " + carried + "\n";
  for (const NamedDefect& named : defects)
    if (const Defect& defect = report.*named.defect; defect.count > 0)
      text += fmt::format("{}: {}\n", named.text, textOf(defect));
  if (report.crossing.pairs > 0)
    text += fmt::format("pairs of triangles that cut through each other: {}{}\n",
                        report.crossing.all ? "" : "at least ", textOf(crossingOf(report)));
  else if (!report.crossing.all)
    text += "whether it cuts through itself would take too long to tell\n";
  if (!report.nestingJudged) text += "which parts lie inside others would take too long to tell\n";
  if (report.unusedVertices > 0) text += fmt::format("vertices that no triangle uses: {}\n", report.unusedVertices);
  return text + (report.isSound() ? "sound: a solid as it is\n" : "");
}

std::string meshReportJson(const MeshReport& report) {
  const Vec3d size = report.box.size(), low = report.box.lower, high = report.box.upper;
  Json json{{"kind", "mesh"},
            {"vertices", report.vertices},
            {"triangles", report.triangles},
            {"closed", report.closed},
            {"sound", report.isSound()},
            {"size", {size.x, size.y, size.z}},
            {"lower", {low.x, low.y, low.z}},
            {"upper", {high.x, high.y, high.z}},
            {"places", report.places},
            {"parts", report.parts},
            {"euler", report.euler},
            {"open_edges", report.openEdges},
            {"unused_vertices", report.unusedVertices},
            {"area", report.area},
            {"normals", report.hasNormals},
            {"uvs", report.hasUvs},
            {"materials", report.materialNames}};
  if (report.closed) json["volume"] = report.volume, json["genus"] = report.genus;
  for (const NamedDefect& named : defects) json[named.key] = placeOf(report.*named.defect);
  json["nesting_judged"] = report.nestingJudged;
  json["self_crossings"] = placeOf(crossingOf(report));
  json["self_crossings"]["all"] = report.crossing.all;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace brisance
