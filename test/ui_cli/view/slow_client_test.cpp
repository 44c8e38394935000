// Clients that are slow on purpose: others are answered all the same, and the slow ones lose their connections.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include "ui_cli/view/connections.hpp"
#include "ui_cli/view/server.hpp"

namespace mrroc::view {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// A client that says what it is told, when it is told.
class RawClient {
 public:
  explicit RawClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int little = 4096;  // so that an answer does not find room in it
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &little, sizeof little);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
      throw std::runtime_error("no connection");
  }
  RawClient(RawClient&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  RawClient& operator=(RawClient&&) = delete;
  ~RawClient() {
    if (socket_ >= 0) ::close(socket_);
  }
  /// @return whether the server still listens
  bool say(const std::string& text) const {
    return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
  }
  void take_a_little() const {
    std::array<char, 2048> bytes{};
    (void)::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
  }
  /// @return whether the server has closed the connection within the time
  [[nodiscard]] bool is_closed_within(milliseconds time) const {
    const auto deadline = Clock::now() + time;
    char byte{};
    while (Clock::now() < deadline) {
      const ssize_t got = ::recv(socket_, &byte, 1, MSG_DONTWAIT);
      if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) return true;
      if (got < 0) std::this_thread::sleep_for(milliseconds(5));
    }
    return false;
  }

 private:
  int socket_;
};

class SlowClients : public ::testing::Test {
 protected:
  /// @return how long an ordinary client waits for the page
  milliseconds time_of_an_answer() const {
    const auto begin = Clock::now();
    httplib::Client client("127.0.0.1", server_.port());
    const auto answer = client.Get("/app/main.js");
    EXPECT_TRUE(answer);
    if (answer) {
      EXPECT_EQ(answer->status, 200);
    }
    return std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
  }
  std::vector<RawClient> clients(std::size_t count, const std::string& text) const {
    std::vector<RawClient> all;
    for (std::size_t k = 0; k < count; ++k) {
      all.emplace_back(server_.port());
      (void)all.back().say(text);
    }
    return all;
  }
  void expect_answers_within_a_second() const {
    for (int k = 0; k < 5; ++k) EXPECT_LT(time_of_an_answer(), milliseconds(1000));
  }

  Record record_;
  CameraWindow cameras_;
  Server server_{{record_, cameras_, [] { return std::filesystem::path(); }}, 0};
};

const std::string kBegin = "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n";
constexpr std::size_t kMany = 200;  // more than are served at a time

TEST_F(SlowClients, ThatNeverEndTheirRequestKeepNobodyWaiting) {
  for (const std::size_t count : {std::size_t{24}, Connections::kServed, kMany}) {
    const auto slow = clients(count, kBegin);
    expect_answers_within_a_second();
  }
}

TEST_F(SlowClients, ThatSayNothingKeepNobodyWaiting) {
  const auto slow = clients(kMany, "");
  expect_answers_within_a_second();
}

TEST_F(SlowClients, ThatSayALetterAtATimeKeepNobodyWaiting) {
  const auto slow = clients(kMany, kBegin + "X-Slow: ");
  std::atomic<bool> done{false};
  std::thread speaker([&] {
    while (!done) {
      for (const RawClient& client : slow) (void)client.say("a");
      std::this_thread::sleep_for(milliseconds(5));
    }
  });
  expect_answers_within_a_second();
  done = true;
  speaker.join();
}

