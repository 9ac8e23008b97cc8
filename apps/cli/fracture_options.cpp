#include "fracture_options.h"

#include <CLI/CLI.hpp>
#include <charconv>

#include "base/check.h"
#include "fracture/partition.h"

namespace brisance {
namespace {

constexpr std::string_view curvatureWeights[] = {"clipped", "raw"};
constexpr std::string_view edgeWeights[] = {"unit", "length"};
constexpr std::string_view splits[] = {"list", "level"};
constexpr std::string_view insides[] = {"all", "smallest", "largest"};

/// Options that a scene has keys for.
constexpr const char* meshOptions[] = {"--method", "--pieces", "--weights",  "--split",     "--parts",
                                       "--inside", "--impact", "--crowding", "--min-share", "--refine",
                                       "--solid",  "--cells",  "--flat",     "--repair",    "--seed"};

std::string listed(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

/// The place of `word` in `names`, as an enum.
template <class Enum>
void choose(const std::optional<std::string>& word, std::span<const std::string_view> names, const char* option,
            Enum& value) {
  if (!word) return;
  const auto place = std::find(names.begin(), names.end(), *word);
  if (place == names.end())
    throw InputError(fmt::format("brisance: {}: must be one of {}, got {}", option, listed(names), *word));
  value = static_cast<Enum>(place - names.begin());
}

Vec3d parsePoint(const std::string& text, const char* option) {
  Vec3d point;
  const char *at = text.data(), *end = at + text.size();
  for (int axis = 0; axis < 3; ++axis) {
    const auto [next, trouble] = std::from_chars(at, end, point[axis]);
    const bool separated = axis == 2 ? next == end : next != end && *next == ',';
    if (trouble != std::errc() || !separated || !std::isfinite(point[axis]))
      throw InputError(fmt::format("brisance: {}: must be X,Y,Z like 0,0.5,-1, got {}", option, text));
    at = next + 1;
  }
  return point;
}

/// Takes the options that belong to a method, and refuses those that are left.
class MethodOptions {
 public:
  explicit MethodOptions(const RawFractureOptions& raw) : left_(raw), method_(raw.method) {}

  FractureMethod method() {
    for (std::size_t n = 0; n < std::size(fractureMethodNames); ++n)
      if (fractureMethodNames[n] == method_) return checked(ofKind(n));
    throw InputError(
        fmt::format("brisance: --method: must be one of {}, got {}", listed(fractureMethodNames), method_));
  }

 private:
  FractureMethod ofKind(std::size_t kind) {
    FractureMethod method = BreadthFirst{};
    hold(method, kind, std::make_index_sequence<std::variant_size_v<FractureMethod>>{});
    std::visit([this](auto& settings) { take(settings); }, method);
    return method;
  }
  template <std::size_t... I>
  static void hold(FractureMethod& method, std::size_t kind, std::index_sequence<I...>) {
    ((I == kind ? void(method.emplace<I>()) : void()), ...);
  }

  void take(BreadthFirst&) {}
  void take(BreadthFirstThesis& method) { choose(taken(left_.split), splits, "--split", method.split); }
  void take(Curvature& method) {
    choose(taken(left_.weights), curvatureWeights, "--weights", method.weights);
    choose(taken(left_.inside), insides, "--inside", method.inside);
    method.parts = taken(left_.parts).value_or(method.parts);
  }
  void take(Spectral& method) { choose(taken(left_.weights), edgeWeights, "--weights", method.weights); }
  void take(Voronoi& method) {
    if (const auto impact = taken(left_.impact)) method.impact = parsePoint(*impact, "--impact");
    method.crowding = taken(left_.crowding).value_or(method.crowding);
  }

  template <class T>
  static std::optional<T> taken(std::optional<T>& option) {
    return std::exchange(option, std::nullopt);
  }

  FractureMethod checked(FractureMethod method) const {
    refuse("--weights", left_.weights.has_value(), "curvature and spectral");
    refuse("--split", left_.split.has_value(), "breadth_first_thesis");
    refuse("--inside", left_.inside.has_value(), "curvature");
    refuse("--parts", left_.parts.has_value(), "curvature");
    refuse("--impact", left_.impact.has_value(), "voronoi");
    refuse("--crowding", left_.crowding.has_value(), "voronoi");
    return method;
  }
  void refuse(const char* option, bool given, const char* owner) const {
    if (given) throw InputError(fmt::format("brisance: {}: belongs to --method {}, not to {}", option, owner, method_));
  }

  RawFractureOptions left_;
  std::string method_;
};

/// What is offered by completions and pages; whether a word is right is decided with the method.
CLI::Validator offered(std::initializer_list<std::span<const std::string_view>> lists) {
  std::string words;
  for (const auto& list : lists)
    for (const std::string_view word : list) words.append(words.empty() ? 0 : 1, ',').append(word);
  return CLI::Validator(fmt::format("{{{}}}", words));
}

}  // namespace

void addFractureOptions(CLI::App& command, RawFractureOptions& raw) {
  FractureSettings& settings = raw.options.settings;
  command
      .add_option("-o,--output", raw.options.outputs,
                  "pieces as .glb (with a picture beside it), .obj, .ply; or a .png; repeatable")
      ->option_text("OUT")
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag_callback(
      "--no-picture", [&raw] { raw.options.picture = false; }, "none beside a .glb file");
  command.add_option("--method", raw.method, "how pieces are chosen: " + listed(fractureMethodNames))
      ->check(offered({fractureMethodNames}))
      ->option_text("NAME");
  settings.pieces = 16;
  command.add_option("--pieces", settings.pieces, "how many; 16 where not given")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  command.add_flag("--solid", settings.solid.enabled, "solid pieces of a closed mesh, instead of shells");
  command
      .add_option("--cells", settings.solid.cellsPerPiece,
                  "of solid pieces: small cells for each, how rough the inside faces are")
      ->check(CLI::Range(1, 10000))
      ->option_text("N");
  command.add_flag("--flat", settings.solid.flat, "inside faces of solid pieces flat, whatever the method");
  command
      .add_option("--weights", raw.weights, "of curvature: clipped (default), raw; of spectral: unit (default), length")
      ->check(offered({curvatureWeights, edgeWeights}))
      ->option_text("NAME");
  command.add_option("--parts", raw.parts, "of curvature: so many parts, then breadth-first inside them")
      ->check(CLI::Range(1, 1000000))
      ->option_text("N");
  command
      .add_option("--inside", raw.inside, "of curvature with --parts: which are broken further: all, smallest, largest")
      ->check(offered({insides}))
      ->option_text("NAME");
  command.add_option("--split", raw.split, "of breadth_first_thesis: list (default), level")
      ->check(offered({splits}))
      ->option_text("NAME");
  command.add_option("--impact", raw.impact, "of voronoi: pieces are small near this point")->option_text("X,Y,Z");
  command.add_option("--crowding", raw.crowding, "of voronoi with --impact: how much smaller; 2 where not given")
      ->check(CLI::Range(0.0, 10.0))
      ->option_text("C");
  command.add_flag("--refine", settings.refine, "shorten the cuts and even out the sizes afterwards");
  command.add_option("--min-share", settings.minimumShare, "least size of a piece, relative to the mean")
      ->check(CLI::Range(0.0, 1.0))
      ->option_text("S");
  command.add_option("--seed", settings.seed, "of random numbers; 1 where not given")->option_text("S");
  command.add_flag("--repair", raw.options.repair, "mend the mesh first; always done for solid pieces");
  command.add_option("--labels", raw.options.labels, "write one piece number per input triangle to this file")
      ->option_text("FILE");
  command
      .add_option("--explode", raw.options.explode,
                  "in a picture: pull pieces apart by this share of their distance from the middle")
      ->check(CLI::Range(0.0, 100.0))
      ->option_text("F");
}

FractureOptions finished(const RawFractureOptions& raw, const CLI::App& command) {
  FractureOptions options = raw.options;
  options.settings.method = MethodOptions(raw).method();
  for (const char* name : meshOptions) options.givenForMesh = options.givenForMesh || command.count(name) > 0;
  const SolidSettings& solid = options.settings.solid;
  if (!solid.enabled && (solid.flat || solid.cellsPerPiece > 0))
    throw InputError(fmt::format("brisance: {}: wants --solid", solid.flat ? "--flat" : "--cells"));
  if (solid.enabled && !options.labels.empty())
    throw InputError("brisance: --labels: solid pieces cut through triangles; leave out --labels or --solid");
  return options;
}

}  // namespace brisance
