// brisance view: a run in the browser, while it is made or afterwards.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "commands.h"
#include "interruption.h"
#include "player_page.h"
#include "view/http_server.h"
#include "view/run_site.h"

namespace brisance {

namespace {

void tell(const Options& options, const std::string& url) {
  if (options.json)
    fmt::print("{}\n", nlohmann::json{{"url", url}, {"run", options.path.string()}}.dump());
  else
    fmt::print("{}\n", url);
  std::fflush(stdout);
  if (!options.quiet && !options.json) fmt::print(stderr, "open this address in a browser; Ctrl-C ends the player\n");
}

}  // namespace

int viewCommand(const Options& options) {
  const PlayerRun run(options.path, playerSceneOf(sceneOfRun(options.path), options.path));
  run.state();  // a run that cannot be read is told of now
  RunSite site(run, playerPage());
  HttpServer server(options.port, [&](const HttpRequest& request) { return site.answer(request); });
  tell(options, fmt::format("http://127.0.0.1:{}/", server.port()));
  server.serve(interruptionRequested);
  return interruptionExitCode();
}

}  // namespace brisance
