// The extension behind the package `brisance`: scenes, worlds, frames, pictures and broken meshes for Python.
#include <optional>

#include "base/parallel.h"
#include "bindings.h"

namespace brisance::python {
namespace {

void limitThreads(int threads) {
  static std::unique_ptr<ThreadLimit> limit;
  if (threads < 0) throw InputError(fmt::format("threads: must be at least 0, got {}", threads));
  limit.reset();
  limit = std::make_unique<ThreadLimit>(threads);
}

}  // namespace
}  // namespace brisance::python

PYBIND11_MODULE(_brisance, module) {
  using namespace brisance::python;
  module.doc() = "Fracture, burn, simulate and draw explosions. SI units, y up, right-handed.";
  module.attr("__version__") = BRISANCE_VERSION;
  bindExceptions(module);
  bindMeshes(module);
  bindFrames(module);
  bindScenes(module);
  bindPictures(module);
  bindWorlds(module);
  module.def("limit_threads", limitThreads, py::arg("threads"),
             "Work with so many threads from now on; 0: one per core.");
}
