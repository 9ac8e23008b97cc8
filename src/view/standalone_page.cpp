#include "view/standalone_page.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "base/parallel.h"
#include "frame/manifest.h"

namespace brisance {

namespace {

constexpr std::string_view place = "<!-- the run -->";  // in the page, before its script

std::string element(const std::string& name, const std::string& bytes) {
  return fmt::format("<script type=\"text/plain\" data-name=\"{}\">{}</script>\n", name, base64(bytes));
}

std::string momentElements(const PlayerRun& run, int frame) {
  std::string text = element(fmt::format("moments/{}", frame), run.moment(frame));
  if (run.knowsFile(FrameFileNames(frame).shapes))
    text += element(fmt::format("shapes/{}.glb", frame), run.shapes(frame));
  return text;
}

/// Which of the run's frames are here: those of the player are numbered from 1 without gaps.
std::string stateOf(const std::vector<int>& frames) {
  return nlohmann::json{{"frames", frames.size()}, {"planned", frames.size()}, {"numbers", frames}}.dump();
}

}  // namespace

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - n);
    std::uint32_t bits = 0;
    for (std::size_t b = 0; b < 3; ++b) bits = bits << 8 | (b < count ? static_cast<unsigned char>(bytes[n + b]) : 0u);
    for (std::size_t letter = 0; letter < 4; ++letter)
      text += letter <= count ? letters[bits >> (18 - 6 * letter) & 63] : '=';
  }
  return text;
}

std::string standalonePage(const std::string& page, const PlayerRun& run, const std::vector<int>& frames,
                           const FramesDone& told, const StopRequested& stop) {
  const std::size_t at = page.find(place);
  CHECK(at != std::string::npos, "the page has no place for a run");
  std::vector<std::string> moments(frames.size());
  std::atomic<int> done = 0;
  std::mutex guard;
  parallelFor(0, std::ssize(frames), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t n = first; n < last && !stop(); ++n) {
      moments[n] = momentElements(run, frames[n]);
      const std::lock_guard lock(guard);
      told(++done, static_cast<int>(frames.size()));
    }
  });
  std::string whole = page.substr(0, at) + element("run.json", run.description()) +
                      element("state.json", stateOf(frames)) + element("pieces.glb", run.pieces());
  for (const std::string& moment : moments) whole += moment;
  return whole + page.substr(at + place.size());
}

}  // namespace brisance
