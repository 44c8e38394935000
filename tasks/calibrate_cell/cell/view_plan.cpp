#include "tasks/calibrate_cell/cell/view_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/artefact.hpp"
#include "base/target/target_config.hpp"
#include "edp/guard.hpp"
#include "tasks/calibrate_cell/cell/believed_arm.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr int kMostTried = 20000;       // poses
constexpr double kMarginPx = 25;        // of the board from the picture's edges
constexpr double kBetweenTips = 0.1;    // [m]
constexpr double kBesideBalls = 0.12;   // of a tip from the middles of balls [m]
constexpr double kBetweenArms = 0.3;    // from lines through the middle of the other arm [m]
constexpr double kShoulder = 0.7;       // height of the other arm's [m]
constexpr double kAboveTables = 1.1;    // [m] over the floor
constexpr double kRise = 0.4;           // [rad] by which the upper arm rises
constexpr double kAside = 1.25;         // [rad] by which the column turns away
constexpr double kMostTrack = 1.2;      // [m]
constexpr double kTrackStep = 0.2;      // [m]
constexpr double kFarthest = 1.2;       // [rad] between poses of a series
constexpr double kFromSwitches = 0.03;  // of a motor's range: so far off are encoders of another set
constexpr Eigen::Index kTurning = 6;    // axes of an arm behind its track

[[noreturn]] void refuse(const std::string& text, const std::string& hint = "") {
  throw FaultError(FaultCode::bad_configuration, text, hint);
}

std::vector<double> numbers(const AxisVector& q) { return {q.begin(), q.end()}; }

/// @return number n of the sequence of Halton (1960) in that base, from 0 to 1
double halton(int n, int base) {
  double x = 0, share = 1;
  for (int rest = n + 1; rest > 0; rest /= base) {
    share /= base;
    x += share * (rest % base);
  }
  return x;
}

/// Both arms with their cameras and the board, and where they stand.
struct Cell {
  explicit Cell(const Config& config)
      : sight(read_sight(config)), arms{read_arm(config, 0), read_arm(config, 1)} {
    const Config t = config.section("task");
    const auto place = [&](const char* key, const std::array<double, 3>& usual) {
      const auto p = t.numbers<3>(key, usual, {-10, 10}, "m, of E in the world, while the other arm moves");
      return Vector3(p[0], p[1], p[2]);
    };
    T_UE[kCameraArm] = {arms[kCameraArm].R_UE, place("camera_stand", {0.4, 1.14, 1.07})};
    T_UE[kBoardArm] = {arms[kBoardArm].R_UE, place("board_stand", {0.4, 0.95, 0.9})};
    for (std::size_t arm = 0; arm < kArms; ++arm) stand[arm] = joints_at(arm);
    if (const auto artefact = read_artefact(config))
      for (const Vector3& ball : artefact->balls) balls.push_back(artefact->T_UA * ball);
  }

  /// @return whether a tip there is on this side of the balls, so that ways between such places keep away from them
  [[nodiscard]] bool beside_balls(const Vector3& tip) const {
    if (balls.empty()) return true;
    Vector3 aside = (T_UE[0].p + T_UE[1].p) / 2;
    for (const Vector3& ball : balls) aside -= ball / static_cast<double>(balls.size());
    aside.z() = 0;
    aside.normalize();
    return std::ranges::all_of(balls, [&](const Vector3& b) { return (tip - b).dot(aside) > kBesideBalls; });
  }

  [[nodiscard]] AxisVector joints_at(std::size_t arm) const {
    const Reach r = reach(arms[arm], T_UE[arm], arms[arm].usual_joints());
    if (!r.why.empty())
      refuse(fmt::format("{} is to stand before the other arm: {}", kKeys[arm], r.why),
             "change task.camera_stand or task.board_stand");
    return r.joints;
  }
  /// @return the camera in the world
  [[nodiscard]] Pose place(const CameraSetup& camera) const {
    if (camera.mount == CameraMount::world) return camera.place;
    return arms[camera.robot == kKeys[0] ? 0 : 1].T_UB * camera.place;
  }

  BelievedSight sight;
  std::array<BelievedArm, kArms> arms;
  std::array<Pose, kArms> T_UE;
  std::array<AxisVector, kArms> stand;
  std::vector<Vector3> balls;  // in the world
};

/// @return whether no switch is pressed there, also with another kinematic set than the driver believes
bool off_switches(const edp::Robot& robot, const AxisVector& joints) {
  const AxisVector motors = robot.motors_from_joints(joints);
  for (int k = 0; k < robot.axes(); ++k) {
    const edp::Range& range = robot.axis(k).motor;
    const double margin = kFromSwitches * (range.upper - range.lower);
    if (motors[k] < range.lower + margin || motors[k] > range.upper - margin) return false;
  }
  return true;
}

/// @return whether no joint has far to go
bool near_to(const AxisVector& a, const AxisVector& b) { return (a - b).cwiseAbs().maxCoeff() < kFarthest; }

