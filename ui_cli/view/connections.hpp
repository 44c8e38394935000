// The viewer's connections. A client that is slow, by accident or on purpose, occupies one thread for a while
// and does not delay others.
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

#include "ui_cli/view/httplib.hpp"

namespace mrroc::view {

/// Threads that each serve one connection at a time. Further ones wait.
class Connections final : public httplib::TaskQueue {
 public:
  /// Connections that are served at a time.
  static constexpr std::size_t kServed = 64;
  /// Connections that may wait; further ones are closed as they come.
  static constexpr std::size_t kWaiting = 256;

  Connections();
  /// @param connection  when kWaiting wait already, it is called at once, and is to close its socket: see refuses()
  void enqueue(std::function<void()> connection) override;
  void shutdown() override;

  /// @return whether the connection that this thread has called is one too many
  [[nodiscard]] static bool refuses();
  /// @return how many connections wait; any thread
  [[nodiscard]] std::size_t waiting() const { return waiting_; }
  /// @return whether the server ends; any thread
  [[nodiscard]] bool ending() const { return ending_; }

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::list<std::function<void()>> queue_;
  std::atomic<std::size_t> waiting_{};
  std::atomic<bool> ending_{};
  std::vector<std::thread> threads_;
};

/// A web server that waits for no client longer than it can afford: a request has to be there as a whole, and each piece
/// of an answer to be taken, within kTimeout; within kTimeoutInACrowd while other connections wait. Requests have at
/// most kLongestRequest bytes.
class TimedServer final : public httplib::Server {
 public:
  /// For a request, an answer's piece, and between two requests.
  static constexpr std::chrono::milliseconds kTimeout{5000};
  static constexpr std::chrono::milliseconds kTimeoutInACrowd{100};
  static constexpr std::size_t kLongestRequest = 64 * 1024;  ///< [bytes]

  TimedServer();

  /// Lets as many connections wait for being accepted as may wait for being served. To be called once bound.
  void widen_door();

 private:
  bool process_and_close_socket(socket_t socket) override;

  std::atomic<Connections*> connections_{};  // of listen(), whose thread makes it
};

}  // namespace mrroc::view
