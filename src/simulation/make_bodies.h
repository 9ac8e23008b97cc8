// The scene's bodies, broken and at rest.
#pragma once

#include "mesh/moving_solid.h"
#include "simulation/simulation_settings.h"
#include "simulation/world_state.h"

namespace brisance {

/// One body in pieces, as its settings say; about the body's own origin.
FracturedBody breakBody(const BodySettings& body, std::uint64_t seed);
/// "NAME" of a body that is whole, "NAME.001" and so on of pieces, numbered from 0.
std::string pieceName(const std::string& body, std::size_t piece, std::size_t pieces);

/// Fills bodies and looks; returns what stands in the gas.
std::vector<MovingSolid> makeBodies(const SimulationSettings& settings, WorldState& world);

}  // namespace brisance
