// Blender's compositor as the judge of the OpenEXR file of layers: it finds them by name, and gives on their values.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "program.h"
#include "read_layers.h"

namespace brisance::test {
namespace {

using nlohmann::json;

constexpr char blender[] = "/usr/bin/blender";
constexpr char body[] = "pane.003";

class LayersInBlender : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(blender)) GTEST_SKIP() << "Blender is not installed (packaging/test.txt names it)";
    draw();
    open();
  }
  void draw() {
    const std::string scene = path("small.toml"), run = path("run");
    std::string text = smallSceneText(4);
    const std::string one = "samples = 1";
    text.replace(text.find(one), one.size(), "samples = 2\nwrite_exr = true");
    writeText(scene, text);
    const Outcome outcome = runProgram({"run", scene, "-o", run, "--quiet"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    file_ = readLayers(path("run/images/frame.0004.exr"));
  }
  void open() {
    StartOptions options;
    options.binary = blender;
    options.environment = {{"HOME", place_.path().string()}};
    const Outcome outcome = runProgram({"--background", "--factory-startup", "--python-exit-code", "9", "--python",
                                        std::string(BRISANCE_SOURCE_DIR) + "/tests/world/open_layers_in_blender.py",
                                        "--", path("run/images/frame.0004.exr"), body, place_.path().string()},
                                       options);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    seen_ = json::parse(textOf(path("seen.json")));
  }

  std::string path(const std::string& name) const { return (place_ / name).string(); }
  std::size_t pixels() const { return static_cast<std::size_t>(file_.width) * file_.height; }
  /// Four values a pixel.
  std::vector<float> given(const std::string& layer) const {
    const std::string bytes = textOf(path(layer + ".raw"));
    std::vector<float> values(bytes.size() / sizeof(float));
    std::copy_n(bytes.data(), values.size() * sizeof(float), reinterpret_cast<char*>(values.data()));
    return values;
  }
  void holds(const std::string& layer, const std::vector<std::string>& channels) const;
  double variety(const std::string& channel) const;
  void haveTheirNamesAndValues() const;
  void haveACryptomatteThatPicksABodyByItsName() const;

  ScratchDirectory place_;
  ReadLayers file_;
  json seen_;
};

/// What the compositor gave on is what the file's channels say, to the last bit.
void LayersInBlender::holds(const std::string& layer, const std::vector<std::string>& channels) const {
  EXPECT_EQ(seen_.at("sizes").at(layer), json({file_.width, file_.height})) << layer;
  const std::vector<float> values = given(layer);
  ASSERT_EQ(values.size(), 4 * pixels()) << layer;
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (std::size_t p = 0; p < pixels(); ++p)
      ASSERT_EQ(values[4 * p + c], file_.channels.at(channels[c])[p]) << channels[c] << " in pixel " << p;
}

double LayersInBlender::variety(const std::string& channel) const {
  const auto [least, largest] =
      std::minmax_element(file_.channels.at(channel).begin(), file_.channels.at(channel).end());
  return *largest - *least;
}

void LayersInBlender::haveTheirNamesAndValues() const {
  EXPECT_EQ(seen_.at("type"), "MULTILAYER");
  std::vector<std::string> names;
  for (const auto& [name, type] : seen_.at("layers").items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"Alpha", "Combined", "CryptoObject00", "CryptoObject01", "CryptoObject02",
                                             "N", "albedo", "depth", "motion", "variance", "volume"}));
  holds("Combined", {"R", "G", "B", "A"});
  holds("N", {"N.X", "N.Y", "N.Z"});
  holds("albedo", {"albedo.R", "albedo.G", "albedo.B"});
  holds("depth", {"depth.Z"});
  holds("motion", {"motion.X", "motion.Y", "motion.Z"});
  holds("variance", {"variance.R", "variance.G", "variance.B"});
  holds("volume", {"volume.R", "volume.G", "volume.B", "volume.A"});
  for (const char* channel : {"R", "A", "N.Z", "albedo.R", "depth.Z", "motion.X", "variance.R", "volume.R"})
    EXPECT_GT(variety(channel), 0) << channel << " is empty, so nothing was shown";
}

/// Its Cryptomatte node finds a piece by name, and the matte is how much of each pixel the piece covers.
void LayersInBlender::haveACryptomatteThatPicksABodyByItsName() const {
  EXPECT_EQ(seen_.at("cryptomatte"), "CryptoObject");
  EXPECT_EQ(seen_.at("picked"), json({body}));
  const std::vector<float> matte = given("matte");
  ASSERT_EQ(matte.size(), 4 * pixels());
  std::string manifest;
  for (const auto& [key, text] : file_.texts)
    if (key.ends_with("/manifest")) manifest = text;
  const auto id =
      static_cast<std::uint32_t>(std::stoul(json::parse(manifest).at(body).get<std::string>(), nullptr, 16));
  double covered = 0;
  for (std::size_t p = 0; p < pixels(); ++p) {
    float share = 0;
    for (const std::string& layer : std::vector<std::string>{"CryptoObject00.", "CryptoObject01.", "CryptoObject02."})
      for (const std::string& pair : std::vector<std::string>{"RG", "BA"})
        if (std::bit_cast<std::uint32_t>(file_.channels.at(layer + pair[0])[p]) == id)
          share += file_.channels.at(layer + pair[1])[p];
    ASSERT_NEAR(matte[4 * p], share, 1e-6) << "in pixel " << p;
    covered += share;
  }
  EXPECT_GT(covered, 1);
}

/// One test, for Blender is started once for a process.
TEST_F(LayersInBlender, AreWhatTheFileSays) {
  haveTheirNamesAndValues();
  haveACryptomatteThatPicksABodyByItsName();
}

}  // namespace
}  // namespace brisance::test
