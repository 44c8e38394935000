// MP of the task: the coordinator, with a record of what box and platforms do.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/link/clocked_inbox.hpp"
#include "base/linked_port.hpp"
#include "base/motion_capture_config.hpp"
#include "base/msg/convert_platform.hpp"
#include "mp/auto_start_operator.hpp"
#include "mp/coordinator_links.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/task_run.hpp"
#include "tasks/box_push/coordinator.hpp"
#include "tasks/box_push/figures.hpp"
#include "tasks/box_push/push_record.hpp"

namespace mrroc::box_push {

/// Settings of a run.
struct BoxRunParameters {
  CoordinatorParameters coordinator;  ///< of the agent
  MotionCaptureSetup capture;         ///< when the box is seen
  bool gives_start{true};             ///< false: a person or a script does
  bool records{true};                 ///< false: nothing is written down, as in a check
};

/// The coordinator in MP.
class BoxRun final : public mp::CoordinatorRun {
 public:
  /// @param run  is told of everything that begins; must outlive this object
  BoxRun(mp::TaskRun& run, BoxRunParameters parameters);

  Outcome execute() override;
  [[nodiscard]] const Fault& fault() const override { return fault_ ? fault_ : links_.fault(); }
  /// @return what the figures are made of; without rows when nothing was written down
  [[nodiscard]] PushResults results() const;

 private:
  using X = Coordinator::X;
  void observe(const Motion<Coordinator>& motion, const X& x);
  void announce(const Motion<Coordinator>& motion, const X& x);
  void show(const Motion<Coordinator>& motion, const X& x);
  void show_velocity(std::size_t k);
  /// @return which push goes on or comes, and of how many
  [[nodiscard]] static std::string push_words(const Motion<Coordinator>& motion, const X& x);
  void note_end(const X& x, Outcome& o);
  [[nodiscard]] double progress(const X& x);

  mp::TaskRun& run_;
  BoxRunParameters k_;
  mp::AutoStartOperator operator_;
  link::ClockedInbox<motion_capture_t> seen_;
  std::array<std::unique_ptr<link::OutgoingLink<FragmentOrder>>, kPlatforms> go_;
  mp::CoordinatorLinks links_;
  std::optional<PushRecord> record_;
  std::array<std::unique_ptr<link::Inbox<platform_reply_t>>, kPlatforms> replies_;  // none in a check
  Fault fault_;
  bool at_goal_{};
  double whole_{};          // largest that was left [m]
  bool lost_{};             // a platform waits for its position
  std::int64_t last_in_{};  // macrostep whose motion the last report was about
  int announced_{-1};       // behaviour
};

}  // namespace mrroc::box_push
