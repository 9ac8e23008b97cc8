// A border's edges become edges of a triangulation (Sloan 1993): what crosses them is flipped away.
#include <deque>

#include "base/check.h"
#include "mesh/triangle_net.h"
#include "mesh/triangulation_methods.h"

namespace brisance {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A triangle and one of its edges, by its place from 0 to 2.
struct Place {
  std::uint32_t triangle = noTriangle;
  int edge = 0;
};

class BorderNet {
 public:
  BorderNet(std::vector<Triangle> triangles, const std::vector<LatticePoint>& nodes,
            const std::vector<std::uint32_t>& border)
      : nodes_(nodes), border_(border), net_(std::move(triangles), nodes.size()), nextOnBorder_(nodes.size(), noPoint) {
    trianglesAt_.assign(nodes.size(), noTriangle);
    for (std::uint32_t t = 0; t < net_.triangles().size(); ++t) noteCorners(t);
    for (std::size_t i = 0; i < border.size(); ++i) {
      if (nextOnBorder_[border[i]] != noPoint) refuse(border[i]);
      nextOnBorder_[border[i]] = border[(i + 1) % border.size()];
    }
  }

  void bringInBorder() {
    for (const std::uint32_t from : border_) bringIn({from, nextOnBorder_[from]});
  }

  /// Lawson's flips (1977), over all edges but the border's.
  void flipToDelaunay() {
    std::vector<std::uint32_t> open(net_.triangles().size());
    for (std::uint32_t t = 0; t < open.size(); ++t) open[t] = static_cast<std::uint32_t>(open.size()) - 1 - t;
    while (!open.empty()) {
      const std::uint32_t triangle = open.back();
      open.pop_back();
      for (int edge = 0; edge < 3; ++edge) {
        if (!wantsFlip({triangle, edge})) continue;
        const std::uint32_t other = flip({triangle, edge});
        open.push_back(triangle);
        open.push_back(other);
        break;
      }
    }
  }

  /// From the triangles to the left of the border as far as it lets through.
  std::vector<Triangle> inside() const {
    std::vector<bool> reached(net_.triangles().size(), false);
    std::vector<std::uint32_t> open;
    const auto reach = [&](std::uint32_t triangle) {
      if (triangle == noTriangle || reached[triangle]) return;
      reached[triangle] = true;
      open.push_back(triangle);
    };
    for (std::uint32_t t = 0; t < net_.triangles().size(); ++t)
      for (int edge = 0; edge < 3; ++edge)
        if (nextOnBorder_[net_.triangles()[t][edge]] == net_.triangles()[t][(edge + 1) % 3]) reach(t);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (int edge = 0; edge < 3; ++edge)
        if (!isBorder(edgeAt({t, edge}))) reach(net_.neighbours()[t][edge]);
    }
    std::vector<Triangle> result;
    for (std::uint32_t t = 0; t < reached.size(); ++t)
      if (reached[t]) result.push_back(net_.triangles()[t]);
    return result;
  }

 private:
  static constexpr std::uint32_t noPoint = 0xFFFFFFFFu;

  [[noreturn]] static void refuse(std::uint32_t point) {
    throw InputError(fmt::format(
        "triangulation: the border must not touch itself or a point inside, it does at point {} (from 0)", point));
  }

