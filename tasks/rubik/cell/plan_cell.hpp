// The cell in which two arms handle a cube, as the planner of grasps sees it.
#pragma once
#include <memory>

#include "edp/robot.hpp"
#include "tasks/rubik/cell/belief.hpp"
#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::rubik {

class CellCollision;

/// Kinematics and limits of the arms, and collisions, as the task believes the cell.
class CubePlanCell final : public PlanCell {
 public:
  /// @param viewing  where faces are shown to a camera, if there is one
  explicit CubePlanCell(const CellBelief& cell, const std::optional<Viewing>& viewing = {});
  ~CubePlanCell() override;

  [[nodiscard]] const Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const Viewing* viewing() const override { return viewing_ ? &*viewing_ : nullptr; }
  [[nodiscard]] const SpeedLimits& limits(Hand hand) const override;
  [[nodiscard]] AxisVector motors(Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] AxisVector joints(Hand hand, const AxisVector& motors) const override;
  [[nodiscard]] Pose forward(Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] std::optional<AxisVector> inverse(Hand hand, const Pose& T_UE,
                                                  const AxisVector& near) const override;
  [[nodiscard]] double joint_limit_margin(Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] double manipulability(Hand hand, const AxisVector& joints) const override;
  [[nodiscard]] bool is_free(const CellState& state) const override;

  /// @return for people: what touched what in the last state that was not free
  [[nodiscard]] std::string touching() const;

 private:
  struct Side {
    std::unique_ptr<edp::Robot> robot;
    Pose T_UB, T_WE, T_EW;
    SpeedLimits limits;
  };
  [[nodiscard]] const Side& side(Hand hand) const { return sides_[index(hand)]; }

  std::array<Side, 2> sides_;
  Meeting meeting_;
  std::optional<Viewing> viewing_;
  std::unique_ptr<CellCollision> collision_;
};

}  // namespace mrroc::rubik
