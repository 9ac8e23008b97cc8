#include <bit>
#include <numeric>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "fracture/breadth_first.h"

namespace brisance {
namespace {

using List = std::vector<std::uint32_t>;

/// The triangles at each vertex, in compressed rows.
struct VertexRows {
  List first, triangles;
  explicit VertexRows(const TriangleMesh& mesh);
};

VertexRows::VertexRows(const TriangleMesh& mesh)
    : first(mesh.vertices.size() + 1, 0), triangles(3 * mesh.triangles.size()) {
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++first[v + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  List next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) triangles[next[v]++] = t;
}

/// A list C of the thesis, and where its levels are halved.
struct Search {
  List list;
  std::size_t levelsHalved = 0;  ///< triangles of level <= maxLevel / 2
};

class ThesisSplitter {
 public:
  ThesisSplitter(const TriangleMesh& mesh, ThesisSplit split, std::optional<std::uint64_t> rootSeed,
                 std::vector<int>& pieceOf)
      : mesh_(mesh),
        rows_(mesh),
        split_(split),
        rootSeed_(rootSeed),
        pieceOf_(pieceOf),
        listed_(mesh.triangles.size(), 0),
        flagged_(mesh.triangles.size(), 0),
        spread_(mesh.vertices.size(), 0) {}

  void divide(const List& list, int firstPiece, int pieces) {
    if (pieces == 1) {
      for (const std::uint32_t t : list) pieceOf_[t] = firstPiece;
      return;
    }
    const Search search = searchFrom(list, root(list, firstPiece, pieces));
    const std::size_t wanted = split_ == ThesisSplit::list ? (list.size() + 1) / 2 : search.levelsHalved;
    const std::size_t least = pieces / 2;
    const auto middle =
        search.list.begin() + static_cast<std::ptrdiff_t>(std::clamp(wanted, least, list.size() - least));
    divide(List(search.list.begin(), middle), firstPiece, pieces / 2);
    divide(List(middle, search.list.end()), firstPiece + pieces / 2, pieces / 2);
  }

 private:
  std::uint32_t root(const List& list, int firstPiece, int pieces) const {
    if (!rootSeed_) return list.front();
    const auto place = static_cast<std::uint64_t>(firstPiece) << 32 | static_cast<std::uint64_t>(pieces);
    return list[Random(*rootSeed_, Stream::thesisRoot).below(list.size(), place)];
  }

  /// Breadth-first over triangles of the list that share a vertex; those not reached follow in the list's order.
  Search searchFrom(const List& list, std::uint32_t root) {
    ++search_;
    for (const std::uint32_t t : list) listed_[t] = search_;
    Search result;
    std::vector<std::size_t> levelEnd;
    const auto add = [&](std::uint32_t t) {
      flagged_[t] = search_;
      result.list.push_back(t);
    };
    add(root);
    for (std::size_t next = 0; next < result.list.size();) {
      levelEnd.push_back(result.list.size());
      for (; next < levelEnd.back(); ++next)
        for (const std::uint32_t v : mesh_.triangles[result.list[next]]) {
          if (std::exchange(spread_[v], search_) == search_) continue;
          for (std::uint32_t i = rows_.first[v]; i < rows_.first[v + 1]; ++i) {
            const std::uint32_t child = rows_.triangles[i];
            if (listed_[child] == search_ && flagged_[child] != search_) add(child);
          }
        }
    }
    const std::size_t maxLevel = levelEnd.size() - 1;
    result.levelsHalved = levelEnd[maxLevel / 2];
    for (const std::uint32_t t : list)
      if (flagged_[t] != search_) result.list.push_back(t);
    return result;
  }

  const TriangleMesh& mesh_;
  const VertexRows rows_;
  const ThesisSplit split_;
  const std::optional<std::uint64_t> rootSeed_;
  std::vector<int>& pieceOf_;
  List listed_, flagged_, spread_;  ///< the search that has the triangle in its list, has flagged it, has spread from
                                    ///< the vertex
  std::uint32_t search_ = 0;
};

void checkPieces(const TriangleMesh& mesh, int pieces) {
  if (pieces < 1 || !std::has_single_bit(static_cast<unsigned>(pieces))) {
    const unsigned below = std::bit_floor(static_cast<unsigned>(std::max(1, pieces)));
    throw InputError(fmt::format("fracture: pieces: must be a power of two for breadth_first_thesis, {} or {}, got {}",
                                 below, 2 * below, pieces));
  }
  if (mesh.triangles.size() < static_cast<std::size_t>(pieces))
    throw InputError(fmt::format("fracture: pieces: must be at most the number of triangles, {}, got {}",
                                 mesh.triangles.size(), pieces));
}

}  // namespace

Partition partitionBreadthFirstThesis(const TriangleMesh& mesh, int pieces, ThesisSplit split,
                                      std::optional<std::uint64_t> rootSeed) {
  checkPieces(mesh, pieces);
  Partition partition{std::vector<int>(mesh.triangles.size()), pieces};
  List all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  ThesisSplitter(mesh, split, rootSeed, partition.pieceOf).divide(all, 0, pieces);
  numberByLowestNode(partition);
  return partition;
}

}  // namespace brisance
