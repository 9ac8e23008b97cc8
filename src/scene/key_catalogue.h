// All declared keys as a tree, for whoever describes the scene file rather than reads it.
#pragma once

#include "scene/key_visitor.h"
#include "scene/scene_text.h"

namespace brisance {

/// A key, or a table of keys.
struct CatalogueEntry {
  enum class Type { flag, integer, number, places, text, file, choice, table, array };
  Key key{"", "", anyValue, ""};
  Type type = Type::table;
  std::size_t count = 1;                                  ///< of numbers; above 1 they stand in brackets
  bool optional = false;                                  ///< key.fallback says what holds where it is not written
  bool typeAlone = false;                                 ///< a table that may be given as the text of its type
  SceneNode value;                                        ///< default
  std::vector<std::string> names;                         ///< of a choice; of the types of a table
  std::vector<CatalogueEntry> children;                   ///< of a table, or of each element of an array
  std::vector<std::vector<CatalogueEntry>> alternatives;  ///< further keys of a table, one list for each of `names`
};

/// The whole scene file, as one table.
CatalogueEntry catalogueOfKeys();

}  // namespace brisance
