// A bus that hands out one message at a time, as that of real processes may.
#pragma once
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/link/bus.hpp"

namespace mrroc::link::test {

/// Passes on what another bus carries.
class OneByOneBus final : public Bus {
 public:
  explicit OneByOneBus(std::unique_ptr<Bus> whole) : whole_(std::move(whole)) {}

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    whole_->publish(route, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override {
    auto& sinks = sinks_[route.channel];
    if (sinks.empty()) whole_->subscribe(route, collector_);
    sinks.push_back(&sink);
  }
  void subscribe_all(const std::string&, Sink&) override {}
  bool wait(std::chrono::milliseconds timeout) override {
    if (collector_.waiting.empty() && !whole_->wait(timeout)) return false;
    if (collector_.waiting.empty()) return false;
    const auto [channel, bytes] = collector_.waiting.front();
    collector_.waiting.pop_front();
    for (Sink* const sink : sinks_[channel]) sink->receive(channel, bytes);
    return true;
  }

 private:
  struct Collector final : Sink {
    void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override {
      waiting.emplace_back(channel, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    }
    std::deque<std::pair<std::string, std::vector<std::uint8_t>>> waiting;
  };
  std::unique_ptr<Bus> whole_;
  Collector collector_;
  std::map<std::string, std::vector<Sink*>> sinks_;
};

}  // namespace mrroc::link::test
