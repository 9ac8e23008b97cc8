#include "fracture/spectral.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include "base/check.h"
#include "base/parallel.h"
#include "fracture/breadth_first.h"
#include "fracture/curvature.h"

namespace brisance {
namespace {

using Elements = std::vector<std::uint32_t>;  // triangles of a surface, or nodes of a graph

/// A graph to be cut, and what of it each element of the part hangs on: the corners of a triangle, or three times the
/// node that the element is.
struct CutProblem {
  FractureGraph graph;
  std::vector<Triangle> corners;
};

/// Which side each element of a part goes to, and how hard that cut is.
struct Cut {
  std::vector<char> side;           ///< 0 or 1
  std::vector<double> eigenvalues;  ///< of the part
};

/// The thesis takes v < 0; what is 0 but for rounding is 0.
bool isNegative(double v, double largest) {
  constexpr double rounding = 1e-5;
  return v < -rounding * largest;
}

/// Two or three corners on the negative side.
std::vector<char> sidesBySign(const CutProblem& problem, const std::vector<double>& vector) {
  double largest = 0;
  for (const double v : vector) largest = std::max(largest, std::abs(v));
  std::vector<char> side(problem.corners.size());
  for (std::size_t e = 0; e < side.size(); ++e) {
    int negative = 0;
    for (const std::uint32_t node : problem.corners[e]) negative += isNegative(vector[node], largest);
    side[e] = negative < 2;
  }
  return side;
}

/// Half of the elements by the mean of the vector over their corners.
std::vector<char> sidesByMedian(const CutProblem& problem, const std::vector<double>& vector) {
  const auto sum = [&](std::uint32_t e) {
    const auto& [a, b, c] = problem.corners[e];
    return vector[a] + vector[b] + vector[c];
  };
  Elements order(problem.corners.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return sum(a) < sum(b); });
  std::vector<char> side(order.size(), 0);
  for (std::size_t i = order.size() / 2; i < order.size(); ++i) side[order[i]] = 1;
  return side;
}

Cut solve(const CutProblem& problem, const EigenTolerance& tolerance) {
  FiedlerVector fiedler = fiedlerVector(problem.graph, tolerance);
  Cut cut{sidesBySign(problem, fiedler.vector), std::move(fiedler.eigenvalues)};
  const auto [least, greatest] = std::minmax_element(cut.side.begin(), cut.side.end());
  if (*least == *greatest) cut.side = sidesByMedian(problem, fiedler.vector);
  return cut;
}

/// Parts of a body, the weakest of which is cut next.
class WeakestFirst {
 public:
  using ProblemOf = std::function<CutProblem(const Elements&)>;

  /// `neighbours` joins the elements; `problemOf` is called by one thread at a time.
  WeakestFirst(const FractureGraph& neighbours, ProblemOf problemOf, const EigenTolerance& tolerance)
      : neighbours_(neighbours),
        problemOf_(std::move(problemOf)),
        tolerance_(tolerance),
        partOf_(neighbours.nodeCount(), none),
        side_(neighbours.nodeCount(), 0),
        seen_(neighbours.nodeCount(), 0) {
    for (std::uint32_t element = 0; element < partOf_.size(); ++element)
      if (partOf_[element] == none) addComponent(element);
    eigenvalues_.assign(parts_.size(), 0.0);
  }

  void splitInto(int pieces) {
    if (static_cast<int>(parts_.size()) >= pieces) return;
    std::vector<int> all(parts_.size());
    std::iota(all.begin(), all.end(), 0);
    findCuts(all);
    for (const Part& part : parts_)
      if (part.cut.eigenvalues.size() > 1)
        eigenvalues_.insert(eigenvalues_.end(), part.cut.eigenvalues.begin() + 1, part.cut.eigenvalues.end());
    while (static_cast<int>(parts_.size()) < pieces) {
      const int weakest = weakest_.top().part;
      weakest_.pop();
      split(weakest);
      if (static_cast<int>(parts_.size()) < pieces) findCuts({weakest, static_cast<int>(parts_.size()) - 1});
    }
  }

  /// Parts in order of their lowest element.
  Partition partition() const {
    std::vector<int> numberOf(parts_.size(), none);
    Partition result;
    for (const int part : partOf_) {
      if (numberOf[part] == none) numberOf[part] = result.count++;
      result.pieceOf.push_back(numberOf[part]);
    }
    return result;
  }

  std::vector<double> smallestEigenvalues(std::size_t count) const {
    std::vector<double> values = eigenvalues_;
    std::sort(values.begin(), values.end());
    if (values.size() > count) values.resize(count);
    return values;
  }

 private:
  static constexpr int none = -1;
  struct Part {
    Elements elements;
    Cut cut;
  };
  struct Entry {
    double connectivity;
    int part;
    /// The weakest first; of equals the one that is older.
    bool operator<(const Entry& other) const {
      return connectivity != other.connectivity ? connectivity > other.connectivity : part > other.part;
    }
  };

