// The motions between postures: how long they take, and whether they are free.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "tasks/rubik/plan/paths.hpp"
#include "tasks/rubik/plan/stances.hpp"

namespace mrroc::rubik {

/// What a hand does from one of its postures to another.
enum class MotionKind : std::uint8_t {
  carry,   ///< from grip to grip with the cube, the other hand is drawn back
  reach,   ///< from drawn back to where the approach begins, the other hand holds the cube
  turn,    ///< from grip to grip, both hands at the cube
  retreat  ///< from its grip to drawn back, the other hand holds the cube
};

/// One of them.
struct Motion {
  MotionKind kind{};
  Hand hand{};
  int from{}, to{};  ///< numbers of the hand's postures
  int others{};      ///< number of the other hand's posture

  friend auto operator<=>(const Motion&, const Motion&) = default;
};

/// Postures of both hands, and what is known of the motions between them. Ways are looked for when they are asked for,
/// and kept.
class Motions {
 public:
  /// @param cell  outlives this object
  explicit Motions(const PlanCell& cell);

  /// The last posture of each hand becomes where the arms are now.
  void start_at(const ArmJoints& joints);

  [[nodiscard]] const std::vector<Stance>& stances(Hand hand) const { return stances_[index(hand)]; }
  [[nodiscard]] const Stance& stance(Hand hand, int number) const {
    return stances(hand)[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] int start(Hand hand) const { return static_cast<int>(stances(hand).size()) - 1; }

  /// @return duration [s]: of the way if it has been found, infinite if there is none, else of the straight line
  [[nodiscard]] double seconds(const Motion& motion) const;
  /// Looks for the way. @return null: there is none
  [[nodiscard]] const FreeMotion* find(const Motion& motion);
  /// @return the cube in the one hand when the other one holds it so, both in these postures
  [[nodiscard]] Grasp seen_from(Hand hand, int stance, const Grasp& grasp, int others) const;

 private:
  [[nodiscard]] std::optional<FreeMotion> look_for(const Motion& motion) const;
  [[nodiscard]] double straight_seconds(const Motion& motion) const;

  const PlanCell& cell_;
  Paths paths_;
  std::array<std::vector<Stance>, 2> stances_;
  std::array<std::vector<Matrix3>, 2> R_UE_;  // of the grips
  // By kind (carry, reach, turn, retreat), hand, from, to.
  std::array<std::array<std::vector<double>, 2>, 4> straight_;
  std::map<Motion, std::optional<FreeMotion>> known_;
};

}  // namespace mrroc::rubik
