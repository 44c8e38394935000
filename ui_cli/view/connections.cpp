#include "ui_cli/view/connections.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>

namespace mrroc::view {
namespace {

using Clock = std::chrono::steady_clock;

thread_local bool refuses_now = false;

/// One connection, read and written within time limits.
class TimedStream final : public httplib::Stream {
 public:
  TimedStream(int socket, const Connections& connections) : socket_(socket), connections_(connections) {}

  /// Waits for the first byte of a request. @return false when it does not come
  [[nodiscard]] bool begin_request() {
    begun_ = Clock::now();
    left_ = TimedServer::kLongestRequest;
    return wait_for(POLLIN);
  }

  [[nodiscard]] bool is_readable() const override { return wait_for(POLLIN); }
  [[nodiscard]] bool is_writable() const override {
    begun_ = Clock::now();
    char next{};
    return ::recv(socket_, &next, 1, MSG_PEEK | MSG_DONTWAIT) != 0 &&
           wait_for(POLLOUT);  // 0: the client has left
  }

  ssize_t read(char* data, std::size_t size) override {
    if (next_ == filled_ && !refill()) return -1;
    const std::size_t count = std::min(size, filled_ - next_);
    std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(next_), count, data);
    next_ += count;
    return static_cast<ssize_t>(count);
  }

  /// All of it, or nothing that counts.
  ssize_t write(const char* data, std::size_t size) override {
    begun_ = Clock::now();
    std::size_t sent = 0;
    while (sent < size) {
      // Also where a little is taken all the time, the time ends.
      if (too_late() || too_late_in_a_crowd(begun_) || !wait_for(POLLOUT)) return -1;
      const ssize_t count = ::send(socket_, data + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0 && errno != EAGAIN && errno != EINTR) return -1;
      sent += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
    return static_cast<ssize_t>(size);
  }

  void get_remote_ip_and_port(std::string& ip, int& port) const override { address(::getpeername, ip, port); }
  void get_local_ip_and_port(std::string& ip, int& port) const override { address(::getsockname, ip, port); }
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  [[nodiscard]] bool too_late() const { return Clock::now() - begun_ > TimedServer::kTimeout; }
  [[nodiscard]] bool too_late_in_a_crowd(Clock::time_point since) const {
    return connections_.waiting() > 0 && Clock::now() - since > TimedServer::kTimeoutInACrowd;
  }

  /// @return false when the time is over, or the connection
  [[nodiscard]] bool wait_for(short event) const {
    constexpr int kLook = 20;  // [ms] whether others wait
    if (event == POLLIN && next_ < filled_) return true;
    const Clock::time_point since = Clock::now();
    while (true) {
      pollfd p{socket_, event, 0};
      const int ready = ::poll(&p, 1, kLook);
      if (ready > 0) return (p.revents & event) != 0;
      if (ready < 0 && errno != EINTR) return false;
      if (connections_.ending() || too_late() || too_late_in_a_crowd(since)) return false;
    }
  }

  bool refill() {
    next_ = filled_ = 0;
    // Also where bytes come all the time, one by one, the time ends.
    if (too_late() || too_late_in_a_crowd(begun_) || left_ == 0 || !wait_for(POLLIN)) return false;
    const ssize_t count = ::recv(socket_, buffer_.data(), std::min(buffer_.size(), left_), MSG_DONTWAIT);
    if (count <= 0) return false;
    filled_ = static_cast<std::size_t>(count);
    left_ -= filled_;
    return true;
  }

  template <class Name>
  void address(Name name, std::string& ip, int& port) const {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    if (name(socket_, reinterpret_cast<sockaddr*>(&own), &size) != 0 || own.sin_family != AF_INET) return;
    std::array<char, INET_ADDRSTRLEN> text{};
    if (::inet_ntop(AF_INET, &own.sin_addr, text.data(), text.size())) ip = text.data();
    port = ntohs(own.sin_port);
  }

  int socket_;
  const Connections& connections_;
  mutable Clock::time_point begun_{Clock::now()};  // of the request, or of the piece that is written
  std::size_t left_{};                             // bytes that the request may still have
  std::array<char, 4096> buffer_{};
  std::size_t next_{}, filled_{};
};

}  // namespace

Connections::Connections() {
  for (std::size_t k = 0; k < kServed; ++k) threads_.emplace_back([this] { work(); });
}

void Connections::enqueue(std::function<void()> connection) {
  {
    const std::lock_guard lock(mutex_);
    if (queue_.size() < kWaiting) {
      queue_.push_back(std::move(connection));
      waiting_ = queue_.size();
      changed_.notify_one();
      return;
    }
  }
  // It alone knows its socket, so it is called to close that.
  refuses_now = true;
  connection();
  refuses_now = false;
}

bool Connections::refuses() { return refuses_now; }

void Connections::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Connections::work() {
  while (true) {
    std::function<void()> connection;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || !queue_.empty(); });
      if (queue_.empty()) return;
      connection = std::move(queue_.front());
      queue_.pop_front();
      waiting_ = queue_.size();
    }
    connection();
  }
}

TimedServer::TimedServer() {
  new_task_queue = [this] {
    auto* const connections = new Connections;  // listen() deletes it
    connections_ = connections;
    return connections;
  };
}

void TimedServer::widen_door() { ::listen(svr_sock_, static_cast<int>(Connections::kWaiting)); }

bool TimedServer::process_and_close_socket(socket_t socket) {
  const Connections& connections = *connections_;
  // Data that a client does not take wait here, and not as megabytes in the kernel.
  constexpr int kSendBuffer = 128 * 1024;
  ::setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  bool served = false;
  if (!Connections::refuses()) {
    TimedStream stream(socket, connections);
    for (std::size_t left = keep_alive_max_count_; left > 0 && svr_sock_ != INVALID_SOCKET; --left) {
      if (!stream.begin_request()) break;
      bool closed = false;
      served = process_request(stream, left == 1, closed, nullptr);
      if (!served || closed) break;
    }
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return served;
}

}  // namespace mrroc::view
