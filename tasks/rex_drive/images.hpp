// Images of the locomotion agent a_1 (paper REX 3.1: buffers of the control subsystem c_1).
#pragma once
#include <cstdint>
#include <vector>

#include "base/agent_images.hpp"
#include "base/platform_transmission.hpp"
#include "tasks/rex_drive/plan/proc.hpp"
#include "tasks/rex_drive/planner/trajgen.hpp"
#include "tasks/rex_drive/still_pictures.hpp"
#include "tasks/rex_drive/wheel_watch.hpp"

namespace mrroc::rex_drive {

/// Constant parameters of a_1.
struct Parameters {
  PlannerParameters planner;  ///< of the trajectory planner
  double grip{0.4};           ///< share of the estimated friction that a curve may need
  double lost{0.2};           ///< standard deviation of the position above which the platform waits [m]
  std::int64_t stale{500};    ///< age of a reading of the odometry above which there is none any more [steps]
};

/// c_c1
struct Memory {
  Parameters k;                      ///< constant during a run
  Route plan;                        ///< [plan]: points that are not planned yet
  std::vector<Trajectory> traj;      ///< [traj]: planned and not handed over yet, the next one first
  Trajgen trajgen;                   ///< [trajgen]
  bool new_plan{};                   ///< [new]
  std::int64_t taken{};              ///< number of the plan taken last; 0: none
  std::int64_t handed{};             ///< number of the fragment handed over last; 0: none
  PathPoint end;                     ///< where that one ends
  std::int64_t before_plan{};        ///< number of the last fragment handed over before the plan was taken
  std::vector<std::int32_t> points;  ///< of this plan, to which its fragments lead, in their order
  double pace{1};                    ///< to which the fragments' time is to go: 0 stands
  bool lost{};                       ///< the platform waits for its position
  WheelWatch wheels;    ///< how the wheels have turned, against which a motion that is seen is held
  StillPictures still;  ///< since the pictures show none
};

/// Order::variant of the coordinator while the operator has a pause.
inline constexpr int kPaused = 1;

/// x_cT of a_1: orders and plans from a_2, the map from a_3.
struct Heard : Order {
  Plan desired;   ///< T_x_c1,2[desired_plan]
  MapReport map;  ///< T_x_c1,3[x^, y^, phi^]
  using Order::operator=;
};
/// y_cT of a_1: its report to a_2, whose event is ack, and the estimate to a_3.
struct Said : Report {
  PlatformEstimate estimate;  ///< T_y_c1,3[q~, q~']
  using Report::operator=;
};

/// Report::sensor of a_1: a sum of these, and of kPointUnit times the number of the plan's point that the platform is on
/// its way to, from 1.
inline constexpr int kMapSeen = 1;       ///< the newest map pose is valid
inline constexpr int kOdometrySeen = 2;  ///< so is the newest reading of the odometry, and it is not old
inline constexpr int kStands = 4;        ///< the platform is at rest at the end of what it was handed
inline constexpr int kPositionLost = 8;  ///< it waits because it does not know its position well enough
/// Report::sensor counts points in this unit.
inline constexpr int kPointUnit = 16;
/// Above all points: the pictures stand still though the wheels turn, and what they say is not believed. kOdometrySeen is
/// not told then.
inline constexpr int kPicturesStand = 1 << 20;

/// Images of a_1.
struct Locomotion {
  /// x: memory c, reply of the effector driver e, reading of the odometry V, what is heard T.
  struct X {
    Memory c{};
    PlatformReply e;
    OdometryReading V;
    Heard T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e, report and estimate T; the odometry is not told anything.
  struct Y {
    Memory c{};
    PlatformCommand e;
    None V;
    Said T;
  };
};

}  // namespace mrroc::rex_drive
