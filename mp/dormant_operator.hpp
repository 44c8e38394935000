// The operator of a task that needs no hand: gives start unless a person does.
#pragma once
#include <memory>

#include "base/link/process.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/operator_desk.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/operator_image_t.hpp"

namespace mrroc::mp {

/// Tells the world on the channel hand.order that nobody leads a pen, whether there is a pause, and the end.
class DormantOperator final : public OperatorAgent {
 public:
  /// @param gives_start  false: a person or a script does
  DormantOperator(link::Process& process, OperatorDesk& desk, bool gives_start);

  void inform(std::int64_t i, int m, bool finished) override;
  [[nodiscard]] bool here(std::int64_t) const override { return true; }
  OperatorImage image(std::int64_t i) override;

 private:
  OperatorDesk& desk_;
  bool gives_start_;
  std::unique_ptr<link::Outbox<hand_order_t>> order_out_;
  std::unique_ptr<link::Outbox<operator_image_t>> image_out_;  // for the log
  bool paused_{};
};

}  // namespace mrroc::mp
