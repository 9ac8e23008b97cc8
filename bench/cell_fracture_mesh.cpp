// For cell_fracture.sh: writes a sample mesh as OBJ, breaks it into solid pieces and prints how long the breaking took.
// usage: cell_fracture_mesh MESH.obj TRIANGLES PIECES
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "assets/sample_meshes.h"
#include "fracture/solid_fracture.h"
#include "mesh/mesh_file.h"

int main(int count, char** arguments) {
  using namespace brisance;
  if (count != 4) {
    std::fprintf(stderr, "usage: cell_fracture_mesh MESH.obj TRIANGLES PIECES\n");
    return 2;
  }
  const TriangleMesh mesh = samples::bumpySphere(std::atol(arguments[2]));
  writeObj(arguments[1], mesh);
  FractureSettings settings;
  settings.method = Voronoi{};
  settings.pieces = std::atoi(arguments[3]);
  const auto start = std::chrono::steady_clock::now();
  const FracturedBody body = fractureSolid(mesh, settings);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::printf("%zu %.4f\n", body.pieces.size(), seconds.count());
  return 0;
}
