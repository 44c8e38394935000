// The operator h of the drawing task in simulation: guides the simulated hands through the behaviours, and
// gives start and triggers unless a person does.
#pragma once
#include <memory>

#include "base/link/process.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/operator_command_server.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "mrroc/operator_image_t.hpp"
#include "tasks/drawing/drawing.hpp"

namespace mrroc::drawing {

/// Plan for the operator.
struct HandPlan {
  Point start{0, 0};        ///< where both pens begin the reproduction [mm]
  double height{0.010};     ///< of the pens above the paper there [m]
  int steady{25};           ///< macrosteps that the hands hold still before the trigger
  bool gives_orders{true};  ///< start and triggers; false: a person or a script gives them
};

/// Speaks with the simulated hands on the channels hand.order and hand.report.
class HandOperator final : public mp::OperatorAgent {
 public:
  /// Make this before the process assembles. @param command_server  must outlive this object
  HandOperator(link::Process& process, mp::OperatorCommandServer& command_server, const HandPlan& plan);

  void inform(std::int64_t i, int m) override;
  [[nodiscard]] bool has_hands() const override { return true; }
  [[nodiscard]] bool here(std::int64_t i) const override;
  [[nodiscard]] const link::InboxBase* inbox() const override { return report_in_.get(); }
  OperatorImage image(std::int64_t i) override;

  /// @return share of the present hand motion that is done, 0..1
  [[nodiscard]] double progress() const { return progress_; }
  /// @return whether the hands have done what the present behaviour's trigger ends
  [[nodiscard]] bool done() const { return done_; }
  /// @return whether the hand has led the pen along the whole drawing, and nobody has felt the paper
  [[nodiscard]] bool in_vain() const { return m_ == 1 && steady_ > plan_.steady; }
  /// @return whether somebody else gives the orders: a person, or a script
  [[nodiscard]] bool waits_for_orders() const { return !plan_.gives_orders; }

 private:
  void decide(const hand_report_t& report);

  link::Process& process_;
  mp::OperatorCommandServer& command_server_;
  HandPlan plan_;
  std::unique_ptr<link::Outbox<hand_order_t>> order_out_;
  std::unique_ptr<link::Outbox<operator_image_t>> image_out_;  // for the log
  std::unique_ptr<link::Inbox<hand_report_t>> report_in_;
  int m_{};           // behaviour of the last order
  int steady_{};      // macrosteps since the hands are done in this behaviour; m = 1 should have ended before
  bool triggered_{};  // in this behaviour
  double progress_{};
  bool done_{};  // what the present behaviour's trigger is for
};

}  // namespace mrroc::drawing
