// Every key of every table of the scene file.
#pragma once

#include "scene/key_visitor.h"
#include "scene/scene_draft.h"

namespace brisance {

/// Shows every key to the visitor. [scene] comes first: the visitor knows the unit of length and the quality before the
/// rest.
void describeScene(KeyVisitor& v, SceneDraft& draft);

// The tables, one function each.
void describeGeneral(KeyVisitor& v, SceneDraft& draft);
void describeGas(KeyVisitor& v, SceneDraft& draft);
void describeExplosion(KeyVisitor& v, ParticleSettings& particles);
void describeRigid(KeyVisitor& v, RigidSettings& rigid);
void describeBody(KeyVisitor& v, BodyKeys& keys);
void describeLattice(KeyVisitor& v, LatticeKeys& keys, Symbol cells);
void describeRender(KeyVisitor& v, SceneDraft& draft);
void describeCamera(KeyVisitor& v, SceneDraft& draft);
void describeMaterial(KeyVisitor& v, MaterialKeys& keys);
void describeLight(KeyVisitor& v, Light& light);

/// Where a quantity of the thesis lives that no key sets.
struct ThesisVariable {
  Symbol symbol;
  const char* variable;
};
std::vector<ThesisVariable> thesisVariables();

}  // namespace brisance
