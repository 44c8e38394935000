// A transport that loses messages, to test how a system copes.
#pragma once
#include <functional>
#include <memory>
#include <random>
#include <utility>

#include "base/config.hpp"
#include "base/link/bus.hpp"

namespace mrroc::link {

/// Passes on what is not lost. What is lost is lost for every receiver.
class LossyBus final : public Bus {
 public:
  /// @param under  must outlive this one
  /// @param lost   asked once per publication
  LossyBus(Bus& under, std::function<bool()> lost) : under_(under), lost_(std::move(lost)) {}

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    if (!lost_()) under_.publish(route, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override { under_.subscribe(route, sink); }
  void subscribe_all(const std::string& prefix, Sink& sink) override { under_.subscribe_all(prefix, sink); }
  bool wait(std::chrono::milliseconds timeout) override { return under_.wait(timeout); }
  [[nodiscard]] Dropped dropped() const override { return under_.dropped(); }

 private:
  Bus& under_;
  std::function<bool()> lost_;
};

/// @param share  of the publications that are lost, 0..1
/// @param seed   of the draws
/// @return what the bus asks, see LossyBus
inline std::function<bool()> loses(double share, std::uint64_t seed) {
  return [share, random = std::mt19937_64(seed)]() mutable {
    return std::bernoulli_distribution(share)(random);
  };
}

/// @return `link.loss`: the share of its messages that every process loses, 0 by default @throws ConfigError
inline double read_loss(const Config& config) {
  // A run waits for everything that is lost until it is sent again: 0.4 made it a hundred times slower.
  return config.number("link.loss", 0, {0, 0.5}, "of the messages; at 0.4 a simulated second takes a minute");
}

}  // namespace mrroc::link
