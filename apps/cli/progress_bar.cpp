#include "progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace brisance {

namespace {

constexpr int barWidth = 30;  // letters
constexpr std::chrono::milliseconds barInterval{100};
constexpr std::chrono::seconds lineInterval{5};

std::string asTime(double seconds) {
  const int whole = static_cast<int>(std::min(seconds + 0.5, 1e9));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressBar::Style ProgressBar::styleFor(bool quiet) {
  if (quiet) return Style::silent;
  if (isatty(STDERR_FILENO) == 0) return Style::lines;
  const char* noColour = std::getenv("NO_COLOR");  // no-color.org: any value but an empty one
  return noColour && *noColour ? Style::bar : Style::colouredBar;
}

void ProgressBar::beginStage(const std::string& stage, int done) {
  endLine();
  stage_ = stage;
  firstDone_ = done;
  stageStart_ = Clock::now();
  lastShown_ = {};
}

/// " 3.1/s, 20 s left", from what was done while we watched.
std::string ProgressBar::measured(int done, int total) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - stageStart_).count();
  const int watched = done - firstDone_;
  if (watched <= 0 || seconds <= 0) return "";
  const double rate = watched / seconds;
  const std::string speed = rate >= 1 ? fmt::format(" {:.1f}/s", rate) : fmt::format(" {:.1f} s each", 1 / rate);
  return done < total ? fmt::format("{}, {} left", speed, asTime((total - done) / rate))
                      : fmt::format("{}, took {}", speed, asTime(seconds));
}

void ProgressBar::drawBar(int done, int total) {
  const int filled = barWidth * std::min(done, total) / std::max(total, 1);
  const bool coloured = style_ == Style::colouredBar;
  print(fmt::format("\r{:<9}{}{:#<{}}{}{:.<{}} {}/{}{}\033[K", stage_, coloured ? "\033[33m" : "", "", filled,
                    coloured ? "\033[0m" : "", "", barWidth - filled, done, total, measured(done, total)));
  lineOpen_ = true;
}

void ProgressBar::show(const std::string& stage, int done, int total) {
  if (style_ == Style::silent) return;
  const bool begins = stage != stage_;
  if (begins) beginStage(stage, done);
  const bool ends = done >= total;
  const auto interval = style_ == Style::lines ? Clock::duration(lineInterval) : Clock::duration(barInterval);
  if (!begins && !ends && Clock::now() - lastShown_ < interval) return;
  lastShown_ = Clock::now();
  if (style_ == Style::lines)
    print(fmt::format("{} {}/{}{}\n", stage_, done, total, measured(done, total)));
  else
    drawBar(done, total);
  if (ends) endLine();
}

void ProgressBar::endLine() {
  if (lineOpen_) print("\n");
  lineOpen_ = false;
}

}  // namespace brisance
