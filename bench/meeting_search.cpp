#include "bench/meeting_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "sim/cube.hpp"
#include "tasks/rubik/plan/grips.hpp"

namespace mrroc::bench {
namespace {

using namespace rubik;
using std::numbers::pi;

constexpr double kSideStep = pi / 18;  // of the directions of a side grip that are tried
constexpr int kQuarters = 4;           // positions of a hand that turns
constexpr std::size_t kBettered = 40;  // candidates that are bettered
constexpr int kBetterSteps = 400;      // of each
const Vector3 kLeastPlace(-0.2, 0.2, 0.4), kMostPlace(1.4, 2.2, 1.9);  // in the world [m]

/// Of one posture, as in meeting_reach().
double margin(const PlanCell& cell, Hand hand, const AxisVector& joints) {
  const double s = cell.manipulability(hand, joints);
  return std::min(cell.joint_limit_margin(hand, joints), 2 * (1 - std::sqrt(std::max(0., 1 - s * s))));
}

/// @return the best margin that the hand keeps in so many positions, a quarter turn apart, of one grip
/// @param hold  the first of these positions gets here
double margin_of_quarters(const PlanCell& cell, Hand hand, const Pose& T_UE, AxisVector& hold) {
  const auto found = cell.inverse(hand, T_UE, hold);
  if (!found) return -1;
  const auto back = cell.inverse(hand, T_UE * along_z(-kRetreatDistance), *found);
  if (!back) return -1;
  const auto last = found->size() - 1;
  double best = -1;
  for (int first = -2 * kQuarters; first <= kQuarters; ++first) {
    double least = 1;
    for (int k = 0; k < kQuarters; ++k)
      for (AxisVector joints : {*found, *back}) {
        joints[last] += (first + k) * pi / 2;
        least = std::min(least, margin(cell, hand, joints));
      }
    if (least <= best) continue;
    best = least;
    hold = *found;
    hold[last] += first * pi / 2;
  }
  return best;
}

/// @return the best margin of the track arm that comes to the cube from any side
double margin_of_side_grip(const PlanCell& cell, const Meeting& meeting) {
  double best = -1;
  for (double angle = 0; angle < 2 * pi; angle += kSideStep) {
    const Pose T_UE = side_grip(meeting, Hand::track, angle).comes;
    for (const AxisVector& near : along_track(meeting.joints[index(Hand::track)]))
      for (const double turn : {0., pi}) {
        const auto joints = cell.inverse(Hand::track, T_UE * turn_about_z(turn), near);
        if (joints) best = std::max(best, margin(cell, Hand::track, *joints));
      }
  }
  return best;
}

/// @return the posture with the wrist turned over: the same pose by the other branch
AxisVector turned_over(AxisVector joints) {
  const auto n = joints.size();
  joints[n - 3] += joints[n - 3] > 0 ? -pi : pi;
  joints[n - 2] = -joints[n - 2];
  joints[n - 1] += joints[n - 1] > 0 ? -pi : pi;
  return joints;
}

/// Chooses the better branch of each arm's wrist and measures. @param joints  where the branches are sought
MeetingCandidate measured(const PlanCell& cell, const Pose& T_UM, const ArmJoints& joints) {
  MeetingCandidate candidate{{T_UM, joints}, 1};
  for (const Hand hand : kHands) {
    double best = -1;
    for (AxisVector hold : {joints[index(hand)], turned_over(joints[index(hand)])}) {
      const double reach = margin_of_quarters(cell, hand, front_grip(candidate.meeting, hand), hold);
      if (reach <= best) continue;
      best = reach;
      candidate.meeting.joints[index(hand)] = hold;
    }
    candidate.reach = std::min(candidate.reach, best);
    if (candidate.reach <= 0) return candidate;
  }
  candidate.reach = std::min(candidate.reach, margin_of_side_grip(cell, candidate.meeting));
  return candidate;
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double between(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }
  Vector3 around(double spread) {
    std::normal_distribution<double> normal(0, spread);
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return {x, y, z};
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

double meeting_reach(const PlanCell& cell, const Meeting& meeting) {
  return measured(cell, meeting.T_UM, meeting.joints).reach;
}

bool meeting_is_free(const PlanCell& cell, const Meeting& meeting) {
  CellState state{
      meeting.joints, {sim::kCubeEdge, sim::kCubeEdge}, {Hand::track, Face::D, Face::B}, true, false};
  for (const Hand hand : kHands)
    for (int k = 0; k < kQuarters; ++k) {
      CellState turned = state;
      AxisVector& joints = turned.joints[index(hand)];
      joints[joints.size() - 1] += k * pi / 2;
      if (!cell.is_free(turned)) return false;
    }
  return true;
}

MeetingCandidate search_meeting(const PlanCell& cell, int candidates, std::uint64_t seed) {
  Draw draw(seed);
  const ArmJoints& usual = cell.meeting().joints;
  std::vector<MeetingCandidate> all;
  for (int k = 0; k < candidates; ++k) {
    Pose T_UM;
    for (int i = 0; i < 3; ++i) T_UM.p[i] = draw.between(kLeastPlace[i], kMostPlace[i]);
    T_UM.R = Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), draw.around(1)).toRotationMatrix() *
             turn_about_z(draw.between(0, pi / 2)).R;
    ArmJoints near = usual;
    near[index(Hand::track)][0] += draw.between(-1, 1);
    all.push_back(measured(cell, T_UM, near));
    if (all.back().reach <= 0) all.pop_back();
  }

  const auto better = [](const MeetingCandidate& a, const MeetingCandidate& b) { return a.reach > b.reach; };
  std::ranges::stable_sort(all, better);
  if (all.size() > kBettered) all.resize(kBettered);
  for (MeetingCandidate& candidate : all)
    for (int k = 0; k < kBetterSteps; ++k) {
      const double size = 1 - static_cast<double>(k) / kBetterSteps;
      Pose T_UM = candidate.meeting.T_UM;
      T_UM.p += draw.around(0.1 * size);
      T_UM.R = T_UM.R * rotation_from_angle_axis(draw.around(0.2 * size));
      ArmJoints near = candidate.meeting.joints;
      near[index(Hand::track)][0] += draw.around(0.1 * size).x();
      const MeetingCandidate next = measured(cell, T_UM, near);
      if (next.reach > candidate.reach) candidate = next;
    }
  std::ranges::stable_sort(all, better);
  const auto free = std::ranges::find_if(
      all, [&](const MeetingCandidate& candidate) { return meeting_is_free(cell, candidate.meeting); });
  return free == all.end() ? MeetingCandidate{} : *free;
}

}  // namespace mrroc::bench
