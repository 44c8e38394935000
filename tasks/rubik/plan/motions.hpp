// The motions between postures: their durations, and checks for collisions.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "tasks/rubik/plan/arm_configurations.hpp"
#include "tasks/rubik/plan/paths.hpp"

namespace mrroc::rubik {

/// Kind of a hand's motion from one of its postures to another.
enum class MotionKind : std::uint8_t {
  carry,   ///< from grip to grip with the cube, the other hand is drawn back
  reach,   ///< from drawn back to where the approach begins, the other hand holds the cube
  turn,    ///< from grip to grip, both hands at the cube
  retreat  ///< from its grip to drawn back, the other hand holds the cube
};

/// One of them: the motion of one arm from one posture to another.
struct ArmTransfer {
  MotionKind kind{};  ///< decides what the other hand does meanwhile
  Hand hand{};        ///< that moves
  int from{}, to{};   ///< numbers of the hand's postures
  int others{};       ///< number of the other hand's posture

  /// In the order of its fields.
  friend bool operator<(const ArmTransfer& a, const ArmTransfer& b) {
    return std::tie(a.kind, a.hand, a.from, a.to, a.others) <
           std::tie(b.kind, b.hand, b.from, b.to, b.others);
  }
};

/// Postures of both hands, and what is known of the motions between them. Ways are looked for when they are asked for,
/// and kept. Postures that differ by whole turns of the last joint are of one class; for a motion between classes the
/// best of their members counts.
class Motions {
 public:
  /// @param cell  outlives this object
  explicit Motions(const PlanCell& cell);

  /// The last posture of each hand becomes where the arms are now.
  void start_at(const ArmJoints& joints);

  /// @return its postures by number; the last one is where the arm is at the beginning
  [[nodiscard]] const std::vector<ArmConfiguration>& configurations(Hand hand) const {
    return configurations_[index(hand)];
  }
  /// @param number  0..configurations(hand).size() - 1
  [[nodiscard]] const ArmConfiguration& configuration(Hand hand, int number) const {
    return configurations(hand)[static_cast<std::size_t>(number)];
  }
  /// @return number of the posture, and of the class, where the arm is at the beginning
  [[nodiscard]] int start(Hand hand) const { return static_cast<int>(configurations(hand).size()) - 1; }
  [[nodiscard]] int start_class(Hand hand) const { return class_of_[index(hand)].back(); }

  /// @return the postures of each class of a hand
  [[nodiscard]] const std::vector<std::vector<int>>& classes(Hand hand) const {
    return classes_[index(hand)];
  }
  /// @return one of the class
  [[nodiscard]] const ArmConfiguration& example(Hand hand, int of_class) const {
    return configuration(hand, classes(hand)[static_cast<std::size_t>(of_class)].front());
  }
  /// @return the class of the track arm's posture after so many quarter turns; nothing: it is not at a face
  [[nodiscard]] std::optional<int> turned_class(int of_class, int quarters) const;

  /// @return duration [s]: of the path if it has been found, infinite if there is none, else of the straight line
  [[nodiscard]] double seconds(const ArmTransfer& motion) const;
  /// @param motion  with numbers of classes @return the least duration of a member
  [[nodiscard]] double class_seconds(const ArmTransfer& motion) const;
  /// @return duration of the straight line, whatever is in the way, between classes [s]
  [[nodiscard]] double straight_seconds(MotionKind kind, Hand hand, int from, int to) const;
  /// Looks for the path. @return null: there is none
  [[nodiscard]] const FreeMotion* find(const ArmTransfer& motion);
  /// @param carry, reach  of one step, with paths that have been found
  /// @return how long after the carrying hand the other one may set out, such that it does not come before the cube has
  ///         come; nothing: when that one has arrived
  [[nodiscard]] std::optional<double> delay(const ArmTransfer& carry, const ArmTransfer& reach);
  /// @return the cube in the one hand when the other one holds it so, both in postures of these classes
  [[nodiscard]] Grasp seen_from(Hand hand, int of_class, const Grasp& grasp, int others) const;

 private:
  [[nodiscard]] std::optional<FreeMotion> look_for(const ArmTransfer& motion) const;
  [[nodiscard]] std::optional<double> look_for_delay(const FreeMotion& carry, const FreeMotion& reach) const;
  [[nodiscard]] double line_seconds(MotionKind kind, Hand hand, int number, int target) const;
  void sort_into_classes(Hand hand);
  [[nodiscard]] ArmTransfer classified(const ArmTransfer& motion) const;
  [[nodiscard]] std::size_t slot(const ArmTransfer& motion) const;
  [[nodiscard]] double least_of_members(const ArmTransfer& motion) const;

  /// Durations of one kind of motion of one hand.
  struct Table {
    std::vector<double> lines;    // by posture from, to
    std::vector<double> classes;  // by class from, to, and of the other hand
  };

  const PlanCell& cell_;
  Paths paths_;
  std::array<std::vector<ArmConfiguration>, 2> configurations_;
  std::array<std::vector<std::vector<int>>, 2> classes_;
  std::array<std::vector<int>, 2> class_of_;
  std::array<std::vector<Matrix3>, 2> R_UE_;    // of the grips, by class
  std::array<std::array<Table, 2>, 4> tables_;  // by kind and hand
  std::map<ArmTransfer, std::optional<FreeMotion>> known_;
  std::map<std::pair<ArmTransfer, ArmTransfer>, std::optional<double>> delays_;  // of reaches after carries
};

}  // namespace mrroc::rubik
