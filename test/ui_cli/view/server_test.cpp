#include "ui_cli/view/server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/fault.hpp"
#include "test/ui_cli/view/sample_run.hpp"
#include "ui_cli/view/httplib.hpp"
#include "ui_cli/view/run_source.hpp"
#include "ui_cli/view/static_files.hpp"

namespace mrroc::view {
namespace {

using nlohmann::json;

/// A server that shows a run folder.
class ViewServer : public ::testing::Test {
 protected:
  ViewServer() {
    test::write_run(folder_.path(), 40);
    load_run(folder_.path(), record_);
    server_ = std::make_unique<Server>(Shown{record_, cameras_, [this] { return folder_.path(); }}, 0);
  }
  httplib::Client client() const { return httplib::Client("127.0.0.1", server_->port()); }
  httplib::Result get(const std::string& path, const httplib::Headers& headers = {}) const {
    return client().Get(path, headers);
  }
  /// @return first event of the stream
  std::string first_event() const {
    std::string text;
    client().Get("/api/stream", [&](const char* data, std::size_t size) {
      text.append(data, size);
      return text.find("\n\n") == std::string::npos;
    });
    return text.substr(0, text.find("\n\n"));
  }

  test::ScratchFolder folder_{"mrroc-view-server"};
  Record record_;
  CameraWindow cameras_;
  std::unique_ptr<Server> server_;
};

TEST_F(ViewServer, ServesThePageAndLetsItLoadNothingFromOutside) {
  for (const char* path : {"/", "/index.html"}) {
    const auto page = get(path);
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200);
    EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
    EXPECT_TRUE(page->get_header_value("Content-Security-Policy").starts_with("default-src 'self'"));
    EXPECT_EQ(page->get_header_value("Access-Control-Allow-Origin"), "");
  }
  EXPECT_EQ(get("/app/main.js")->get_header_value("Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_GT(get("/vendor/three.js")->body.size(), 100'000U);
  EXPECT_NE(get("/api/robot/irb6_track.urdf")->body.find("<robot name=\"irb6_track\">"), std::string::npos);
  for (const StaticFile& file : static_files())
    if (!file.path.starts_with("/vendor/") && !file.path.ends_with(".svg") && !file.path.ends_with(".urdf")) {
      EXPECT_EQ(file.content.find("https://"), std::string_view::npos) << file.path;
      EXPECT_EQ(file.content.find("http://"), std::string_view::npos) << file.path;
    }
}

TEST_F(ViewServer, SaysWhatIsNotThere) {
  for (const char* path :
       {"/nothing", "/app/", "/app/mainxjs", "/api/robot/irb6.urdf", "/api/camera/sac.bmp"}) {
    const auto answer = get(path);
    ASSERT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, 404) << path;
    EXPECT_NE(json::parse(answer->body).at("error"), "") << path;
  }
}

TEST_F(ViewServer, GivesNoFileButThePicturesOfTheRun) {
  EXPECT_EQ(get("/api/picture/sac_board.png")->body, "camera");
  EXPECT_EQ(get("/api/picture/plots/force.png")->body, "plot");
  for (const char* path :
       {"/api/picture/config.toml", "/api/picture/../config.toml", "/api/picture/plots/../config.toml",
        "/api/picture/plots/../../../../../../../../etc/passwd", "/api/picture/%2e%2e/config.toml",
        "/api/picture//etc/passwd", "/../../../../../../etc/passwd", "/app/../../etc/passwd",
        "/%2e%2e/%2e%2e/etc/passwd"})
    EXPECT_EQ(get(path)->status, 404) << path;
}

TEST_F(ViewServer, RefusesOtherNamesAndWhateverWouldChangeSomething) {
  EXPECT_EQ(get("/", {{"Host", "example.org"}})->status, 403);
  EXPECT_EQ(get("/api/scene", {{"Host", "127.0.0.1.example.org:80"}})->status, 403);
  EXPECT_EQ(get("/", {{"Host", "localhost:1"}})->status, 200);
  EXPECT_EQ(client().Post("/", "x", "text/plain")->status, 405);
  EXPECT_EQ(client().Delete("/api/scene")->status, 405);
}

TEST_F(ViewServer, ListensOnThisHostOnly) {
  httplib::Client other("127.0.0.2", server_->port());
  other.set_connection_timeout(2);
  EXPECT_FALSE(other.Get("/"));
}

TEST_F(ViewServer, RefusesAPortThatIsTaken) {
  try {
    Server second(Shown{record_, cameras_, [] { return std::filesystem::path(); }}, server_->port());
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    EXPECT_NE(e.error_line().find("--port"), std::string::npos) << e.error_line();
  }
}

TEST_F(ViewServer, StreamsTheWholeRun) {
  const std::string event = first_event();
  ASSERT_TRUE(event.starts_with("data: {"));
  EXPECT_EQ(event.find('\n'), std::string::npos);
  const std::string news = event.substr(6);
  EXPECT_EQ(json::parse(news).at("scene").at("task"), "sample");
  EXPECT_EQ(test::rows_of(news, "arm2").size() / json::parse(news).at("scene").at("columns").size(), 40U);
  EXPECT_EQ(json::parse(get("/api/scene")->body).at("task"), "sample");
}

TEST_F(ViewServer, BearsOnlySoManyPages) {
  std::vector<std::thread> pages;
  std::atomic<bool> leave{false};
  for (int k = 0; k < Server::kMostPages; ++k)
    pages.emplace_back(
        [&] { client().Get("/api/stream", [&](const char*, std::size_t) { return !leave; }); });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (server_->pages() < Server::kMostPages && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(get("/api/stream")->status, 503);
  EXPECT_EQ(get("/")->status, 200) << "files are still served";
  leave = true;
  record_.log("{}");
  for (std::thread& page : pages) page.join();
}

TEST_F(ViewServer, ShowsTheNewestPictureOfACamera) {
  link::FrameWriter writer({.session = "s", .session_id = 7, .camera = "sac", .directory = folder_.path()},
                           {.width = 3, .height = 2, .channels = 3, .slots = 2});
  cameras_.begin("s", 7, {"sac"}, 0, folder_.path());
  EXPECT_FALSE(cameras_.complete());
  cameras_.look();
  EXPECT_TRUE(cameras_.complete());
  Image image(3, 2, 3);
  image.row(0)[0] = 200;  // blue of the upper left
  camera_frame_t m{};
  m.header.stamp = 4;
  m.slot = writer.write(4, 80, 0.16, image.view());
  cameras_.announce("sac", m);
  const auto answer = get("/api/camera/sac.bmp");
  ASSERT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "image/bmp");
  ASSERT_EQ(answer->body.size(), 54U + 2 * 12);
  EXPECT_EQ(answer->body.substr(0, 2), "BM");
  EXPECT_EQ(static_cast<std::uint8_t>(answer->body[54 + 12]), 200) << "the upper row comes last";
}

}  // namespace
}  // namespace mrroc::view
