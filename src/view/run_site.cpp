#include "view/run_site.h"

#include <algorithm>
#include <charconv>

#include "base/check.h"
#include "frame/manifest.h"

namespace brisance {

namespace fs = std::filesystem;

namespace {

/// "moments/12" after "moments/" is 12; 0: no such name.
int numberAfter(const std::string& name, std::string_view lead, std::string_view ending = "") {
  if (!name.starts_with(lead) || !name.ends_with(ending) || name.size() <= lead.size() + ending.size()) return 0;
  int number = 0;
  const char* last = name.data() + name.size() - ending.size();
  const auto [end, trouble] = std::from_chars(name.data() + lead.size(), last, number);
  return trouble == std::errc() && end == last && number > 0 ? number : 0;
}

std::string typeOf(const fs::path& file) {
  static const std::map<std::string, std::string> types{{".mp4", "video/mp4"},   {".png", "image/png"},
                                                        {".jpg", "image/jpeg"},  {".json", "application/json"},
                                                        {".toml", "text/plain"}, {".glb", "model/gltf-binary"}};
  const auto found = types.find(file.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

HttpAnswer notThere() { return refusal(404, "nothing of that name is here"); }

HttpAnswer changing(HttpAnswer answer) {
  answer.changes = true;
  return answer;
}

}  // namespace

RunSite::RunSite(const PlayerRun& run, std::string page)
    : run_(run), page_(answerWith("text/html; charset=utf-8", std::move(page))) {
  page_.page = true;
}

HttpAnswer RunSite::answer(const HttpRequest& request) {
  constexpr std::string_view dataLead = "/data/", runLead = "/run/";
  const std::string& path = request.path;
  if (path == "/") return page_;
  if (path.starts_with(dataLead)) return data(path.substr(dataLead.size()));
  if (path.starts_with(runLead)) return file(path.substr(runLead.size()));
  return notThere();
}

HttpAnswer RunSite::data(const std::string& name) {
  if (name == "run.json") return changing(answerWith("application/json", run_.description()));
  if (name == "state.json") return changing(answerWith("application/json", run_.state()));
  if (name == "pieces.glb") return answerWith("model/gltf-binary", run_.pieces());
  if (const int frame = numberAfter(name, "moments/")) return moment(frame);
  if (const int frame = numberAfter(name, "shapes/", ".glb"))
    return run_.knowsFile(FrameFileNames(frame).shapes) ? answerWith("model/gltf-binary", run_.shapes(frame))
                                                        : notThere();
  return notThere();
}

HttpAnswer RunSite::moment(int frame) {
  const MomentKey key{frame, run_.version(frame)};
  if (key.second.empty()) return notThere();
  {
    const std::lock_guard lock(guard_);
    if (const auto found = moments_.find(key); found != moments_.end()) return found->second;
  }
  HttpAnswer made = answerWith("application/octet-stream", run_.moment(frame));
  const std::lock_guard lock(guard_);
  if (!moments_.emplace(key, made).second) return made;
  order_.push_back(key);
  bytes_ += made.body->size();
  constexpr std::size_t mostBytes = 64 << 20;
  while (bytes_ > mostBytes && order_.size() > 1) {
    bytes_ -= moments_.at(order_.front()).body->size();
    moments_.erase(order_.front());
    order_.pop_front();
  }
  return made;
}

HttpAnswer RunSite::file(const std::string& name) const {
  if (!isNameInRun(name) || !run_.knowsFile(name)) return notThere();
  std::error_code error;
  const fs::path run = fs::canonical(run_.path(), error), file = fs::canonical(run_.path() / name, error);
  if (error || file != run / name || !fs::is_regular_file(file)) return notThere();  // a link that leads elsewhere
  return answerWith(typeOf(file), readFile(file));
}

}  // namespace brisance
