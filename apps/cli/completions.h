// Scripts by which shells complete what is typed behind `brisance`.
#pragma once

#include "command_tree.h"

namespace brisance {

std::string bashCompletion(const DescribedProgram& program);
std::string zshCompletion(const DescribedProgram& program);
std::string fishCompletion(const DescribedProgram& program);

}  // namespace brisance
