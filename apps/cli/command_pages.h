// Pages about the commands: for `man`, and one in Markdown for docs/.
#pragma once

#include "command_tree.h"

namespace brisance {

/// brisance(1).
std::string manPage(const DescribedProgram& program);

/// brisance-COMMAND(1).
std::string manPage(const DescribedProgram& program, const DescribedCommand& command);

/// docs/commands.md.
std::string commandsDocument(const DescribedProgram& program);

}  // namespace brisance
