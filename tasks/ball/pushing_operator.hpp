// The operator of the task in simulation: gives start unless a person does, and may push an arm.
#pragma once
#include <memory>
#include <optional>

#include "base/hand.hpp"
#include "base/link/process.hpp"
#include "mp/auto_start_operator.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "tasks/ball/hand_push.hpp"

namespace mrroc::ball {

/// Speaks with the simulated hand of the arm that is pushed.
class PushingOperator final : public mp::OperatorAgent {
 public:
  /// Make this before the process assembles.
  /// @param force_P  of the push along the axes of the arm's sheet, in which a simulated hand counts [N]
  PushingOperator(link::Process& process, mp::OperatorCommandServer& command_server, bool gives_start,
                  const HandPush& push, const Vector3& force_P);

  void inform(std::int64_t i, int m) override;
  [[nodiscard]] bool has_hands() const override { return true; }
  [[nodiscard]] bool here(std::int64_t i) const override;
  [[nodiscard]] const link::InboxBase* inbox() const override { return report_in_.get(); }
  OperatorImage image(std::int64_t i) override { return starts_.image(i); }

 private:
  link::Process& process_;
  mp::AutoStartOperator starts_;
  HandPush push_;
  Vector3 force_P_;
  std::unique_ptr<link::Outbox<hand_order_t>> order_out_;
  std::unique_ptr<link::Inbox<hand_report_t>> report_in_;
  int around_{};  // macrosteps
};

}  // namespace mrroc::ball
