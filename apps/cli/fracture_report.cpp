// What `brisance fracture` tells of its work: one JSON object for scripts, a few lines for people.
#include <nlohmann/json.hpp>

#include "broken_body.h"
#include "fracture/partition.h"
#include "mesh/convex_hull.h"
#include "mesh/mesh_topology.h"
#include "run_record.h"

namespace brisance {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Vec3d& v) { return {v.x, v.y, v.z}; }
Json toJson(const Mat3& m) { return {toJson(m.row[0]), toJson(m.row[1]), toJson(m.row[2])}; }

std::string_view methodName(const FractureSettings& settings) { return fractureMethodNames[settings.method.index()]; }

Json weightsOf(const FractureSettings& settings) {
  if (const auto* curvature = std::get_if<Curvature>(&settings.method))
    return curvature->weights == CurvatureWeights::raw ? "raw" : "clipped";
  if (const auto* spectral = std::get_if<Spectral>(&settings.method))
    return spectral->weights == EdgeWeights::unit ? "unit" : "length";
  return nullptr;
}

/// Every piece's touching neighbours, from the bonds that name each pair once.
std::vector<Json> neighboursOf(const FracturedBody& broken) {
  std::vector<Json> neighbours(broken.pieces.size(), Json::array());
  for (const Bond& bond : broken.bonds) {
    neighbours[bond.a].push_back({{"piece", bond.b}, {"area", bond.area}, {"normal", toJson(bond.normal)}});
    neighbours[bond.b].push_back({{"piece", bond.a}, {"area", bond.area}, {"normal", toJson(-bond.normal)}});
  }
  return neighbours;
}

Json pieceJson(const Piece& piece, bool solid, const Json& neighbours) {
  const TriangleMesh surface = welded(piece.mesh);
  Json facts{{"triangles", piece.mesh.triangles.size()},
             {"connected", componentCount(surface) == 1},
             {"closed", isWatertight(surface)},
             {"area", piece.properties.area},
             {"volume", solid ? piece.properties.volume : 0.0},
             {"centroid", toJson(piece.place)},
             {"inertia", toJson(piece.properties.inertia)}};
  const TriangleMesh hull = convexHull(piece.mesh.vertices);
  facts["hull"] = {{"vertices", hull.vertices.size()},
                   {"triangles", hull.triangles.size()},
                   {"volume", solidProperties(hull).volume}};
  facts["neighbours"] = neighbours;
  return facts;
}

/// Where it comes apart: edges of a surface, or faces inside a solid.
Json cutJson(const BrokenBody& body) {
  if (!body.broken.pieceOfTriangle.empty()) {
    const CutLine line = cutLine(body.input, body.broken.pieceOfTriangle);
    return {{"edges", line.edges}, {"length", line.length}};
  }
  double area = 0;
  for (const Bond& bond : body.broken.bonds) area += bond.area;
  return {{"bonds", body.broken.bonds.size()}, {"area", area}};
}

Json bodyJson(const BrokenBody& body) {
  const FracturedBody& broken = body.broken;
  Json facts{{"name", body.name}};
  if (!body.input.triangles.empty())
    facts["input"] = {{"vertices", body.input.vertices.size()},
                      {"triangles", body.input.triangles.size()},
                      {"closed", body.inputClosed}};
  if (!body.repairs.empty()) facts["repairs"] = body.repairs;
  facts["method"] = methodName(body.settings);
  if (const Json weights = weightsOf(body.settings); !weights.is_null()) facts["weights"] = weights;
  facts["seed"] = body.settings.seed;
  if (!broken.eigenvalues.empty()) facts["eigenvalues"] = broken.eigenvalues;
  const std::vector<Json> neighbours = neighboursOf(broken);
  facts["pieces"] = Json::array();
  for (std::size_t n = 0; n < broken.pieces.size(); ++n)
    facts["pieces"].push_back(pieceJson(broken.pieces[n], broken.solid, neighbours[n]));
  facts["cut"] = cutJson(body);
  const double rest = std::max(0.0, body.breakSeconds - broken.graphSeconds - broken.partitionSeconds);
  facts["seconds"] = {{"read", body.readSeconds},
                      {"graph", broken.graphSeconds},
                      {"partition", broken.partitionSeconds},
                      {broken.solid ? "solid" : "pieces", rest}};
  return facts;
}

double megabytes() {
  constexpr double bytesPerMegabyte = 1e6;
  return static_cast<double>(peakMemory()) / bytesPerMegabyte;
}

std::string sizesText(const std::vector<Piece>& pieces) {
  std::vector<std::size_t> sizes;
  sizes.reserve(pieces.size());
  for (const Piece& piece : pieces) sizes.push_back(piece.mesh.triangles.size());
  std::sort(sizes.begin(), sizes.end());
  return fmt::format("{} to {} triangles, median {}", sizes.front(), sizes.back(), sizes[sizes.size() / 2]);
}

std::string bodyText(const BrokenBody& body) {
  std::string text;
  for (const std::string& repair : body.repairs) text += fmt::format("{}: {}\n", body.name, repair);
  const std::vector<Piece>& pieces = body.broken.pieces;
  text += fmt::format("{}: {} {}{} by {}: {}", body.name, pieces.size(), body.broken.solid ? "solid " : "",
                      pieces.size() == 1 ? "piece" : "pieces", methodName(body.settings), sizesText(pieces));
  double volume = 0;
  for (const Piece& piece : pieces) volume += piece.properties.volume;
  if (body.broken.solid) text += fmt::format(", {:.6g} m3 in all", volume);
  if (body.broken.eigenvalues.size() > 1)
    text += fmt::format(", algebraic connectivity {:.6g}", body.broken.eigenvalues[1]);
  return text + fmt::format("; {:.2f} s\n", body.breakSeconds);
}

}  // namespace

std::string fractureJson(const std::vector<BrokenBody>& bodies, const Options& options, double writeSeconds) {
  Json facts;
  if (options.path.extension() == ".toml") {
    facts["bodies"] = Json::array();
    for (const BrokenBody& body : bodies) facts["bodies"].push_back(bodyJson(body));
    facts["seconds"] = {{"read", bodies.front().readSeconds}};
  } else {
    facts = bodyJson(bodies.front());
  }
  facts["seconds"]["write"] = writeSeconds;
  facts["peak_memory_mb"] = megabytes();
  return facts.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string fractureText(const std::vector<BrokenBody>& bodies, const std::vector<std::filesystem::path>& outputs,
                         double writeSeconds) {
  std::string text;
  for (const BrokenBody& body : bodies) text += bodyText(body);
  for (const auto& output : outputs) text += fmt::format("wrote {}\n", output.string());
  if (!outputs.empty()) text += fmt::format("in {:.2f} s\n", writeSeconds);
  return text;
}

}  // namespace brisance
