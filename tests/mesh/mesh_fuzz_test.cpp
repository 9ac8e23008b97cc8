// A short run of the fuzz targets without a fuzzer: their corpus, and thousands of damaged copies of it.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "base/random.h"
#include "fuzz/mesh_entry.h"

namespace brisance {
namespace {

struct Target {
  const char* format;
  void (*take)(std::string_view);
};

class FuzzTargets : public testing::TestWithParam<Target> {
 protected:
  static std::vector<std::string> corpus(const char* format) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(BRISANCE_SOURCE_DIR) / "fuzz/corpus" / format))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const auto& file : files) {
      std::ifstream in(file, std::ios::binary);
      contents.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    return contents;
  }

  /// Bits flipped, bytes replaced by those that formats mind, the end cut off, or the end of another file put on.
  static std::string damaged(const std::vector<std::string>& corpus, const Random& random, std::uint64_t round) {
    std::uint64_t draw = 64 * round;
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.below(n, draw++)); };
    std::string text = corpus[below(corpus.size())];
    for (std::size_t changes = 1 + below(4); changes > 0 && !text.empty(); --changes) {
      const std::size_t at = below(text.size());
      constexpr std::string_view minded = "0123456789-.eEfv/ \n\\\"{}[],:\x00\xff\x7f";
      switch (below(5)) {
        case 0:
          text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
          break;
        case 1:
          text[at] = minded[below(minded.size())];
          break;
        case 2:
          text.insert(at, 1, minded[below(minded.size())]);
          break;
        case 3:
          text.resize(at);
          break;
        default:
          const std::string& other = corpus[below(corpus.size())];
          text = text.substr(0, at) + other.substr(below(other.size()));
      }
    }
    return text;
  }
};

TEST_P(FuzzTargets, TakeTheirCorpus) {
  const auto files = corpus(GetParam().format);
  ASSERT_GE(files.size(), 2u);
  for (const std::string& file : files) ASSERT_NO_THROW(GetParam().take(file));
}

TEST_P(FuzzTargets, TakeDamagedFiles) {
  const auto files = corpus(GetParam().format);
  const Random random(1, Stream::test);
  for (std::uint64_t round = 0; round < 3000; ++round)
    ASSERT_NO_THROW(GetParam().take(damaged(files, random, round))) << "round " << round;
}

INSTANTIATE_TEST_SUITE_P(EachReader, FuzzTargets,
                         testing::Values(Target{"obj", fuzz::takeObj}, Target{"ply", fuzz::takePly},
                                         Target{"stl", fuzz::takeStl}, Target{"gltf", fuzz::takeGltf}),
                         [](const auto& target) { return target.param.format; });

}  // namespace
}  // namespace brisance
