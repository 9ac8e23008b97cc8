// What keys must agree on with one another.
#pragma once

#include <map>
#include <string>

#include "scene/scene_file.h"

namespace brisance {

/// Where keys were written, for messages.
struct Places {
  const std::map<std::string, std::string>& lines;  ///< path of a key -> "FILE:LINE"; "" -> the file

  /// Of a key, or of the nearest table around it that is written.
  std::string of(std::string path) const;
  /// "bodies.pane", or "bodies.0" where the name is not how the element is known.
  std::string elementPath(const std::string& array, const std::string& name, std::size_t index) const;
  [[noreturn]] void refuse(const std::string& path, const std::string& what) const;
};

/// Fills scene.inputs with the files that the settings name.
void collectInputs(Scene& scene);

/// Throws InputError for values that are each right and wrong together.
void checkTogether(const Scene& scene, const Places& places);

}  // namespace brisance
