// A transport for tests of one thread that delivers at once, and a listener that keeps what it hears.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/link/bus.hpp"

namespace mrroc::link::test {

using Bytes = std::vector<std::uint8_t>;

/// Delivers within publish() to every sink, and keeps what was published.
class DirectBus final : public Bus {
 public:
  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    published.emplace_back(route.channel, Bytes(bytes.begin(), bytes.end()));
    deliver(route.channel, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override { sinks_[route.channel].push_back(&sink); }
  void subscribe_all(const std::string& prefix, Sink& sink) override { all_.emplace_back(prefix, &sink); }
  bool wait(std::chrono::milliseconds) override { return false; }

  /// Gives a channel's sinks any bytes, as a stranger on the network can.
  void deliver(const std::string& channel, std::span<const std::uint8_t> bytes) {
    for (Sink* s : sinks_[channel]) s->receive(channel, bytes);
    for (const auto& [prefix, sink] : all_)
      if (channel.starts_with(prefix)) sink->receive(channel, bytes);
  }

  std::vector<std::pair<std::string, Bytes>> published;

 private:
  std::map<std::string, std::vector<Sink*>> sinks_;
  std::vector<std::pair<std::string, Sink*>> all_;
};

/// Keeps what has come, with its channel.
struct Collector final : Sink {
  std::vector<std::pair<std::string, Bytes>> got;
  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override {
    got.emplace_back(channel, Bytes(bytes.begin(), bytes.end()));
  }
};

}  // namespace mrroc::link::test
