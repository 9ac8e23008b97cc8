// What is known of every key of the scene file, for editors and for people. Made from the declarations that the reader
// uses.
#pragma once

#include <string>

namespace brisance {

/// JSON Schema (draft-07) of the scene file.
std::string sceneSchema();

/// docs/parameters.md: the symbols of the thesis' Tables 2.1, 2.2, 3.1, 5.1 and 5.3 with their keys, then every key.
std::string parametersDocument();

}  // namespace brisance
