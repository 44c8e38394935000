// The operator of the task in simulation: his hand leads the tool, and he gives start and triggers unless a person does.
#pragma once
#include <memory>

#include "base/hand.hpp"
#include "base/link/process.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/operator_command_server.hpp"
#include "mp/status_board.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/hand_report_t.hpp"
#include "mrroc/operator_image_t.hpp"

namespace mrroc::mp {

/// What he does when he has led the tool along the fixture.
struct FarewellPlan {
  Eigen::Vector2d point{0, 0};  ///< above it he takes the tool away [mm] of the sheet
  double height{};              ///< so high above the sheet [m]
  int leave{};                  ///< macrosteps after the trigger until he does, in which the fixture lets go
  int steady{60};               ///< macrosteps for which he rests before a trigger
  bool gives_orders{true};      ///< start and triggers; false: a person or a script does
};

/// Speaks with the simulated hand of the first arm.
class LeadingOperator final : public OperatorAgent {
 public:
  /// Make this before the process assembles.
  /// @param command_server, board  must outlive this object; the board tells why a trigger would come early
  LeadingOperator(link::Process& process, OperatorCommandServer& command_server, StatusBoard& board,
                  const FarewellPlan& plan);

  void inform(std::int64_t i, int m) override;
  [[nodiscard]] bool has_hands() const override { return true; }
  [[nodiscard]] bool here(std::int64_t i) const override { return report(i) != nullptr; }
  [[nodiscard]] const link::InboxBase* inbox() const override { return report_in_.get(); }
  OperatorImage image(std::int64_t i) override;

 private:
  enum class Part : std::uint8_t { waits, leads, lets_go, takes_away, rests };

  [[nodiscard]] const hand_report_t* report(std::int64_t i) const;
  void begin(Part part);
  void decide(bool done);
  [[nodiscard]] HandAction action() const;
  // Whether the trigger that the present part ends with has been given, by him or by a person.
  bool triggered(bool done);

  link::Process& process_;
  OperatorCommandServer& command_server_;
  StatusBoard& board_;
  FarewellPlan plan_;
  std::unique_ptr<link::Outbox<hand_order_t>> order_out_;
  std::unique_ptr<link::Outbox<operator_image_t>> image_out_;  // for the log
  std::unique_ptr<link::Inbox<hand_report_t>> report_in_;
  Part part_{Part::waits};
  int age_{};                // macrosteps in the part
  int steady_{};             // macrosteps in which its motion has been done
  std::int64_t triggers_{};  // that have been taken
  std::int64_t before_{};    // those before the part
};

}  // namespace mrroc::mp
