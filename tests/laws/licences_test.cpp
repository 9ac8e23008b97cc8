// The product loads only permissive or weak-copyleft libraries: what ldd lists, against a table made by reading each
// package's copyright file. Those files also name the GPL, for build scripts and for programs of the same source, so
// that searching them for a word would prove nothing; the table says which licence covers the library itself.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Licence {
  std::string name;      ///< SPDX
  std::string evidence;  ///< stands in the copyright file of the library's Debian package
};

/// By the library's name up to its version.
const std::map<std::string, Licence>& knownLibraries() {
  static const Licence runtime{"GPL-3.0-or-later WITH GCC-exception-3.1", "GCC Runtime Library Exception"};
  static const std::map<std::string, Licence> table{{"libBulletCollision-float64", {"Zlib", "License: Zlib"}},
                                                    {"libLinearMath-float64", {"Zlib", "License: Zlib"}},
                                                    {"libIex-3_1", {"BSD-3-Clause", "BSD-3-clause"}},
                                                    {"libIlmThread-3_1", {"BSD-3-Clause", "BSD-3-clause"}},
                                                    {"libImath-3_1", {"BSD-3-Clause", "License: imath"}},
                                                    {"libOpenEXR-3_1", {"BSD-3-Clause", "BSD-3-clause"}},
                                                    {"libblosc", {"BSD-3-Clause", "BSD-3-clause"}},
                                                    {"libboost_iostreams", {"BSL-1.0", "BSL-1.0"}},
                                                    {"libbz2", {"bzip2-1.0.6", "BSD-variant"}},
                                                    {"libc", {"LGPL-2.1-or-later", "Lesser"}},
                                                    {"libembree3", {"Apache-2.0", "Apache-2.0"}},
                                                    {"libfmt", {"MIT", "Expat"}},
                                                    {"libgcc_s", runtime},
                                                    {"libjpeg", {"IJG AND BSD-3-Clause AND Zlib", "BSD-3-clause"}},
                                                    {"liblog4cplus-2.0", {"Apache-2.0", "Apache-2.0"}},
                                                    {"liblz4", {"BSD-2-Clause", "BSD-2-clause"}},
                                                    {"liblzma", {"public domain", "PD"}},
                                                    {"libm", {"LGPL-2.1-or-later", "Lesser"}},
                                                    {"libopenvdb", {"MPL-2.0", "MPL-2.0"}},
                                                    {"libpng16", {"libpng-2.0", "libpng"}},
                                                    {"libqhull_r", {"Qhull", "License: Qhull"}},
                                                    {"libsnappy", {"BSD-3-Clause", "BSD-3-Clause"}},
                                                    {"libstdc++", runtime},
                                                    {"libtbb", {"Apache-2.0", "Apache-2.0"}},
                                                    {"libtbbmalloc", {"Apache-2.0", "Apache-2.0"}},
                                                    {"libtomlplusplus", {"MIT", "Expat"}},
                                                    {"libxxhash", {"BSD-2-Clause", "BSD-2-clause"}},
                                                    {"libz", {"Zlib", "Zlib"}},
                                                    {"libzstd", {"BSD-3-Clause", "BSD-3-clause"}},
                                                    // Only in builds with sanitizers.
                                                    {"libasan", {"Apache-2.0 WITH LLVM-exception", "GCC"}},
                                                    {"libtsan", {"Apache-2.0 WITH LLVM-exception", "GCC"}},
                                                    {"libubsan", {"Apache-2.0 WITH LLVM-exception", "GCC"}}};
  return table;
}

std::string outputOf(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  std::string text;
  std::array<char, 4096> part{};
  while (const std::size_t count = fread(part.data(), 1, part.size(), pipe)) text.append(part.data(), count);
  pclose(pipe);
  return text;
}

