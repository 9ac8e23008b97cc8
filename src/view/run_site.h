// What is served under which address: the page, what it asks of the run, and the run's own files.
#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "view/http_request.h"
#include "view/player_run.h"

namespace brisance {

class RunSite {
 public:
  RunSite(const PlayerRun& run, std::string page);
  /// May be called by several threads.
  HttpAnswer answer(const HttpRequest& request);

 private:
  HttpAnswer data(const std::string& name);
  HttpAnswer moment(int frame);
  /// A file of the run that its manifest names, and that really lies in it.
  HttpAnswer file(const std::string& name) const;

  const PlayerRun& run_;
  HttpAnswer page_;
  std::mutex guard_;
  using MomentKey = std::pair<int, std::string>;  ///< a frame and its version
  std::map<MomentKey, HttpAnswer> moments_;       ///< those last asked for, up to a number of bytes
  std::deque<MomentKey> order_;                   ///< in which they came
  std::size_t bytes_ = 0;
};

}  // namespace brisance
