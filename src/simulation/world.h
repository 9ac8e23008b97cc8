// The world: every solver's state, and how a frame of it is made.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "base/progress.h"
#include "frame/frame.h"
#include "frame/gas_file.h"
#include "simulation/simulation_settings.h"

namespace brisance {

/// All solvers' state at a moment (defined in world_state.h).
struct WorldState;
struct RunTotals;

class World {
 public:
  /// Fractures the bodies, stamps the scenery into the gas, lays out the first particles. Throws InputError /
  /// DamagedFile.
  explicit World(SimulationSettings settings);
  ~World();
  World(World&&) noexcept;

  /// One frame of film: sub-steps of the strictest limit. Throws Error(unstable) when a value leaves its range. False
  /// when it was asked to stop between two sub-steps: the next call then goes on from there, to the same bits.
  bool advance(const StopRequested& stopRequested = {});
  /// The same to the frame's end, or not at all: cut in its middle (base/cancellation.h) it throws Interrupted, and the
  /// world is what it was before. A second copy of the world's fields lives meanwhile.
  void advanceOrStay();
  /// The moment now; frame 1 is the start.
  Frame capture() const;
  /// The same in two parts, for those who write it: the gas is made while it is read, and no world may advance
  /// meanwhile.
  Frame captureWithoutGas() const;
  GasSource gas() const;
  int frameIndex() const;
  const RunTotals& totals() const;
  /// For those who read its arrays in place.
  WorldState& state() { return *state_; }
  const SimulationSettings& settings() const { return settings_; }

  /// Everything that `advance` depends on, as bytes; settings are not in it. Not in the middle of a frame.
  void checkpoint(std::ostream& out) const;
  /// Throws DamagedFile when the bytes are no checkpoint of these settings.
  void restore(const std::string& bytes, const std::string& fileName);

 private:
  SimulationSettings settings_;
  std::unique_ptr<WorldState> state_;
};

/// Fuel and soot particles that a whole run may make, without running it.
std::int64_t predictedParticles(const SimulationSettings& settings);

}  // namespace brisance
