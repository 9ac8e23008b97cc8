// What a reader wants to know of the commands beside their options.
#pragma once

#include <string>
#include <vector>

namespace brisance {

/// Something by its name, and what it is.
struct Note {
  std::string name, what;
};

/// Command lines to copy.
std::vector<Note> examplesOf(const std::string& command);

/// Each exit code with what it means.
const std::vector<Note>& exitCodeNotes();

/// Variables of the environment.
const std::vector<Note>& environmentNotes();

/// Files that commands read and write.
const std::vector<Note>& fileNotes();

}  // namespace brisance
