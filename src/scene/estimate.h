// What a scene will cost, known before it is made.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/check.h"
#include "scene/scene_file.h"

namespace brisance {

struct SceneEstimate {
  int frames = 0;
  std::int64_t cells = 0;        ///< of the gas
  std::int64_t volumeCells = 0;  ///< of the picture's fine volume
  std::int64_t bodies = 0;
  std::int64_t pieces = 0;      ///< of all bodies
  std::int64_t particles = 0;   ///< fuel and soot, at most
  std::int64_t simulating = 0;  ///< [bytes] of memory at the peak of the simulation
  std::int64_t drawing = 0;     ///< [bytes] of memory at the peak of a picture
  std::int64_t memory = 0;      ///< [bytes] the larger of the two
  std::int64_t disk = 0;        ///< [bytes] of the whole run, at most
};

SceneEstimate estimate(const Scene& scene);

/// Throws Error(noRoom), one line with what is needed and what there is, when the scene can never fit this machine's
/// memory. `name` is the scene's file.
void requireMemory(const Scene& scene, const std::string& name);

/// What `brisance check` says: the cost where the scene could be read, and one line per problem.
struct SceneCheck {
  std::optional<SceneEstimate> cost;
  std::vector<std::string> problems;  ///< empty: the scene can run here
  ExitCode code = ExitCode::done;     ///< of the first problem
  bool ok() const { return problems.empty(); }
};

/// Reads the scene and weighs it against this machine: free memory, and free space of the disk that holds `run` (where
/// the run directory would be made; its nearest existing parent). Never throws for a bad scene.
SceneCheck checkScene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {},
                      const std::filesystem::path& run = ".");

/// For people: a few lines.
std::string estimateText(const SceneEstimate& cost);
/// For scripts: {"ok": true, "cells": ..., "bytes": ..., "problems": []} and the rest of the estimate. "bytes" is the
/// disk.
std::string checkJson(const SceneCheck& check);

/// Memory that a program may use here at all [bytes]: the machine's, or its container's limit.
std::int64_t machineMemory();
/// Memory that is free now [bytes].
std::int64_t freeMemory();

}  // namespace brisance
