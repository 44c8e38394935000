// The hands of the simulated operators, and their sheets: what the coordinator orders, and what they report.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/hand.hpp"
#include "base/link/process.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "sim/shell/shell.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Channels hand.order and hand.report.
class Hands {
 public:
  /// @param process, world, parameters  outlive this object
  Hands(link::Process& process, World& world, const ShellParameters& parameters);

  /// Tells in macrostep i what the hands have done.
  void report(std::int64_t i);
  /// @return where orders come from
  [[nodiscard]] const link::Sources& sources() const { return sources_; }
  /// @return whether the order of macrostep i has come
  [[nodiscard]] bool ordered(std::int64_t i) const { return order_in_->at(i); }
  /// Carries out the order of macrostep i, which has come. @param paused  the task is
  void obey(std::int64_t i, bool paused) { obey(*order_in_->at(i), paused); }
  /// Carries out all orders that have come since the last one: a clean sheet is ordered once.
  void obey_what_has_come(bool paused);
  /// At a stop a person lets go.
  void release();
  /// Writes every sheet into the folder.
  void write_sheets();

 private:
  void obey(const hand_order_t& order, bool paused);
  void write_sheet(int arm);
  [[nodiscard]] int led_arms() const;

  World& world_;
  const ShellParameters& k_;
  std::unique_ptr<link::Outbox<hand_report_t>> report_out_;
  std::unique_ptr<link::Inbox<hand_order_t>> order_in_;
  link::Sources sources_{order_in_.get()};
  std::vector<int> sheets_;
  std::array<HandAction, 4> actions_{};
  std::int64_t obeyed_{};  // stamp of the last order
};

}  // namespace mrroc::sim