  void addComponent(std::uint32_t start) {
    const int part = static_cast<int>(parts_.size());
    Elements elements{start};
    partOf_[start] = part;
    for (std::size_t next = 0; next < elements.size(); ++next)
      for (const std::uint32_t element : neighbours_.neighbours(elements[next]))
        if (partOf_[element] == none) {
          partOf_[element] = part;
          elements.push_back(element);
        }
    std::sort(elements.begin(), elements.end());
    parts_.push_back({std::move(elements), {}});
  }

  /// An element alone cannot be cut.
  void findCuts(std::vector<int> parts) {
    std::erase_if(parts, [&](int part) { return parts_[part].elements.size() < 2; });
    std::vector<CutProblem> problems;
    for (const int part : parts) problems.push_back(problemOf_(parts_[part].elements));
    parallelFor(0, static_cast<std::int64_t>(parts.size()), 1, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i) {
        Part& part = parts_[parts[i]];
        part.cut = solve(problems[i], tolerance_);
        keepConnected(part);
      }
    });
    for (const int part : parts) weakest_.push({parts_[part].cut.eigenvalues[1], part});
  }

  /// All but the largest island of each side go over to the other side, to which they are joined: first those of side
  /// 0, after which side 0 is one island, then those of side 1, each of which touches it.
  void keepConnected(Part& part) {
    for (std::size_t i = 0; i < part.elements.size(); ++i) side_[part.elements[i]] = part.cut.side[i];
    for (const char side : {char{0}, char{1}}) {
      const std::vector<Elements> islands = islandsOf(part, side);
      const auto largest = std::max_element(islands.begin(), islands.end(),
                                            [](const Elements& a, const Elements& b) { return a.size() < b.size(); });
      for (auto island = islands.begin(); island != islands.end(); ++island)
        if (island != largest)
          for (const std::uint32_t element : *island) side_[element] = static_cast<char>(1 - side);
    }
    for (std::size_t i = 0; i < part.elements.size(); ++i) part.cut.side[i] = side_[part.elements[i]];
  }

  std::vector<Elements> islandsOf(const Part& part, char side) {
    for (const std::uint32_t element : part.elements) seen_[element] = side_[element] != side;
    std::vector<Elements> islands;
    for (const std::uint32_t start : part.elements) {
      if (seen_[start]) continue;
      Elements& island = islands.emplace_back(1, start);
      seen_[start] = 1;
      for (std::size_t next = 0; next < island.size(); ++next)
        for (const std::uint32_t element : neighbours_.neighbours(island[next]))
          if (partOf_[element] == partOf_[start] && !seen_[element]) {
            seen_[element] = 1;
            island.push_back(element);
          }
    }
    return islands;
  }

  void split(int number) {
    const auto newNumber = static_cast<int>(parts_.size());
    Part whole = std::move(parts_[number]);
    Part first, second;
    for (std::size_t i = 0; i < whole.elements.size(); ++i)
      (whole.cut.side[i] ? second : first).elements.push_back(whole.elements[i]);
    CHECK(!first.elements.empty() && !second.elements.empty(), "{} of {}", first.elements.size(),
          whole.elements.size());
    for (const std::uint32_t element : second.elements) partOf_[element] = newNumber;
    parts_[number] = std::move(first);
    parts_.push_back(std::move(second));
  }

  const FractureGraph& neighbours_;
  ProblemOf problemOf_;
  EigenTolerance tolerance_;
  std::vector<int> partOf_;
  std::vector<char> side_, seen_;  ///< scratch, per element; parts that are cut at once share no element
  std::vector<Part> parts_;
  std::priority_queue<Entry> weakest_;
  std::vector<double> eigenvalues_;
};

void refuseMoreThan(int elements, int pieces) {
  CHECK(pieces >= 1, "pieces {}", pieces);
  if (elements < pieces)
    throw InputError(
        fmt::format("fracture: pieces: must be at most the number of triangles, {}, got {}", elements, pieces));
}

SpectralPartition cutSurface(const TriangleMesh& mesh, const FractureGraph& neighbours, VertexGraphs& graphs,
                             int pieces, const EigenTolerance& tolerance) {
  const auto problemOf = [&](const Elements& triangles) {
    VertexGraph part = graphs.of(triangles);
    return CutProblem{std::move(part.graph), std::move(part.triangles)};
  };
  refuseMoreThan(static_cast<int>(mesh.triangles.size()), pieces);
  WeakestFirst parts(neighbours, problemOf, tolerance);
  parts.splitInto(pieces);
  constexpr std::size_t reported = 3;
  return {parts.partition(), parts.smallestEigenvalues(reported)};
}

