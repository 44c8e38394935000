// The cell in which two arms handle a cube, as the planner of grasps sees it.
#pragma once
#include <memory>

#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::sim {

class CellCollision;

/// Kinematics and limits of the arms of a world, and collisions by Bullet.
class CubePlanCell final : public rubik::PlanCell {
 public:
  /// @param world    as made by cube_cell()
  /// @param viewing  where faces are shown to a camera, if there is one
  /// @throws std::invalid_argument  its arms are others
  explicit CubePlanCell(const WorldParameters& world, const std::optional<rubik::Viewing>& viewing = {});
  ~CubePlanCell() override;

  [[nodiscard]] const rubik::Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const rubik::Viewing* viewing() const override { return viewing_ ? &*viewing_ : nullptr; }
  [[nodiscard]] const rubik::SpeedLimits& limits(rubik::Hand hand) const override;
  [[nodiscard]] AxisVector motors(rubik::Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] AxisVector joints(rubik::Hand hand, const AxisVector& motors) const override;
  [[nodiscard]] Pose forward(rubik::Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] std::optional<AxisVector> inverse(rubik::Hand hand, const Pose& T_UE,
                                                  const AxisVector& near) const override;
  [[nodiscard]] double reserve(rubik::Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] double dexterity(rubik::Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] bool is_free(const rubik::CellState& state) const override;

  /// @return for people: what touched what in the last state that was not free
  [[nodiscard]] std::string touching() const;

 private:
  struct Side {
    std::unique_ptr<irb6::Arm> robot;
    Pose T_UB, T_EW;
    rubik::SpeedLimits limits;
  };
  [[nodiscard]] const Side& side(rubik::Hand hand) const { return sides_[rubik::index(hand)]; }

  std::array<Side, 2> sides_;
  rubik::Meeting meeting_;
  std::optional<rubik::Viewing> viewing_;
  std::unique_ptr<CellCollision> collision_;
};

}  // namespace mrroc::sim
