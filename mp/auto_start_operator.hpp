// Scripted operator that only gives start, unless a person does.
#pragma once
#include <memory>

#include "base/link/process.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/operator_command_server.hpp"
#include "mrroc/operator_image_t.hpp"

namespace mrroc::mp {

/// Has no hands in the simulation.
class AutoStartOperator final : public OperatorAgent {
 public:
  /// @param gives_start  false: a person or a script does
  AutoStartOperator(link::Process& process, OperatorCommandServer& command_server, bool gives_start);

  void inform(std::int64_t, int) override {}
  [[nodiscard]] bool here(std::int64_t) const override { return true; }
  OperatorImage image(std::int64_t i) override;

 private:
  OperatorCommandServer& command_server_;
  bool gives_start_;
  std::unique_ptr<link::Outbox<operator_image_t>> image_out_;  // for the log
};

}  // namespace mrroc::mp
