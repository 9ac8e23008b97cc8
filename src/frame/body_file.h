// Where bodies are in a frame, and how the step towards it went, as JSON.
#pragma once

#include <string>

#include "frame/frame.h"

namespace brisance {

/// The frame's number, time and bodies without their meshes: names, poses, velocities, temperatures. Numbers are
/// written in the fewest digits that read back as the same bits.
std::string bodiesToJson(const Frame& frame);
/// Fills index, time and bodies (name, pose, velocities, temperature). Throws DamagedFile.
void bodiesFromJson(const std::string& text, const std::string& fileName, Frame& frame);
/// Hash of the bodies' names, poses, velocities and temperatures.
std::string contentHash(const std::vector<FrameBody>& bodies);

std::string reportToJson(const Frame& frame);
/// Throws DamagedFile.
StepReport reportFromJson(const std::string& text, const std::string& fileName);

}  // namespace brisance