TEST_F(SlowClients, ThatDoNotReadTheirAnswerKeepNobodyWaiting) {
  const auto slow = clients(kMany, "GET /vendor/three.js HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  expect_answers_within_a_second();
}

TEST_F(SlowClients, ThatTakeALittleOfTheirAnswerAtATimeKeepNobodyWaiting) {
  const auto slow = clients(kMany, "GET /vendor/three.js HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  std::atomic<bool> done{false};
  std::thread reader([&] {
    while (!done) {
      for (const RawClient& client : slow) client.take_a_little();
      std::this_thread::sleep_for(milliseconds(1));
    }
  });
  expect_answers_within_a_second();
  done = true;
  reader.join();
}

TEST_F(SlowClients, BeyondThoseThatMayWaitAreClosedAtOnce) {
  Connections connections;
  std::atomic<int> begun{0};
  std::promise<void> gate;
  const std::shared_future<void> open = gate.get_future().share();
  constexpr std::size_t kAll = Connections::kServed + Connections::kWaiting;
  const auto enqueue = [&] {
    connections.enqueue([&begun, open] {
      ++begun;
      if (!Connections::refuses()) open.wait();
    });
  };
  for (std::size_t k = 0; k < Connections::kServed; ++k) enqueue();
  while (begun < static_cast<int>(Connections::kServed)) std::this_thread::sleep_for(milliseconds(1));
  for (std::size_t k = Connections::kServed; k < kAll; ++k) enqueue();
  EXPECT_EQ(connections.waiting(), Connections::kWaiting);
  for (int k = 0; k < 1000; ++k) enqueue();
  EXPECT_EQ(connections.waiting(), Connections::kWaiting) << "the others hold nothing any more";
  EXPECT_EQ(begun, static_cast<int>(Connections::kServed) + 1000)
      << "each has been called, to close its socket";
  gate.set_value();
  while (begun < static_cast<int>(kAll) + 1000) std::this_thread::sleep_for(milliseconds(1));
  connections.shutdown();
}

TEST_F(SlowClients, LoseTheirConnectionWhenTheirTimeIsOver) {
  const RawClient silent(server_.port());
  const RawClient slow(server_.port());
  const RawClient deaf(server_.port());
  (void)deaf.say("GET /api/stream HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  const auto deadline = Clock::now() + TimedServer::kTimeout + milliseconds(3000);
  bool heard = true;
  while (heard && Clock::now() < deadline) {
    heard = slow.say("G");
    std::this_thread::sleep_for(milliseconds(50));
  }
  EXPECT_FALSE(heard) << "a letter at a time";
  EXPECT_TRUE(silent.is_closed_within(milliseconds(3000)));
  EXPECT_EQ(server_.pages(), 1) << "a page without news is not slow";
}

TEST_F(SlowClients, LoseTheirStreamWhenTheyDoNotReadIt) {
  const std::vector<float> row(24);
  for (int k = 0; k < 200'000; ++k) record_.add("arm1", row);  // megabytes of news
  const auto deaf = clients(3, "GET /api/stream HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  const auto deadline = Clock::now() + milliseconds(3000);
  while (server_.pages() < 3 && Clock::now() < deadline) std::this_thread::sleep_for(milliseconds(5));
  EXPECT_EQ(server_.pages(), 3);
  const auto end = Clock::now() + TimedServer::kTimeout + milliseconds(5000);
  while (server_.pages() > 0 && Clock::now() < end) std::this_thread::sleep_for(milliseconds(20));
  EXPECT_EQ(server_.pages(), 0);
}

TEST_F(SlowClients, RequestsHaveALargestSize) {
  const RawClient greedy(server_.port());
  (void)greedy.say(kBegin);
  bool heard = true;
  for (std::size_t sent = 0; heard && sent < 4 * TimedServer::kLongestRequest; sent += 1003)
    heard = greedy.say("X: " + std::string(998, 'x') + "\r\n");
  EXPECT_TRUE(greedy.is_closed_within(milliseconds(2000)));
  expect_answers_within_a_second();
}

TEST_F(SlowClients, DoNotDelayTheEnd) {
  Record record;
  auto server = std::make_unique<Server>(Shown{record, cameras_, [] { return std::filesystem::path(); }}, 0);
  std::vector<RawClient> slow;
  for (int k = 0; k < 100; ++k) slow.emplace_back(server->port());
  const auto begin = Clock::now();
  server.reset();
  EXPECT_LT(Clock::now() - begin, milliseconds(2000));
}

}  // namespace
}  // namespace mrroc::view
