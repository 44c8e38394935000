#include "tasks/rubik/plan/arm_configurations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tasks/rubik/plan/grips.hpp"
#include "tasks/rubik/plan/paths.hpp"

namespace mrroc::rubik {
namespace {

using std::numbers::pi;

constexpr int kPathParts = 2;  // straight in motors they are less than 0.6 mm beside the straight line
constexpr double kSideStep = pi / 36;  // of the directions that are tried
constexpr double kGoodMargin = 0.3;    // a posture at the side that has it needs no more
constexpr double kMarginSeconds = 40;  // what it costs to have less

/// Adds a posture for every angle of the last joint that differs by steps and is within the limits.
void add_turns(std::vector<ArmConfiguration>& configurations, const PlanCell& cell, Hand hand, Place place,
               const AxisVector& hold, double step, const ConfigurationMargins& margins) {
  const int turns = static_cast<int>(4 * pi / step);
  for (int k = -turns; k <= turns; ++k) {
    AxisVector joints = hold;
    joints[joints.size() - 1] += k * step;
    if (cell.joint_limit_margin(hand, joints) < margins.limits) continue;
    if (const auto path = find_path(cell, hand, joints, margins))
      configurations.push_back({place, joints, *path, Vector3::Zero()});
  }
}

/// @return T_GE of a hand that shows the face out of which a direction of E points, its jaws at an angle to x of G
Pose shown_hand(Hand hand, const Vector3& shown, double angle) {
  Matrix3 R_GE;
  R_GE.col(1) = Vector3(std::cos(angle), std::sin(angle), 0);
  const Vector3 z = Vector3::UnitZ();
  if (shown.z() > 0) {
    R_GE.col(2) = z;
    R_GE.col(0) = R_GE.col(1).cross(z);
  } else {
    R_GE.col(0) = shown.x() * z;
    R_GE.col(2) = R_GE.col(0).cross(R_GE.col(1));
  }
  return {R_GE, Vector3(0, 0, -kEdge / 2) - depth(hand) * R_GE.col(2)};
}

/// Joints of both hands in a grip from the side.
struct SidePostures {
  AxisVector comes, offers;
  double cost{1e9};
};

class SideSearch {
 public:
  SideSearch(const PlanCell& cell, Hand hand, const ConfigurationMargins& margins)
      : cell_(cell), hand_(hand), margins_(margins) {}

  std::optional<SidePostures> find() {
    const int directions = static_cast<int>(std::round(2 * pi / kSideStep));
    for (int k = 0; k < directions; ++k) consider(k * kSideStep);
    if (best_.cost < 1e8) return best_;
    return {};
  }

 private:
  void consider(double angle) {
    const Meeting& meeting = cell_.meeting();
    const SideGrip grip = side_grip(meeting, hand_, angle);
    const auto offers = nearest_turn(other(hand_), grip.offers, meeting.joints[index(other(hand_))]);
    if (!offers) return;
    for (const AxisVector& near : along_track(meeting.joints[index(hand_)]))
      if (const auto comes = nearest_turn(hand_, grip.comes, near)) weigh(*comes, *offers);
  }

  /// Half a turn about z leaves a gripper the same.
  std::optional<AxisVector> nearest_turn(Hand hand, const Pose& T_UE, const AxisVector& near) const {
    std::optional<AxisVector> best;
    for (const double turn : {0.0, pi}) {
      const auto joints = cell_.inverse(hand, T_UE * turn_about_z(turn), near);
      if (joints && cell_.joint_limit_margin(hand, *joints) > margins_.limits &&
          (!best || seconds_along(cell_, hand, {near, *joints}) < seconds_along(cell_, hand, {near, *best})))
        best = joints;
    }
    return best;
  }

  void weigh(const AxisVector& comes, const AxisVector& offers) {
    const auto path = find_path(cell_, hand_, comes, margins_);
    if (!path) return;
    const double margin =
        std::min({cell_.joint_limit_margin(hand_, comes), cell_.joint_limit_margin(hand_, path->front()),
                  cell_.manipulability(hand_, comes) - margins_.manipulability});
    if (margin < margins_.limits) return;
    const Hand giver = other(hand_);
    const double cost = seconds_along(cell_, hand_, {cell_.meeting().joints[index(hand_)], comes}) +
                        seconds_along(cell_, giver, {cell_.meeting().joints[index(giver)], offers}) +
                        kMarginSeconds * std::max(0.0, kGoodMargin - margin);
    if (cost >= best_.cost) return;
    CellState state;
    state.joints[index(hand_)] = comes;
    state.joints[index(giver)] = offers;
    state.jaws[index(hand_)] = kOpenJaws;
    state.jaws[index(giver)] = kEdge;
    state.grasp = {giver, Face::D, Face::B};
    const Paths paths(cell_);
    for (std::size_t k = 1; k < path->size(); ++k)
      if (!paths.is_free(hand_, (*path)[k - 1], (*path)[k], state)) return;
    state.touched = true;
    if (!paths.is_free(hand_, path->back(), comes, state)) return;
    best_ = {comes, offers, cost};
  }

