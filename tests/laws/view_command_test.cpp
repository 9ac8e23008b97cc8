// `brisance view`, as a browser and as its enemies use it; and the same player as one file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "faults/one_line.h"
#include "program.h"
#include "view/loopback_client.h"

namespace brisance::test {
namespace {

using nlohmann::json;

constexpr int frames = 4;

/// Beside the program that the tests start.
fs::path playerPage() { return fs::path(BRISANCE_BINARY).parent_path().parent_path() / "share/brisance/player.html"; }

/// One small run for all the tests, and a server of it.
class ViewCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new ScratchDirectory();
    writeText(*place_ / "small.toml", smallSceneText(frames));
    const Outcome made = runProgram({"simulate", *place_ / "small.toml", "-o", run(), "--quiet"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
  }
  static void TearDownTestSuite() { delete place_; }
  void SetUp() override {
    if (!fs::exists(playerPage())) GTEST_SKIP() << playerPage() << " was not built (packaging/build.txt: nodejs, npm)";
    StartOptions options;
    heard_ = heardPlace_ / "url";
    options.beforeStart = [this] {
      const int file = open(heard_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      dup2(file, STDOUT_FILENO);
    };
    server_ = std::make_unique<Program>(std::vector<std::string>{"view", run().string(), "--quiet"}, options);
    ASSERT_TRUE(waitUntil([&] { return textOf(heard_).ends_with("/\n"); }, 60)) << "it printed no address";
    const std::string url = textOf(heard_);
    ASSERT_TRUE(url.starts_with("http://127.0.0.1:")) << url;
    port_ = std::stoi(url.substr(url.rfind(':') + 1));
  }

  static fs::path run() { return *place_ / "run"; }
  std::string get(const std::string& path, const std::string& more = "") const {
    return answerTo(requestFor(path, port_, more), port_);
  }
  int status(const std::string& path, const std::string& more = "") const { return statusOf(get(path, more)); }

  static ScratchDirectory* place_;
  ScratchDirectory heardPlace_;
  fs::path heard_;
  std::unique_ptr<Program> server_;
  int port_ = 0;
};
ScratchDirectory* ViewCommand::place_ = nullptr;

TEST_F(ViewCommand, ServesThePageAndWhatItAsksFor) {
  EXPECT_NE(get("/").find("<title>Brisance</title>"), std::string::npos);
  const json state = json::parse(bodyOf(get("/data/state.json")));
  EXPECT_EQ(state["frames"], frames);
  EXPECT_EQ(state["planned"], frames);
  EXPECT_EQ(state["versions"].size(), frames);
  const json told = json::parse(bodyOf(get("/data/run.json")));
  EXPECT_EQ(told["bodies"].size(), 6u);
  EXPECT_EQ(told["heat"]["colours"].size(), 256u);
  EXPECT_TRUE(bodyOf(get("/data/pieces.glb")).starts_with("glTF"));
  for (int frame = 1; frame <= frames; ++frame) EXPECT_EQ(status("/data/moments/" + std::to_string(frame)), 200);
  for (const char* name : {"moments/0", "moments/5", "moments/x", "moments/1x", "moments/", "shapes/1.glb", "nothing"})
    EXPECT_EQ(status(std::string("/data/") + name), 404) << name;
}

TEST_F(ViewCommand, ServesFilesOfTheRun) {
  EXPECT_EQ(bodyOf(get("/run/scene.toml")), textOf(run() / "scene.toml"));
  EXPECT_EQ(bodyOf(get("/run/gas/gas.0002.vdb")), textOf(run() / "gas/gas.0002.vdb"));
}

TEST_F(ViewCommand, RefusesWhatLiesOutsideTheRun) {
  writeText(*place_ / "secret.txt", "secret");
  fs::create_symlink(*place_ / "secret.txt", run() / "link.txt");
  fs::rename(run() / "reports/report.0003.json", *place_ / "report.json");
  fs::create_symlink(*place_ / "secret.txt", run() / "reports/report.0003.json");  // a name that the manifest knows
  for (const std::string path :
       {"/run/../secret.txt", "/run/%2e%2e/secret.txt", "/run/%2E%2E%2Fsecret.txt", "/run/gas/../../secret.txt",
        "/run/..%5csecret.txt", "/run//etc/passwd", "/run/%2Fetc%2Fpasswd", "/run/link.txt",
        "/run/reports/report.0003.json", "/run/", "/run/gas", "/run/.lock", "/run/./scene.toml", "/run/manifest.json",
        "/../../etc/passwd", "/etc/passwd", "//etc/passwd", "/data/../run/scene.toml", "/run/scene.toml%20"}) {
    const std::string answer = get(path);
    EXPECT_EQ(statusOf(answer), 404) << path;
    EXPECT_EQ(answer.find("secret\n"), std::string::npos) << path;
    EXPECT_EQ(answer.find("root:"), std::string::npos) << path;
  }
  fs::remove(run() / "link.txt");
  fs::remove(run() / "reports/report.0003.json");
  fs::rename(*place_ / "report.json", run() / "reports/report.0003.json");
}

TEST_F(ViewCommand, RefusesPagesOfOtherHostsAndOrigins) {
  EXPECT_EQ(status("/data/run.json", "Origin: http://127.0.0.1:" + std::to_string(port_) + "\r\n"), 200);
  EXPECT_EQ(status("/data/run.json", "Origin: http://evil.example\r\n"), 403);
  EXPECT_EQ(status("/data/run.json", "Origin: null\r\n"), 403);
  EXPECT_EQ(statusOf(answerTo("GET /data/run.json HTTP/1.1\r\nHost: evil.example\r\n\r\n", port_)), 403);
  EXPECT_EQ(statusOf(answerTo("GET /data/run.json HTTP/1.0\r\n\r\n", port_)), 403);
}

TEST_F(ViewCommand, ListensOnLoopbackAlone) {
  const std::string table = textOf("/proc/net/tcp");
  char wanted[16];
  std::snprintf(wanted, sizeof wanted, "0100007F:%04X", port_);
  EXPECT_NE(table.find(wanted), std::string::npos);
  std::snprintf(wanted, sizeof wanted, "00000000:%04X", port_);
  EXPECT_EQ(table.find(wanted), std::string::npos);
}

TEST_F(ViewCommand, AnswersAmongAThousandConnectionsAndSlowOnes) {
  std::vector<LoopbackClient> others;
  for (int n = 0; n < 1000; ++n) {
    others.emplace_back(port_);
    if (n % 3 == 1) others.back().say("GET /data/mom");
    if (n % 3 == 2) others.back().say(requestFor("/data/moments/2", port_));
  }
  EXPECT_EQ(status("/data/state.json"), 200);
  EXPECT_EQ(status("/data/moments/3"), 200);
}

TEST_F(ViewCommand, EndsSoonAfterCtrlC) {
  const LoopbackClient waiting(port_);
  server_->send(SIGINT);
  EXPECT_TRUE(waitUntil([&] { return !server_->isAlive(); }, 10));
  EXPECT_EQ(server_->wait().exitCode, 130);
}

TEST_F(ViewCommand, APortThatIsTakenIsOneLine) {
  expectOneLine(runProgram({"view", run(), "--port", std::to_string(port_)}), 1, {std::to_string(port_), "--port 0"});
}

TEST(ViewCommandRefusals, AreOneLine) {
  const ScratchDirectory empty;
  expectOneLine(runProgram({"view", empty.path()}), 2, {"scene.toml"});
  expectOneLine(runProgram({"view", empty.path(), "--port", "70000"}), 2, {"--port"});
}

TEST_F(ViewCommand, ThePlayerInOneFileHoldsTheFramesAndAsksNoServer) {
  const ScratchDirectory place;
  const fs::path file = place / "player.html";
  const Outcome outcome = runProgram({"export", run(), "--to", "html", "-o", file, "--frames", "2-3", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const json told = json::parse(outcome.out);
  EXPECT_EQ(told["bytes"], fs::file_size(file));
  EXPECT_EQ(told["frames"], json({{"first", 2}, {"last", 3}, {"count", 2}}));
  const std::string page = textOf(file);
  for (const char* name : {"run.json", "state.json", "pieces.glb", "moments/2", "moments/3"})
    EXPECT_NE(page.find("data-name=\"" + std::string(name) + "\""), std::string::npos) << name;
  EXPECT_EQ(page.find("data-name=\"moments/1\""), std::string::npos);
  EXPECT_EQ(temporariesIn(place.path()), std::vector<std::string>());
  expectOneLine(runProgram({"export", run(), "--to", "html", "-o", file}), 2, {"--overwrite"});
  expectOneLine(runProgram({"export", run(), "--to", "html", "-o", place / "player.txt"}), 2, {".html"});
}

}  // namespace
}  // namespace brisance::test
