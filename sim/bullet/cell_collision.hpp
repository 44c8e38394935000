// Whether the arms of a cell, the cube and what stands around touch each other, by Bullet's collision detection.
#pragma once
#include <array>
#include <memory>

#include "sim/world.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::sim {

/// Keeps the shapes of two arms with gripper bodies: the links of their descriptions, and instead of the pen a palm on a
/// post and two fingers as wide as their pads. Every shape is made thicker, so that what is free has a distance:
/// 20 mm between links, 11 mm between a link and a hand or the cube, 2 mm between hands and cube. Links of one arm are
/// checked against those that are at least three joints away.
class CellCollision {
 public:
  /// @param world  its arms are the postument's and the track's, with grippers
  /// @throws std::invalid_argument  they are not
  CellCollision(const WorldParameters& world, const std::optional<rubik::Viewing>& viewing);
  ~CellCollision();
  CellCollision(const CellCollision&) = delete;
  CellCollision& operator=(const CellCollision&) = delete;

  /// @return whether no two shapes touch. What grips or may touch the cube does not count against it
  [[nodiscard]] bool is_free(const rubik::CellState& state);
  /// @return the names of two shapes that touch in the last state that was not free
  [[nodiscard]] const std::array<std::string, 2>& touching() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
