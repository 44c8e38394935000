// A bus for a process in the test's own thread.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "base/link/bus.hpp"

namespace mrroc::link::test {

/// A bus on which others answer whenever somebody waits for them.
class AnsweredBus final : public Bus {
 public:
  /// @param answer  called before each wait
  AnsweredBus(std::unique_ptr<Bus> whole, std::function<void()> answer)
      : whole_(std::move(whole)), answer_(std::move(answer)) {}
  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    whole_->publish(route, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override { whole_->subscribe(route, sink); }
  void subscribe_all(const std::string& prefix, Sink& sink) override { whole_->subscribe_all(prefix, sink); }
  bool wait(std::chrono::milliseconds timeout) override {
    answer_();
    return whole_->wait(timeout);
  }

 private:
  std::unique_ptr<Bus> whole_;
  std::function<void()> answer_;
};

}  // namespace mrroc::link::test
