// What each word behind `brisance` does. Every function returns the exit code; trouble is thrown.
#pragma once

#include "options.h"

namespace brisance {

int runCommand(const Options& options);
int simulateCommand(const Options& options);
int renderCommand(const Options& options);
int encodeCommand(const Options& options);

int farmCommand(const Options& options);
int exportCommand(const Options& options);
int viewCommand(const Options& options);
int fractureCommand(const Options& options);
int checkCommand(const Options& options);
int infoCommand(const Options& options);
int verifyCommand(const Options& options);
int referenceCommand(const Options& options);

/// The option with which a command that was interrupted continues; empty: as it was typed.
std::string continuingOption(const std::string& command);

}  // namespace brisance
