// Paths of one arm around the other: straight lines in the space of the motors, directly or through points
// beside them.
#pragma once
#include <optional>
#include <random>
#include <vector>

#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

/// @param joints  of the points
/// @return the points; on each line the speed is what motors and E may have
[[nodiscard]] std::vector<Waypoint> path_through(const PlanCell& cell, Hand hand,
                                                 const std::vector<AxisVector>& joints);

/// @param points  at least one
/// @return time of the motion, as the arm will drive it: in whole macrosteps [s]
[[nodiscard]] double seconds_along(const std::vector<Waypoint>& points, const ecp::MotionLimits& motors);
/// The same through path_through().
[[nodiscard]] double seconds_along(const PlanCell& cell, Hand hand, const std::vector<AxisVector>& joints);

/// Checks and finds paths.
class Paths {
 public:
  /// @param cell  outlives this object
  explicit Paths(const PlanCell& cell) : cell_(cell) {}

  /// @param state  of everything; the joints of the hand's arm do not count
  /// @return whether every state on the line is within the limits and free
  [[nodiscard]] bool is_free(Hand hand, const AxisVector& from, const AxisVector& to, CellState state) const;

  /// @param first, second  motions of both arms @param delay  of the second one [s]
  /// @param state  of everything; the joints do not count
  /// @return whether every state of both at these times is free, even if one of them is kLag ahead
  [[nodiscard]] bool are_free(const FreeMotion& first, const FreeMotion& second, double delay,
                              CellState state) const;

  /// The straight line, or the quickest of several paths through one or two other points: both ends drawn back, and
  /// points drawn at random around the line. The same arguments give the same path.
  /// @return points of a free path, with both ends; nothing: none was found
  [[nodiscard]] std::optional<std::vector<AxisVector>> find(Hand hand, const AxisVector& from,
                                                            const AxisVector& to,
                                                            const CellState& state) const;

 private:
  [[nodiscard]] bool is_free(Hand hand, const std::vector<AxisVector>& points, const CellState& state) const;
  [[nodiscard]] std::optional<AxisVector> drawn_back(Hand hand, const AxisVector& joints,
                                                     double distance) const;

  const PlanCell& cell_;
};

}  // namespace mrroc::rubik
