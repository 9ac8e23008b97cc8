// What every failure of the program promises.
#pragma once

#include "program.h"

namespace brisance::test {

/// Failed with this exit code and exactly one line on standard error, which holds each of the words.
inline void expectOneLine(const Outcome& outcome, int exitCode, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.exitCode, exitCode) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with('\n')) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
}

/// Nothing half-written: no temporary file, and either no run or one whose files are all as its manifest says.
inline void expectInOrder(const fs::path& run) {
  EXPECT_EQ(temporariesIn(run), std::vector<std::string>());
  if (!fs::exists(run / "manifest.json")) return;
  const Outcome verified = runProgram({"verify", run});
  EXPECT_EQ(verified.exitCode, 0) << verified.err;
}

}  // namespace brisance::test
