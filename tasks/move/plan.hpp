// What the arms will do, computed from the file alone before anything moves.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tasks/move/body.hpp"
#include "tasks/move/curves.hpp"

namespace mrroc::any_motion {

/// Pacing of all motions: the original's macrostep.
inline constexpr ecp::Pacing kPacing{};

/// One motion, ready to be executed.
struct PlannedMotion {
  MotionSpec spec;                       ///< as it is written
  ecp::Trajectory path;                  ///< its set points
  std::optional<ecp::Replay> replay;     ///< of recorded forces
  TaskFrameCommand rows;                 ///< axes in contact, for a replay
  Rates rates;                           ///< of the set points
  std::vector<ecp::Coordinates> joints;  ///< at the set points 0 to macrosteps()
  std::vector<Pose> poses;               ///< T_0E at the same

  /// @param k  macrosteps executed before @return SET ARM of the next one, in the representation of the file
  [[nodiscard]] ArmCommand command(std::int64_t k) const;
};

/// Motions of one arm.
struct ArmPlan {
  std::string arm;                     ///< key
  bool moves{};                        ///< false: it rests all the time
  ecp::Coordinates start;              ///< joints to which it goes first [rad, track m]
  std::vector<PlannedMotion> motions;  ///< one after another
};

/// Motions of all arms.
struct Plan {
  bool together{};            ///< the arms begin each motion at the same time
  std::vector<ArmPlan> arms;  ///< in the order of the cell
};

/// @param bodies  of the arms of the file, in their order; not null
/// @throws FaultError bad_trajectory, unreachable_pose, too_fast: what is wrong with which motion, where the table of the
///         arm's ranges is not needed to tell it
[[nodiscard]] Plan make_plan(const MotionFile& file, std::span<const Body* const> bodies);

/// @param plan  not null @return what the plan is, a line per motion: times, and shares of the limits
[[nodiscard]] std::string describe_plan(const Plan& plan);

/// @return name of a generator, as it is written
[[nodiscard]] std::string_view to_string(Generator g);

}  // namespace mrroc::any_motion
