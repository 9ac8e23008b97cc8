// Noise taken from pictures of glass and fire, against pictures of many more samples.
#include <gtest/gtest.h>

#include <cmath>

#include "program.h"
#include "render/picture_file.h"

namespace brisance::test {
namespace {

/// A run, drawn again and again with other settings.
class Film {
 public:
  Film(const std::string& scene, const std::vector<std::string>& settings, int frame) : frame_(std::to_string(frame)) {
    done(joined({"simulate", std::string(BRISANCE_SOURCE_DIR) + "/scenes/" + scene, "-o", run(), "--frames",
                 "1-" + frame_, "--quiet"},
                settings));
  }
  Image drawn(int samples, bool denoise, int seed = 1) const {
    done({"render", run(), "--frames", frame_, "--samples", std::to_string(samples), "--set",
          std::string("render.denoise=") + (denoise ? "true" : "false"), "--set", "render.seed=" + std::to_string(seed),
          "--quiet"});
    const std::string name = "frame." + std::string(4 - frame_.size(), '0') + frame_ + ".exr";
    return decodeExr(textOf(place_ / "run" / "images" / name), name);
  }

 private:
  std::string run() const { return (place_ / "run").string(); }
  static std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& settings) {
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    return words;
  }
  static void done(const std::vector<std::string>& words) {
    const Outcome outcome = runProgram(words);
    if (outcome.exitCode != 0) throw std::runtime_error(outcome.err);
  }
  ScratchDirectory place_;
  std::string frame_;
};

/// Of what a screen shows [code values of 255].
double distance(const Image& image, const Image& reference) {
  const Picture a = developed(image, 0), b = developed(reference, 0);
  double sum = 0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n) sum += std::pow(double(a.rgb[n]) - b.rgb[n], 2);
  return std::sqrt(sum / static_cast<double>(a.rgb.size()));
}

/// Deviation over pictures of what a screen shows, root mean square over its pixels.
double flicker(const std::vector<Image>& images) {
  std::vector<double> sums, squares;
  for (const Image& image : images) {
    const Picture picture = developed(image, 0);
    sums.resize(picture.rgb.size());
    squares.resize(picture.rgb.size());
    for (std::size_t n = 0; n < picture.rgb.size(); ++n) {
      sums[n] += picture.rgb[n];
      squares[n] += double(picture.rgb[n]) * picture.rgb[n];
    }
  }
  const auto count = static_cast<double>(images.size());
  double variance = 0;
  for (std::size_t n = 0; n < sums.size(); ++n)
    variance += (squares[n] - sums[n] * sums[n] / count) / (count - 1) / static_cast<double>(sums.size());
  return std::sqrt(variance);
}

const std::vector<std::string> smallPaths{
    "render.width=200",      "render.height=150",  "render.integrator.type=path", "render.integrator.adaptive=false",
    "render.write_exr=true", "render.layers=false"};
constexpr int few = 4, many = 12, reference = 24;  // n of n x n

void expectBetterThanMany(const std::string& scene, int frame) {
  if (!std::getenv("BRISANCE_LONG_TESTS")) GTEST_SKIP() << "minutes: ./dev test --long runs it";
  const Film film(scene, smallPaths, frame);
  const Image truth = film.drawn(reference, false, 7);
  const double cleaned = distance(film.drawn(few, true), truth), raw = distance(film.drawn(many, false), truth);
  const double rawOf128 = raw * std::sqrt(many * many / 128.0);  // n x n samples are never 128
  std::vector<Image> still;
  for (int seed = 1; seed <= 10; ++seed) still.push_back(film.drawn(few, true, seed));
  const double unrest = flicker(still);
  std::printf("%s: 16 samples cleaned %.3f, 144 samples %.3f, flicker of ten %.3f [of 255]\n", scene.c_str(), cleaned,
              raw, unrest);
  EXPECT_LT(cleaned, rawOf128);
  EXPECT_LT(unrest, raw);
  EXPECT_LT(unrest, 1.5);  // steps of the screen
}

}  // namespace

TEST(DenoiserOnFilms, FireInADarkRoomWithGlass) { expectBetterThanMany("features/firelight.toml", 12); }
TEST(DenoiserOnFilms, FireBehindAPane) { expectBetterThanMany("features/fire.toml", 20); }
TEST(DenoiserOnFilms, TheWindowBursting) { expectBetterThanMany("window.toml", 20); }

}  // namespace brisance::test
