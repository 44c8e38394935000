// Feeds the record that a page shows from the running session.
#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "base/link/bus.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/attach.hpp"
#include "ui_cli/view/camera_window.hpp"
#include "ui_cli/view/record.hpp"

namespace mrroc::view {

/// Sessions and transport of the source; tests give it something else.
struct SessionEnvironment {
  ui::SessionSelector selector;    ///< as on the command line
  std::filesystem::path sessions;  ///< directory of the running sessions
  /// Makes the end of the transport that listens.
  std::function<std::unique_ptr<link::Bus>(const link::SessionInfo&)> open{link::open_session};
};

/// Waits for a session, follows it to its end, waits for the next, also for a replay of one that has been: a viewer can
/// be left open. Works in a thread of its own from construction to destruction. Beyond the listener's values the record
/// has "state": {"name": "waiting", "live" or "ended", "text": why}.
class SessionSource {
 public:
  /// @param record @param cameras  outlive this
  SessionSource(SessionEnvironment environment, Record& record, CameraWindow& cameras);
  ~SessionSource();
  SessionSource(const SessionSource&) = delete;
  SessionSource& operator=(const SessionSource&) = delete;

  /// @return whether a session is followed at present
  [[nodiscard]] bool following() const { return following_; }
  /// @return run folder of the session that is shown; empty: none, or on another host
  [[nodiscard]] std::filesystem::path folder() const;

 private:
  void work();
  std::optional<link::SessionInfo> find();
  void follow(const link::SessionInfo& session);
  /// Waits for a message of the session. @return false when the source is to end before
  bool talks(link::Bus& bus, const link::SessionInfo& session);
  void pump(link::Bus& bus, const link::SessionInfo& session, class Listener& listener);
  void set_state(const char* name, const std::string& text);
  /// @return false when the source is to end
  bool pause(std::chrono::milliseconds time);

  SessionEnvironment environment_;
  Record& record_;
  CameraWindow& cameras_;
  std::atomic<bool> stop_{};
  std::atomic<bool> following_{};
  bool shown_{};  // a session that has ended stays on the page
  mutable std::mutex mutex_;
  std::filesystem::path folder_;
  std::thread thread_;
};

}  // namespace mrroc::view
