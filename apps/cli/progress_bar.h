// Progress on standard error: a bar with rate and time left on a terminal, a line now and then elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace brisance {

class ProgressBar {
 public:
  enum class Style { silent, lines, bar, colouredBar };
  /// The style that fits standard error and NO_COLOR.
  static Style styleFor(bool quiet);

  explicit ProgressBar(Style style) : style_(style) {}
  /// Ends the line of a bar.
  ~ProgressBar() { endLine(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `done` of `total` pieces of `stage` are done: as ProgressSink.
  void show(const std::string& stage, int done, int total);
  /// What follows begins on a line of its own.
  void endLine();

 private:
  using Clock = std::chrono::steady_clock;
  void beginStage(const std::string& stage, int done);
  std::string measured(int done, int total) const;
  void drawBar(int done, int total);

  Style style_;
  std::string stage_;
  int firstDone_ = 0;  ///< pieces that were done when the stage was first heard of
  Clock::time_point stageStart_, lastShown_;
  bool lineOpen_ = false;
};

}  // namespace brisance
