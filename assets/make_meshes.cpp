// make_meshes SHAPE TRIANGLES OUT.obj: writes one of the project's own meshes.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "assets/models.h"
#include "assets/sample_meshes.h"
#include "assets/vase.h"
#include "base/check.h"
#include "mesh/mesh_file.h"

namespace {

using brisance::TriangleMesh;

TriangleMesh sheet(long triangles) {
  constexpr double degrees = 110;
  const int cells = static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 4)));
  return brisance::samples::foldedSheet(cells, degrees);
}

int make(const std::string& shape, long triangles, const std::string& file) {
  namespace samples = brisance::samples;
  const std::map<std::string, TriangleMesh (*)(long)> shapes{{"sphere", samples::bumpySphere},
                                                             {"dumbbell", samples::dumbbell},
                                                             {"torus", samples::torus},
                                                             {"figurine", samples::figurine},
                                                             {"sheet", sheet},
                                                             {"vase", brisance::assets::vase},
                                                             {"cow", samples::cow},
                                                             {"teddy", samples::teddy},
                                                             {"statue", samples::statue},
                                                             {"pumpkin", samples::pumpkin}};
  const auto found = shapes.find(shape);
  if (found == shapes.end() || triangles < 100) {
    std::fputs("make_meshes: usage: make_meshes SHAPE TRIANGLES OUT.obj, SHAPE one of", stderr);
    for (const auto& [name, maker] : shapes) std::fprintf(stderr, " %s", name.c_str());
    std::fputs("\n", stderr);
    return static_cast<int>(brisance::ExitCode::badScene);
  }
  brisance::writeObj(file, found->second(triangles));
  return static_cast<int>(brisance::ExitCode::done);
}

}  // namespace

int main(int count, char** arguments) {
  constexpr int words = 4;
  try {
    return make(count == words ? arguments[1] : "", count == words ? std::atol(arguments[2]) : 0,
                count == words ? arguments[3] : "");
  } catch (const std::exception& trouble) {
    std::fprintf(stderr, "make_meshes: %s\n", trouble.what());
    return static_cast<int>(brisance::ExitCode::failed);
  }
}
