#include "assets/vase.h"

#include <cmath>

namespace brisance::assets {
namespace {

/// Radius and height of the outline at 0 (middle of the foot) .. 1 (middle of the inside's floor).
Vec2d outline(double s) {
  constexpr double foot = 0.12, rim = 0.88;  // shares of the outline
  if (s < foot) return {0.2 * s / foot, 0};
  if (s < rim) {
    const double t = (s - foot) / (rim - foot);
    return {0.2 + 0.16 * std::sin(pi * std::pow(t, 0.75)) - 0.04 * t, t};
  }
  const double t = (s - rim) / (1 - rim);
  return {0.13 * (1 - t), 1 - 0.9 * std::sin(0.5 * pi * std::min(1.0, 1.2 * t))};
}

double rounded(double x) { return std::round(x * 1e4) / 1e4; }  // keeps the file short

void addVertex(TriangleMesh& mesh, double s, double turn) {
  constexpr double step = 1e-4;
  const Vec2d here = outline(s), way = outline(std::min(1.0, s + step)) - outline(std::max(0.0, s - step));
  const double c = std::cos(2 * pi * turn), n = -std::sin(2 * pi * turn);
  const Vec3d normal = normalized(Vec3d(way.y * c, -way.x, way.y * n));
  mesh.vertices.emplace_back(rounded(here.x * c), rounded(here.y), rounded(here.x * n));
  mesh.normals.emplace_back(rounded(normal.x), rounded(normal.y), rounded(normal.z));
  mesh.uvs.push_back({rounded(turn), rounded(s)});
}

}  // namespace

TriangleMesh vase(long triangles) {
  const int rows = static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 3))), columns = rows * 3 / 2;
  TriangleMesh mesh;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      addVertex(mesh, static_cast<double>(row) / rows, static_cast<double>(column) / columns);
  const auto vertex = [&](int row, int column) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = vertex(row, column), b = vertex(row, column + 1), c = vertex(row + 1, column + 1),
                          d = vertex(row + 1, column);
      if (row > 0) mesh.triangles.push_back({a, b, c});
      if (row + 1 < rows || row == 0) mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

}  // namespace brisance::assets
