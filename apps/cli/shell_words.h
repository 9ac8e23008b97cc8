// Words as a shell takes them.
#pragma once

#include <string>
#include <vector>

namespace brisance {

/// A word, quoted where a shell would make something else of it.
std::string shellQuoted(const std::string& word);
/// Several, with a space between each two.
std::string shellLine(const std::vector<std::string>& words);

}  // namespace brisance
