// Bodies in place as mesh files that other tools open: OBJ and PLY (glTF: gltf_export.h).
#pragma once

#include <ostream>
#include <vector>

#include "frame/frame.h"

namespace brisance {

/// Wavefront OBJ: one object per body ("o NAME"), materials by name ("usemtl").
void writeObjBodies(std::ostream& out, const std::vector<FrameBody>& bodies);
/// Binary little-endian PLY: one mesh; the property "piece" of a face is its body's number from 0. Normals and texture
/// coordinates (s, t) are there if a body has them; bodies without get zeros.
void writePlyBodies(std::ostream& out, const std::vector<FrameBody>& bodies);

}  // namespace brisance
