// Finds the cheapest plan for two arms to turn faces of a cube, or to show all of them to a camera.
#pragma once
#include <memory>
#include <span>

#include "tasks/rubik/plan/blocked_directions.hpp"
#include "tasks/rubik/plan/cell.hpp"
#include "tasks/rubik/plan/plan.hpp"

namespace mrroc::rubik {

/// Initial state of a plan: one arm holds, the other hand is empty.
struct PlanStart {
  Grasp grasp;       ///< of the arm that holds
  ArmJoints joints;  ///< where both arms are
};

/// Settings of the search.
struct PlanOptions {
  CycleTimes times;           ///< estimates of what is not free motion
  double grip_penalty{2};     ///< what a grip costs besides its time [s]: each one can fail
  BlockedDirections blocked;  ///< where a face jams, it is turned by three quarters the other way
};

/// Plans in one cell. Paths that have been found are kept, so that later plans cost less.
class Planner {
 public:
  /// @param cell  outlives the planner
  explicit Planner(const PlanCell& cell);
  ~Planner();
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  /// @param moves  to be turned, in this order. But opposite faces that follow each other may be exchanged, and turns of
  ///        one face with nothing or only such between them are taken together
  [[nodiscard]] Planned make_plan(const PlanStart& start, std::span<const Move> moves,
                                  const PlanOptions& options = {});
  /// @return a plan in which each face is shown to the camera once
  [[nodiscard]] Planned make_reading_plan(const PlanStart& start, const PlanOptions& options = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::rubik