/// Library files by their names up to the version: "libz" -> "/lib/x86_64-linux-gnu/libz.so.1".
std::map<std::string, fs::path> librariesInText(const std::string& lddText) {
  std::map<std::string, fs::path> found;
  std::istringstream lines(lddText);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, arrow, path;
    // The loader itself and the kernel's page have no arrow.
    if (words >> name >> arrow >> path && arrow == "=>") found[name.substr(0, name.find(".so"))] = path;
  }
  return found;
}

/// Why a library may not be loaded; empty: it may.
std::string troubleWith(const std::string& library) {
  const auto known = knownLibraries().find(library);
  if (known == knownLibraries().end()) return library + " is not in the table of licences";
  return "";
}

/// Packages by file, for library files as ldd names them. dpkg may know a file with or without /usr in front, since the
/// two became one.
std::map<fs::path, std::string> packagesOf(const std::map<std::string, fs::path>& libraries) {
  std::string command = "dpkg -S";
  std::map<std::string, fs::path> asked;
  for (const auto& [name, path] : libraries) {
    const std::string real = fs::canonical(path).string();
    for (const std::string& way : {real, real.starts_with("/usr") ? real.substr(4) : "/usr" + real}) {
      asked[way] = path;
      command += " '" + way + "'";
    }
  }
  std::map<fs::path, std::string> packages;
  std::istringstream answer(outputOf(command + " 2>/dev/null"));
  for (std::string line; std::getline(answer, line);) {
    const std::string file = line.substr(line.rfind(' ') + 1);
    if (asked.contains(file)) packages[asked.at(file)] = line.substr(0, line.find_first_of(":,"));
  }
  return packages;
}

bool isDebian() { return fs::exists("/etc/debian_version") && fs::exists("/usr/bin/dpkg"); }

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool isSanitized = true;
#else
constexpr bool isSanitized = false;
#endif

TEST(Licences, EveryLibraryThatTheProgramLoadsIsInTheTable) {
  if (isSanitized) GTEST_SKIP() << "a build under sanitizers is no product: it loads other libraries";
  const auto libraries = librariesInText(outputOf("ldd " BRISANCE_BINARY));
  ASSERT_GT(libraries.size(), 10u) << "ldd did not list them";
  for (const auto& [library, path] : libraries) EXPECT_EQ(troubleWith(library), "") << path;
}

TEST(Licences, EachPackageSaysWhatTheTableSays) {
  if (isSanitized) GTEST_SKIP() << "a build under sanitizers is no product: it loads other libraries";
  if (!isDebian()) GTEST_SKIP() << "not Debian: there are no copyright files to read";
  const auto libraries = librariesInText(outputOf("ldd " BRISANCE_BINARY));
  const auto packages = packagesOf(libraries);
  for (const auto& [library, path] : libraries) {
    ASSERT_TRUE(packages.contains(path)) << path << " belongs to no package";
    const std::string& package = packages.at(path);
    const std::string copyright = textOf("/usr/share/doc/" + package + "/copyright");
    ASSERT_TRUE(knownLibraries().contains(library)) << library;
    EXPECT_NE(copyright.find(knownLibraries().at(library).evidence), std::string::npos) << library << " of " << package;
  }
}

TEST(Licences, TheTableHoldsNoStrongCopyleft) {
  for (const auto& [library, licence] : knownLibraries()) {
    const bool isGpl = licence.name.starts_with("GPL") || licence.name.starts_with("AGPL");
    EXPECT_TRUE(!isGpl || licence.name.find("WITH GCC-exception") != std::string::npos) << library;
  }
}

TEST(Licences, ALibraryUnderTheGplIsFound) {
  const auto libraries = librariesInText("\tlibfftw3.so.3 => /lib/x86_64-linux-gnu/libfftw3.so.3 (0x0000)\n");
  ASSERT_TRUE(libraries.contains("libfftw3"));
  EXPECT_EQ(troubleWith("libfftw3"), "libfftw3 is not in the table of licences");
}

}  // namespace