  Edge edgeAt(const Place& place) const {
    const Triangle& t = net_.triangles()[place.triangle];
    return {t[place.edge], t[(place.edge + 1) % 3]};
  }
  std::uint32_t apexAt(const Place& place) const { return net_.triangles()[place.triangle][(place.edge + 2) % 3]; }
  bool isBorder(const Edge& e) const {
    return nextOnBorder_[e.first] == e.second || nextOnBorder_[e.second] == e.first;
  }
  Place across(const Place& place) const {
    const std::uint32_t other = net_.neighbours()[place.triangle][place.edge];
    return other == noTriangle ? Place{} : Place{other, net_.edgeTo(other, place.triangle)};
  }
  std::int64_t turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation(nodes_[a], nodes_[b], nodes_[c]);
  }

  void noteCorners(std::uint32_t triangle) {
    for (const std::uint32_t corner : net_.triangles()[triangle]) trianglesAt_[corner] = triangle;
  }
  std::uint32_t flip(const Place& place) {
    const std::uint32_t other = net_.neighbours()[place.triangle][place.edge];
    net_.flip(place.triangle, place.edge);
    noteCorners(place.triangle);
    noteCorners(other);
    return other;
  }
  bool wantsFlip(const Place& place) const {
    const Place other = across(place);
    if (other.triangle == noTriangle || isBorder(edgeAt(place))) return false;
    const Triangle& t = net_.triangles()[place.triangle];
    return insideCircleOrTie(nodes_[t[0]], nodes_[t[1]], nodes_[t[2]], nodes_[apexAt(other)]);
  }

  /// Calls visit(place of the edge that leaves the point) for each triangle around it until visit returns true.
  template <class Visit>
  bool around(std::uint32_t point, const Visit& visit) const {
    const auto placeOf = [&](std::uint32_t triangle) {
      const Triangle& t = net_.triangles()[triangle];
      return Place{triangle, static_cast<int>(std::find(t.begin(), t.end(), point) - t.begin())};
    };
    const std::uint32_t start = trianglesAt_[point];
    std::uint32_t t = start;
    do {  // counter-clockwise, until around or at the hull
      const Place place = placeOf(t);
      if (visit(place)) return true;
      t = net_.neighbours()[t][(place.edge + 2) % 3];
    } while (t != noTriangle && t != start);
    if (t == start) return false;
    for (t = net_.neighbours()[start][placeOf(start).edge]; t != noTriangle;) {  // and clockwise from the start
      const Place place = placeOf(t);
      if (visit(place)) return true;
      t = net_.neighbours()[t][place.edge];
    }
    return false;
  }

  /// The edge that runs from `from` to `to` or back, if there is one.
  Place find(const Edge& edge) const {
    Place found;
    around(edge.first, [&](const Place& place) {
      const Place incoming{place.triangle, (place.edge + 2) % 3};
      if (edgeAt(place).second == edge.second)
        found = place;
      else if (edgeAt(incoming).first == edge.second)
        found = incoming;
      return found.triangle != noTriangle;
    });
    return found;
  }

  /// The edges that a border edge crosses, in order from its start.
  std::deque<Edge> crossed(const Edge& border) const {
    Place place;
    around(border.first, [&](const Place& leaving) {
      const Place opposite{leaving.triangle, (leaving.edge + 1) % 3};
      const auto [right, left] = edgeAt(opposite);
      const std::int64_t atRight = turn(border.first, border.second, right),
                         atLeft = turn(border.first, border.second, left);
      if (atRight == 0 && isAhead(border, right)) refuse(right);
      if (atLeft == 0 && isAhead(border, left)) refuse(left);
      if (atRight >= 0 || atLeft <= 0) return false;
      place = opposite;
      return true;
    });
    std::deque<Edge> edges;
    while (place.triangle != noTriangle) {
      if (isBorder(edgeAt(place))) refuse(edgeAt(place).first);
      edges.push_back(edgeAt(place));
      const Place entered = across(place);
      CHECK(entered.triangle != noTriangle, "a border edge leaves the hull");
      const std::uint32_t apex = apexAt(entered);
      if (apex == border.second) return edges;
      const std::int64_t side = turn(border.first, border.second, apex);
      if (side == 0) refuse(apex);
      // entered.edge runs from left to right of the border edge; leave across the side that straddles it.
      place = {entered.triangle, (entered.edge + (side > 0 ? 1 : 2)) % 3};
    }
    CHECK(false, "the border edge {} - {} leads nowhere", border.first, border.second);
    return edges;
  }
  /// Of a point in line with a border edge: whether it lies on the side of its end.
  bool isAhead(const Edge& border, std::uint32_t point) const {
    const LatticePoint a = nodes_[border.first], b = nodes_[border.second], p = nodes_[point];
    return std::int64_t{b.x - a.x} * (p.x - a.x) + std::int64_t{b.y - a.y} * (p.y - a.y) > 0;
  }

  bool crosses(const Edge& border, const Edge& e) const {
    if (e.first == border.first || e.first == border.second || e.second == border.first || e.second == border.second)
      return false;
    return (turn(border.first, border.second, e.first) > 0) != (turn(border.first, border.second, e.second) > 0);
  }
  /// Whether the diagonals of the quadrilateral around an edge cross.
  bool isConvex(const Place& place) const {
    const auto [a, b] = edgeAt(place);
    const std::uint32_t c = apexAt(place), d = apexAt(across(place));
    return turn(d, c, a) != 0 && turn(d, c, b) != 0 && (turn(d, c, a) > 0) != (turn(d, c, b) > 0);
  }

  void bringIn(const Edge& border) {
    if (find(border).triangle != noTriangle) return;
    std::deque<Edge> open = crossed(border);
    const std::size_t limit = 1000 + 100 * open.size() * open.size();  // many times what any border has needed
    for (std::size_t turns = 0; !open.empty(); ++turns) {
      CHECK(turns < limit, "the border edge {} - {} does not come in", border.first, border.second);
      const Edge edge = open.front();
      open.pop_front();
      const Place place = find(edge);
      if (!isConvex(place)) {
        open.push_back(edge);
        continue;
      }
      const Edge diagonal{apexAt(place), apexAt(across(place))};
      flip(place);
      if (crosses(border, diagonal)) open.push_back(diagonal);
    }
  }

  const std::vector<LatticePoint>& nodes_;
  const std::vector<std::uint32_t>& border_;
  TriangleNet net_;
  std::vector<std::uint32_t> nextOnBorder_;  ///< of each point, noPoint off the border
  std::vector<std::uint32_t> trianglesAt_;   ///< one of each point's
};

}  // namespace

std::vector<Triangle> withinBorder(std::vector<Triangle> hullTriangles, const std::vector<LatticePoint>& nodes,
                                   const std::vector<std::uint32_t>& border) {
  BorderNet net(std::move(hullTriangles), nodes, border);
  net.bringInBorder();
  net.flipToDelaunay();
  return net.inside();
}

}  // namespace brisance
