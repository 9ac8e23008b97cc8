// What fuel and soot may be told (thesis Tables 2.1, 5.1, 5.3).
#pragma once

#include <vector>

#include "base/math.h"

namespace brisance {

/// Fuel laid out on a sphere at a moment, and more of it for a while afterwards.
struct Charge {
  Vec3d position;                  ///< pos_det [m]
  double radius = 0.1;             ///< r_d [m]
  double time = 0;                 ///< [s]
  int particles = 1000;            ///< n_p
  int ignited = 10;                ///< np_i: burning from the start
  double emissionRate = 0;         ///< np_it as a rate [1/s]
  double emissionTime = 0;         ///< [s] for how long
  int sparks = 0;                  ///< thrown out at that time
  double sparkSpeed = 15;          ///< [m/s] of the fastest
  double sparkTemperature = 2200;  ///< [K]
};

struct BurnSettings {
  double mass = 0.36e-3;               ///< m [kg] of a fresh fuel particle
  double radius = 0.1;                 ///< r [m] in drag and heating
  double burnRate = 1.2e-3;            ///< z_f [kg/s]
  double sootBurnRate = 0;             ///< z_s [kg/s]: how fast soot vanishes
  double heatPerMass = 137400;         ///< b_h [J/kg]
  double gasPerMass = 0.6;             ///< b_g [m3/kg]
  double sootPerMass = 1.0;            ///< b_s [kg/kg]
  double sootThreshold = 2e-5;         ///< c_soot [kg]: accumulated soot that becomes a particle
  bool sootOnce = false;               ///< the thesis' choice: one soot particle per fuel particle
  double sootPositionSpread = 0.003;   ///< [m] deviation of the perturbation of a new soot particle
  double sootVelocitySpread = 0.02;    ///< relative deviation of its velocity
  double thermalMass = 20.54;          ///< c_m [J/K]
  double heating = 24000;              ///< alpha_h [W/(m2 K)]
  double drag = 1.5;                   ///< alpha_d [kg/m3]
  double ignitionTemperature = 425;    ///< T_i [K]
  double fuelMassThreshold = 1e-9;     ///< thres_mf [kg]
  double sootMassThreshold = 1e-8;     ///< thres_ms [kg]
  double thermalMassThreshold = 1e-4;  ///< thres_cm [J/K]
  double depositRadius = 0.045;        ///< [m] of the kernel that spreads heat and gas, the same on every grid
};

/// Sparks or dust: balls of one size.
struct BitSettings {
  double radius = 0.5e-3;    ///< [m]
  double density = 2500;     ///< [kg/m3]
  double coolingTime = 0.6;  ///< [s] in which they come to the gas' temperature, to 1/e
};

struct ParticleSettings {
  BurnSettings burning;
  std::vector<Charge> charges;
  BitSettings sparks, dust;
};

}  // namespace brisance
