// The map agent a_3: says where the platform is on the map, from a motion capture system whose readings it examines.
#pragma once
#include <array>
#include <cstdint>

#include "base/agent_images.hpp"
#include "base/motion.hpp"
#include "base/motion_capture_config.hpp"
#include "base/platform_transmission.hpp"

namespace mrroc::ecp {

/// Constant parameters of a_3.
struct MapParameters {
  MotionCaptureSetup capture;   ///< when it measures
  double position_sd{0.006};    ///< of its readings, along x and along y [m]
  double heading_sd{0.012};     ///< of its readings [rad]
  double trust{2};              ///< the estimate's standard deviations are taken as so many times as large
  double drift_position{0.01};  ///< and as larger by this [m]
  double drift_heading{0.01};   ///< [rad]
  double drift_speed{0.15};     ///< standard deviation of the estimate's speed [m/s]
  double drift_rate{0.1};       ///< and of its turn rate [rad/s]
  int rejections{2};            ///< in a row that agree with each other, which open the gate again
  std::int64_t timeout{25};  ///< without a plausible reading, after which the position is lost [macrosteps]
  int n_s{10};               ///< steps of a macrostep
};

/// Report::sensor of a_3 while the last plausible pose is valid.
inline constexpr int kMapSeen = 1;

/// Estimates of a_1 that are remembered.
inline constexpr std::size_t kEstimatesKept = 64;

/// c_c3
struct MapMemory {
  MapParameters k;                                        ///< constant during a run
  std::array<PlatformEstimate, kEstimatesKept> estimate;  ///< newest first; step 0: none
  std::int64_t looked_at{-1};   ///< step of the newest reading that has been examined
  MotionCapture believed;       ///< the newest reading that was plausible; not seen: none
  MotionCapture rejected;       ///< the newest one that was not; not seen: none since a plausible one
  int rejected_in_a_row{};      ///< readings up to that one that agree with each other
  std::int64_t plausible_in{};  ///< macrostep of the last plausible reading; 0: none yet
  MapReport report;             ///< what is said
};

/// x_cT and y_cT of a_3.
struct MapHeard : Order {
  PlatformEstimate estimate;  ///< T_x_c3,1[q~, q~']
  using Order::operator=;
};
struct MapSaid : Report {
  MapReport map;  ///< T_y_c3,1[x^, y^, phi^]
  using Report::operator=;
};

/// Images of a_3, which has no effector. V is the newest reading that is visible.
struct MapAgent {
  /// x: memory c, reading V, what is heard T.
  struct X {
    MapMemory c{};
    None e;
    MotionCapture V;
    MapHeard T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, report and pose T.
  struct Y {
    MapMemory c{};
    None e;
    None V;
    MapSaid T;
  };
};

/// @param estimate  of a_1 at the reading's step or near it
/// @return squared Mahalanobis distance of the reading from the estimate, with the uncertainties of both
[[nodiscard]] double distance(const MotionCapture& reading, const PlatformEstimate& estimate,
                              const MapParameters& k);
/// @param before  an older reading
/// @return the same distance of a reading from where an older one and the speeds of a_1 since then lead: what the estimate
///         is wrong by does not matter. Infinite: the older one was not seen, or a_1's speeds since then are not remembered
[[nodiscard]] double distance(const MotionCapture& reading, const MotionCapture& before, const MapMemory& c);
/// Periods of the motion capture system over which a reading that was believed is carried on.
inline constexpr std::int64_t kCarried = 3;
/// Beyond this a reading is implausible: 99.9 % of all are nearer, chi-squared with three degrees of freedom.
inline constexpr double kGate = 16.266;

/// The estimate of a_1 that is nearest to a step, carried on to it with its speeds. step 0: there is none
[[nodiscard]] PlatformEstimate estimate_at(const MapMemory& c, std::int64_t step);

extern const Motion<MapAgent> kLocate;        ///< m = 1: until nothing plausible has been seen for too long
extern const Motion<MapAgent> kPositionGone;  ///< m = 2: until a plausible reading comes

/// Locates the platform until the coordinator says that the task is over.
template <class Port>
Outcome run_map_program(MapAgent::X& x, Port& port) {
  Outcome o = Outcome::terminated;
  for (bool located = true; o == Outcome::terminated && !x.T.finished; located = !located)
    o = move(located ? kLocate : kPositionGone, x, port);
  return o;
}

}  // namespace mrroc::ecp
