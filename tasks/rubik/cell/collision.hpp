// Checks for collisions between the arms of the cell, the cube and the surroundings, by the planner's belief.
#pragma once
#include <array>
#include <memory>
#include <string>

#include "tasks/rubik/cell/belief.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

/// Keeps the shapes of two arms with gripper bodies: the links of their descriptions, and instead of the pen a palm on a
/// post and two fingers as wide as their pads. Every shape is made thicker, so that what is free has a distance:
/// 20 mm between links, 11 mm between a link and a hand or the cube, 2 mm between hands and cube. Links of one arm are
/// checked against those that are at least three joints away.
class CellCollision {
 public:
  /// @param cell  its arms may be other robots, whose wrist is like that of the IRb-6
  CellCollision(const CellBelief& cell, const std::optional<Viewing>& viewing);
  ~CellCollision();
  CellCollision(const CellCollision&) = delete;
  CellCollision& operator=(const CellCollision&) = delete;

  /// @return whether no two shapes touch. What grips or may touch the cube does not count against it
  [[nodiscard]] bool is_free(const CellState& state);
  /// @return the names of two shapes that touch in the last state that was not free
  [[nodiscard]] const std::array<std::string, 2>& touching() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::rubik