/// @return the way through a series of poses that goes on to the nearest one each time
std::vector<std::vector<double>> ordered(std::vector<AxisVector> poses, AxisVector from) {
  std::vector<std::vector<double>> way;
  while (!poses.empty()) {
    const auto next = std::ranges::min_element(
        poses, {}, [&](const AxisVector& q) { return (q - from).cwiseAbs().maxCoeff(); });
    from = *next;
    way.push_back(numbers(from));
    poses.erase(next);
  }
  return way;
}

/// Poses with the board before the camera in the hand. @param moving  the arm that moves
std::vector<std::vector<double>> before_hand(const Cell& c, std::size_t moving, std::size_t wanted) {
  const CameraSetup& camera = *c.sight.in_hand;
  const Pose T_UC = c.T_UE[kCameraArm] * camera.place, T_UG = c.T_UE[kBoardArm] * c.sight.T_EG;
  const Pose usual = T_UC.inverse() * T_UG;
  const ViewRange range{
      .nearest = 0.8 * usual.p.norm(), .farthest = 1.25 * usual.p.norm(), .roll = 0.6, .upright = usual.R};
  std::vector<AxisVector> found;
  for (int n = 0; n < kMostTried && found.size() < wanted; ++n) {
    const Pose T_CG = board_before(camera.model, range, n);
    if (!in_sight(camera.model, c.sight.board, T_CG)) continue;
    std::array<Pose, kArms> T_UE = c.T_UE;
    if (moving == kBoardArm)
      T_UE[moving] = T_UC * T_CG * c.sight.T_EG.inverse();
    else
      T_UE[moving] = T_UG * T_CG.inverse() * camera.place.inverse();
    if ((T_UE[0].p - T_UE[1].p).norm() < kBetweenTips || !c.beside_balls(T_UE[moving].p)) continue;
    const Reach r = reach(c.arms[moving], T_UE[moving], c.stand[moving]);
    if (r.why.empty() && near_to(r.joints, c.stand[moving]) && off_switches(*c.arms[moving].robot, r.joints))
      found.push_back(r.joints);
  }
  return ordered(std::move(found), c.stand[moving]);
}

/// @return of a point from the line between two others [m]
double distance_from_line(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 along = b - a;
  const double share = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-9), 0.0, 1.0);
  return (a + share * along - p).norm();
}

/// Where the camera's arm makes room.
struct Room {
  AxisVector risen;  ///< before the other arm, above what stands between both
  AxisVector aside;  ///< its column turned away from the cameras that stand alone
};

/// @return the joints with one of them changed; nothing: that is beyond its limits
std::optional<AxisVector> with_joint(const BelievedArm& a, const AxisVector& q, Eigen::Index axis,
                                     double by) {
  const AxisVector to = q + by * AxisVector::Unit(q.size(), axis);
  const edp::AxisPositions from{q, a.robot->motors_from_joints(q)};
  if (edp::check_range(*a.robot, from, {to, a.robot->motors_from_joints(to)}, 0) ||
      !off_switches(*a.robot, to))
    return {};
  return to;
}

Room make_room(const Cell& c) {
  Room room{c.stand[kCameraArm], c.stand[kCameraArm]};
  if (c.sight.fixed.empty()) return room;
  const BelievedArm& a = c.arms[kCameraArm];
  const Eigen::Index column = room.risen.size() - kTurning, upper_arm = column + 2;
  for (const double by : {-kRise, kRise}) {
    const auto q = with_joint(a, c.stand[kCameraArm], upper_arm, by);
    if (q && a.at(*q).p.z() > a.at(room.risen).p.z()) room.risen = *q;
  }
  room.aside = room.risen;
  const auto away = [&](const AxisVector& q) {
    return (a.at(q).p - c.place(c.sight.fixed.front()).p).norm();
  };
  for (const double by : {-kAside, kAside}) {
    const auto q = with_joint(a, room.risen, column, by);
    if (q && away(*q) > away(room.aside)) room.aside = *q;
  }
  return room;
}

/// Whether hand and board keep away from the other arm, and from tables.
bool clear(const Cell& c, const AxisVector& other, const Pose& T_UE) {
  const BelievedArm& a = c.arms[kCameraArm];
  const Pose E = a.at(other), W = E * a.T_WE.inverse();
  const Vector3 shoulder = a.T_UB * Vector3(0, 0, kShoulder);
  const BelievedArm& moving = c.arms[kBoardArm];
  for (const Vector3& p : {T_UE.p, (T_UE * moving.T_WE.inverse()).p, (T_UE * c.sight.T_EG).p})
    if (p.z() < kAboveTables || distance_from_line(p, shoulder, W.p) < kBetweenArms ||
        distance_from_line(p, W.p, E.p) < kBetweenArms)
      return false;
  return true;
}

