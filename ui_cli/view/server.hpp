// The viewer's web server: on 127.0.0.1 only, read-only.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "ui_cli/view/camera_window.hpp"
#include "ui_cli/view/record.hpp"

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace mrroc::view {

class TimedServer;

/// Content that the server shows.
struct Shown {
  Record& record;  ///< that pages are told
  /// Source of the newest pictures.
  CameraWindow& cameras;
  /// @return run folder whose pictures may be asked for; empty: none. Called by any thread
  std::function<std::filesystem::path()> folder;
};

/// Serves GET and HEAD, refuses everything else (405), and a client that calls it by another name than 127.0.0.1 or localhost
/// (403), so that no page of another place can read it through a browser. What there is:
///   /                        the page and its files
///   /api/stream              server-sent events, each Record::news(), at most 25 a second; a comment every 10 s
///   /api/scene               Record::scene()
///   /api/robot/MODEL.urdf    description of a robot
///   /api/camera/NAME.bmp     newest picture of a running camera
///   /api/picture/PATH        picture of the run folder, of those that pictures_of() lists
/// Anything else is 404 with {"error": why}. A slow client keeps nobody waiting and loses its connection
/// (connections.hpp): a page that does not read its stream, too, and asks anew. Works in threads of its own from construction to destruction.
class Server {
 public:
  /// Port that is tried first when the user names none.
  static constexpr int kUsualPort = 8460;
  /// Pages that can be open at a time; one more gets 503.
  static constexpr int kMostPages = 8;

  /// @param shown  its references outlive this
  /// @param port  0: the usual one, or the next that is free
  /// @throws FaultError bad_usage when the port is taken
  Server(Shown shown, int port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// @return that it listens on
  [[nodiscard]] int port() const { return port_; }
  /// @return address for a browser
  [[nodiscard]] std::string url() const;
  /// @return pages that are open
  [[nodiscard]] int pages() const { return pages_; }

 private:
  void route();
  void stream(httplib::Response& response);
  void picture(const httplib::Request& request, httplib::Response& response) const;

  Shown shown_;
  std::unique_ptr<TimedServer> http_;
  int port_{};
  std::atomic<bool> stop_{};
  std::atomic<int> pages_{};
  std::thread thread_;
};

}  // namespace mrroc::view