/// The graph of some nodes alone (all if `kept` is none), without the edges between parts.
FractureGraph insideParts(const FractureGraph& graph, const Partition& parts, std::optional<int> kept) {
  FractureGraph inside;
  inside.first.push_back(0);
  std::vector<std::uint32_t> number(parts.pieceOf.size(), 0);
  std::uint32_t count = 0;
  for (std::size_t node = 0; node < number.size(); ++node)
    if (!kept || parts.pieceOf[node] == *kept) number[node] = count++;
  for (std::uint32_t node = 0; node < number.size(); ++node) {
    if (kept && parts.pieceOf[node] != *kept) continue;
    for (const std::uint32_t next : graph.neighbours(node))
      if (parts.pieceOf[next] == parts.pieceOf[node]) inside.targets.push_back(number[next]);
    inside.first.push_back(static_cast<std::uint32_t>(inside.targets.size()));
  }
  return inside;
}

int chosenPart(const Partition& parts, InsideParts which) {
  std::vector<int> sizes(parts.count, 0);
  for (const int part : parts.pieceOf) ++sizes[part];
  const auto chosen = which == InsideParts::smallest ? std::min_element(sizes.begin(), sizes.end())
                                                     : std::max_element(sizes.begin(), sizes.end());
  return static_cast<int>(chosen - sizes.begin());
}

/// The smallest or the largest part broken so that there are `pieces` in all.
Partition breakOne(const FractureGraph& graph, const Partition& parts, InsideParts which, int pieces) {
  const int chosen = chosenPart(parts, which);
  const FractureGraph inside = insideParts(graph, parts, chosen);
  const int most = inside.nodeCount() + parts.count - 1;
  if (pieces > most)
    throw InputError(fmt::format(
        "fracture: pieces: must be at most {} where only the {} of {} parts, of {} triangles, is broken, got {}", most,
        which == InsideParts::smallest ? "smallest" : "largest", parts.count, inside.nodeCount(), pieces));
  const Partition broken = partitionBreadthFirst(inside, pieces - parts.count + 1);
  Partition result = parts;
  result.count = parts.count - 1 + broken.count;
  auto next = broken.pieceOf.begin();
  for (int& piece : result.pieceOf)
    if (piece == chosen) {
      const int inner = *next++;
      piece = inner == 0 ? chosen : parts.count - 1 + inner;
    }
  return result;
}

}  // namespace

SpectralPartition partitionSurface(const TriangleMesh& mesh, const Curvature& curvature, int pieces,
                                   const EigenTolerance& tolerance) {
  const FractureGraph neighbours = triangleGraph(mesh);
  VertexGraphs graphs(mesh, curvature);
  refuseMoreThan(neighbours.nodeCount(), pieces);
  const int parts = curvature.parts > 0 ? std::min(curvature.parts, pieces) : pieces;
  SpectralPartition result = cutSurface(mesh, neighbours, graphs, parts, tolerance);
  if (result.partition.count >= pieces) return result;
  result.partition = curvature.inside == InsideParts::all
                         ? partitionBreadthFirst(insideParts(neighbours, result.partition, std::nullopt), pieces)
                         : breakOne(neighbours, result.partition, curvature.inside, pieces);
  return result;
}

SpectralPartition partitionSurface(const TriangleMesh& mesh, const Spectral& spectral, int pieces,
                                   const EigenTolerance& tolerance) {
  VertexGraphs graphs(mesh, spectral);
  return cutSurface(mesh, triangleGraph(mesh), graphs, pieces, tolerance);
}

Partition partitionSpectral(const FractureGraph& graph, int pieces, const EigenTolerance& tolerance) {
  std::vector<std::uint32_t> nodeOf(graph.nodeCount(), 0xFFFFFFFFu);
  const auto problemOf = [&](const Elements& nodes) {
    CutProblem problem;
    for (std::uint32_t i = 0; i < nodes.size(); ++i) {
      nodeOf[nodes[i]] = i;
      problem.corners.push_back({i, i, i});
      if (!graph.places.empty()) problem.graph.places.push_back(graph.places[nodes[i]]);
    }
    problem.graph.first.push_back(0);
    for (const std::uint32_t node : nodes) {
      for (std::uint32_t k = graph.first[node]; k < graph.first[node + 1]; ++k) {
        const std::uint32_t target = nodeOf[graph.targets[k]];
        if (target >= nodes.size() || nodes[target] != graph.targets[k]) continue;  // in another part
        problem.graph.targets.push_back(target);
        if (!graph.weights.empty()) problem.graph.weights.push_back(graph.weights[k]);
      }
      problem.graph.first.push_back(static_cast<std::uint32_t>(problem.graph.targets.size()));
    }
    return problem;
  };
  refuseMoreThan(graph.nodeCount(), pieces);
  WeakestFirst parts(graph, problemOf, tolerance);
  parts.splitInto(pieces);
  return parts.partition();
}

}  // namespace brisance