  const PlanCell& cell_;
  Hand hand_;
  ConfigurationMargins margins_;
  SidePostures best_;
};

/// Adds for each face that is free of palm and fingers the quickest posture that shows it.
void add_shown(std::vector<ArmConfiguration>& configurations, const PlanCell& cell, Hand hand,
               const ConfigurationMargins& margins) {
  const Viewing& viewing = *cell.viewing();
  const AxisVector& start = cell.meeting().joints[index(hand)];
  CellState state;
  state.joints[index(other(hand))] = cell.meeting().joints[index(other(hand))];
  const auto drawn_back = find_path(cell, other(hand), state.joints[index(other(hand))], margins);
  if (!drawn_back) return;
  state.joints[index(other(hand))] = drawn_back->front();
  state.jaws[index(hand)] = kEdge;
  state.jaws[index(other(hand))] = kOpenJaws;
  state.grasp = {hand, Face::D, Face::B};
  state.looked_at = true;
  const auto is_good = [&](const AxisVector& joints) {
    state.joints[index(hand)] = joints;
    return cell.joint_limit_margin(hand, joints) >= margins.limits &&
           cell.manipulability(hand, joints) >= margins.manipulability && cell.is_free(state);
  };
  for (const Vector3& shown : {Vector3(0, 0, 1), Vector3(1, 0, 0), Vector3(-1, 0, 0)}) {
    std::optional<AxisVector> best;
    double least = 1e9;
    // Jaws along an edge of the place; which one does not matter.
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Pose T_GE = shown_hand(hand, shown, quarter * pi / 2);
      for (const AxisVector& near : along_track(start)) {
        const auto joints = cell.inverse(hand, viewing.T_UG * T_GE, near);
        if (!joints) continue;
        const double seconds = seconds_along(cell, hand, {start, *joints});
        if (seconds >= least || !is_good(*joints)) continue;
        best = joints;
        least = seconds;
      }
    }
    if (best) configurations.push_back({Place::shown, *best, {*best}, shown});
  }
}

}  // namespace

std::optional<std::vector<AxisVector>> find_path(const PlanCell& cell, Hand hand, const AxisVector& hold,
                                                 const ConfigurationMargins& margins) {
  const Pose T_UE = cell.forward(hand, hold);
  std::vector<AxisVector> path;
  AxisVector near = hold;
  for (int k = 0; k <= kPathParts; ++k) {
    const double distance = kApproachDistance + (kRetreatDistance - kApproachDistance) * k / kPathParts;
    const auto joints = cell.inverse(hand, T_UE * along_z(-distance), near);
    if (!joints || cell.joint_limit_margin(hand, *joints) < margins.limits) return {};
    // Another branch would not be near.
    if ((*joints - near).cwiseAbs().maxCoeff() > 0.3) return {};
    near = *joints;
    path.push_back(near);
  }
  std::ranges::reverse(path);
  return path;
}

std::vector<ArmConfiguration> find_configurations(const PlanCell& cell, Hand hand,
                                                  const ConfigurationMargins& margins) {
  std::vector<ArmConfiguration> configurations;
  const Meeting& meeting = cell.meeting();
  if (const auto hold = cell.inverse(hand, front_grip(meeting, hand), meeting.joints[index(hand)]))
    add_turns(configurations, cell, hand, Place::front, *hold, pi / 2, margins);
  if (const auto grip = SideSearch(cell, hand, margins).find())
    add_turns(configurations, cell, hand, Place::side, grip->comes, pi, margins);
  if (const auto grip = SideSearch(cell, other(hand), margins).find())
    add_turns(configurations, cell, hand, Place::offered, grip->offers, pi, margins);
  if (cell.viewing()) add_shown(configurations, cell, hand, margins);
  return configurations;
}

}  // namespace mrroc::rubik