/// Poses with the board before a camera that stands alone, all with the same place of a track: the first one with enough of
/// them. @param other  joints of the other arm
std::vector<AxisVector> before_fixed(const Cell& c, const CameraSetup& camera, const AxisVector& other,
                                     std::size_t wanted) {
  ViewRange range{.nearest = 0.5, .farthest = 2, .roll = std::numbers::pi};
  range.upright << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  AxisVector near = c.stand[kBoardArm];
  std::vector<AxisVector> most;
  do {
    std::vector<AxisVector> found;
    for (int n = 0; n < kMostTried && found.size() < wanted; ++n) {
      const Pose T_CG = board_before(camera.model, range, n);
      const Pose T_UE = c.place(camera) * T_CG * c.sight.T_EG.inverse();
      if (!in_sight(camera.model, c.sight.board, T_CG) || !clear(c, other, T_UE)) continue;
      const Reach r = reach(c.arms[kBoardArm], T_UE, near);
      if (r.why.empty() && (found.empty() || near_to(r.joints, found.front())) &&
          off_switches(*c.arms[kBoardArm].robot, r.joints))
        found.push_back(r.joints);
    }
    if (found.size() > most.size()) most = std::move(found);
    near[0] += kTrackStep;
  } while (near.size() > kTurning && near[0] < kMostTrack && most.size() < wanted);
  return most;
}

}  // namespace

BelievedSight read_sight(const Config& config) {
  BelievedSight s;
  for (const std::string& key : camera_keys(config)) {
    const CameraSetup camera = read_camera(config, key);
    if (camera.mount != CameraMount::robot) {
      s.fixed.push_back(camera);
      continue;
    }
    if (camera.robot != kKeys[kCameraArm] || s.in_hand)
      refuse(
          fmt::format("cameras.{}.mount: one camera can be in a hand, that of {}", key, kKeys[kCameraArm]));
    s.in_hand = camera;
  }
  s.board = read_board(config);
  const Config t = config.section("object");
  const auto pose = t.numbers<6>("pose", {{0.9, 0, 0.93, 0, 0, 0}}, {-10, 10}, "m, angle times axis in rad");
  s.T_EG = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(pose.data()));
  if (t.text("arm", "arm1") != kKeys[kBoardArm] || !t.flag("in_hand", false))
    refuse(fmt::format("object.arm, object.in_hand: the board must be in the hand of {}", kKeys[kBoardArm]));
  return s;
}

Pose board_before(const CameraModel& camera, const ViewRange& range, int n) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double u = halton(n, 2) * (camera.width - 1), v = halton(n, 3) * (camera.height - 1);
  const double distance = range.nearest + halton(n, 5) * (range.farthest - range.nearest);
  const double towards = kTurn * halton(n, 7), tilt = range.tilt * std::sqrt(halton(n, 11));
  const double roll = range.roll * (2 * halton(n, 13) - 1);
  const Vector3 sight((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
  const Vector3 axis(std::cos(towards), std::sin(towards), 0);
  return {rotation_from_angle_axis(tilt * axis) * range.upright * rotation_from_angle_axis({0, 0, roll}),
          distance * sight.normalized()};
}

bool in_sight(const CameraModel& camera, const Board& board, const Pose& T_CG) {
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Vector3 corner = T_CG * Vector3(x * board.width(), y * board.height(), 0);
      if (corner.z() <= 0) return false;
      const Vector2 p = project(camera, corner);
      if (p.x() < kMarginPx || p.y() < kMarginPx || p.x() > camera.width - kMarginPx ||
          p.y() > camera.height - kMarginPx)
        return false;
    }
  return true;
}

ViewPlan plan_views(const Config& config, std::size_t arm, std::size_t views) {
  const Cell c(config);
  const std::vector<double> stand = numbers(c.stand.at(arm));
  const Room room = make_room(c);
  const auto enough = [&](std::vector<std::vector<double>> poses, const std::string& camera) {
    if (poses.size() < kLeastViews)
      refuse(fmt::format("{} reaches only {} poses in which camera {} sees the board; {} are needed",
                         kKeys.at(arm), poses.size(), camera, kLeastViews),
             "move the board (object.pose), or leave the camera out of cameras.order");
    return poses;
  };
  std::vector<std::vector<double>> of_hand;
  if (c.sight.in_hand) of_hand = enough(before_hand(c, arm, views), c.sight.in_hand->key);
  if (arm == kCameraArm)
    return {{Turn::look, stand, of_hand},
            {Turn::rise, numbers(room.risen), {}},
            {Turn::make_room, numbers(room.aside), {}}};
  std::vector<std::vector<double>> of_fixed;
  for (const CameraSetup& camera : c.sight.fixed)
    std::ranges::move(
        enough(ordered(before_fixed(c, camera, room.aside, views), c.stand[kBoardArm]), camera.key),
        std::back_inserter(of_fixed));
  return {{Turn::show, stand, of_hand}, {Turn::present, stand, of_fixed}, {Turn::leave, stand, {}}};
}

}  // namespace mrroc::calibrate_cell
