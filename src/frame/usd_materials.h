// Materials of a USD layer as UsdPreviewSurface.
#pragma once

#include <map>
#include <string>

#include "frame/surface_look.h"
#include "frame/usd_text.h"

namespace brisance::usd {

/// Gathers materials under /World/Materials as meshes ask for them.
class Materials {
 public:
  explicit Materials(const SurfaceLooks& looks) : looks_(looks) {}
  /// The path of the material that `part` of a body's mesh has.
  std::string pathOf(const FrameBody& body, const std::string& part);
  /// The scope with all that was asked for.
  void write(Writer& out) const;

 private:
  struct Entry {
    std::string prim;
    SurfaceLook look;
  };
  const SurfaceLooks& looks_;
  Names names_;
  std::map<std::string, Entry> entries_;  ///< by the name in the scene
};

}  // namespace brisance::usd
