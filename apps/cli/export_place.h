// Where an export may be written.
#pragma once

#include <string>

#include "options.h"

namespace brisance {

/// The file of a frame in an exported folder: gas.0001.vdb, bodies.0001.obj.
std::string exportedName(ExportFormat format, int frame);

/// Throws InputError when the output has another ending than its format, is there already without --overwrite, is no
/// earlier export (which alone --overwrite replaces), has no directory to lie in, or belongs to the run itself.
void refuseExportPlace(const Options& options);

}  // namespace brisance
