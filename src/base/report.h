// How a solver admits what it did.
#pragma once

#include <map>
#include <string>

namespace brisance {

/// One conserved quantity over some time: gained + lost = in to the solver's accuracy.
struct Balance {
  double in = 0;      ///< created or released
  double gained = 0;  ///< change of what the domain holds
  double out = 0;     ///< left through open faces
  double lost = 0;    ///< given up to the surroundings (radiation)
  /// |in - gained - out - lost| relative to the largest term; 0 when nothing happened.
  double error() const;
  Balance& operator+=(const Balance& other);
};

struct PressureReport {
  int iterations = 0;
  double residual = 0;  ///< relative to the right-hand side
  bool converged = true;
  int sealedPockets = 0;     ///< spaces of gas that no open face of the box reaches
  double removedSource = 0;  ///< [m3/s] net source in them that was let go: sum of magnitudes
};

/// One frame of simulation; sums over its sub-steps, and the worst of them where a sum makes no sense.
struct StepReport {
  int substeps = 0;
  double courant = 0;     ///< largest dt * sum(|u_i|) / dx of any cell
  double divergence = 0;  ///< largest L2 norm of div u - phi relative to that of phi, computed from the final velocity
  PressureReport pressure;
  Balance volume;  ///< [m3] gas: created by the source, and out through the open faces
  Balance heat;    ///< [J] above ambient
  std::map<std::string, double> stageSeconds;
};

}  // namespace brisance
