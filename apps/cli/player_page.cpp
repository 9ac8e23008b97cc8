#include "player_page.h"

#include "base/check.h"
#include "export_looks.h"

namespace brisance {

namespace fs = std::filesystem;

std::string playerPage() {
  const fs::path page = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share/brisance/player.html";
  if (!fs::exists(page))
    throw Error(ExitCode::failed, fmt::format("{}: the player was not built, for want of Node.js and npm; install them "
                                              "(./dev setup) and build again (./dev build)",
                                              page.string()));
  return readFile(page);
}

Scene sceneOfRun(const fs::path& run) {
  const fs::path file = run / "scene.toml";
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: holds no scene.toml; simulate this run again", run.string()));
  return readScene(file);
}

PlayerScene playerSceneOf(const Scene& scene, const fs::path& run) {
  const fs::path whole = fs::weakly_canonical(run);
  const std::string title = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  return {title,        BRISANCE_VERSION,     scene.film.fps, scene.film.timeScale, scene.simulation.frames,
          scene.render, looksOf(scene.render)};
}

}  // namespace brisance
