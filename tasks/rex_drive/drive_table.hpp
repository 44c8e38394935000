// platform.csv and fragments.csv: a row for every macrostep of a run, and one for every fragment that was handed over.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/platform_command.hpp"
#include "base/platform_transmission.hpp"

namespace mrroc::rex_drive {

/// One macrostep of the platform. Everything is of the same reading.
struct DriveRow {
  std::int64_t step{};             ///< of the reading
  double t{};                      ///< simulated time of it [s]
  PlanarPose reference;            ///< where B is to be
  PlatformTruth truth;             ///< what is true
  PlatformEstimate estimate;       ///< what the estimator says
  Slip slip;                       ///< estimated
  Slip slip_sd{0, 0, 0};           ///< standard deviations
  PerWheel torque{};               ///< commanded [N m]
  double pace{1};                  ///< of the fragment's time as commanded, 0 stands .. 1 as planned
  std::int64_t executing{};        ///< number of the fragment under way; 0: none
  std::int64_t notified{};         ///< number of the last one that has reached its notify; 0: none
  std::int32_t remaining{};        ///< iterations to the end of what has been handed over
  bool at_rest{};                  ///< the driver says so
  std::int32_t solver_failures{};  ///< so far
  std::int32_t late_map{};         ///< map poses that came too late, so far
  std::int32_t late_odometry{};    ///< readings of the odometry that did, so far
};
using DriveTable = std::vector<DriveRow>;  ///< a row per macrostep, in order

/// One fragment that was handed over.
struct FragmentRow {
  Fragment fragment;         ///< as it was sent
  std::int64_t handed_in{};  ///< macrostep for which it was sent
  std::int64_t plan{};       ///< number of its plan
};
using FragmentTable = std::vector<FragmentRow>;  ///< in the order of their numbers

/// @return distance of the true place from the reference [m]
[[nodiscard]] double tracking_error(const DriveRow& row);
/// @return distance of the true place from the estimate [m]
[[nodiscard]] double estimation_error(const DriveRow& row);
/// @return whether the platform turns on the spot all through the fragment
[[nodiscard]] bool is_pivot(const Fragment& fragment);

/// Friction of the ground below the wheels, in the form of the estimate.
[[nodiscard]] Slip true_slip(const PlatformTruth& truth);

/// Columns of the table of write_drive_table(), as gnuplot counts them: the first of each group.
namespace column {
enum : int {
  x_d = 2,         ///< reference: x, y, phi
  x = 5,           ///< true: x, y, phi
  v_x = 8,         ///< true: vx, vy, w
  x_e = 11,        ///< estimate: x, y, phi
  mu_x = 18,       ///< estimated: mu_x, mu_y, split
  sd_mu_x = 21,    ///< their standard deviations
  true_mu_x = 24,  ///< true: mu_x, mu_y, split
  tau = 27,        ///< torques of the wheels
  load = 31,       ///< their loads
  track = 35,      ///< distance from the reference [mm]
  estimate = 36    ///< distance from the estimate [mm]
};
}  // namespace column

/// Writes a row per macrostep; numbers are SI, angles rad. @throws FaultError cannot_write
void write_drive_table(const std::filesystem::path& file, const DriveTable& table);
/// Writes a row per fragment: when it was handed over, begun and ended, the speeds at its end, and when the driver was ready
/// for the next one. @throws as before
void write_fragment_table(const std::filesystem::path& file, const FragmentTable& fragments,
                          const DriveTable& table);

/// When the driver executed a fragment; not a number: it did not.
struct Stay {
  double ready{std::numeric_limits<double>::quiet_NaN()};  ///< it was ready for the next one: notify [s]
  double begun{std::numeric_limits<double>::quiet_NaN()};  ///< [s]
  double ended{std::numeric_limits<double>::quiet_NaN()};  ///< [s]
  double speed{std::numeric_limits<double>::quiet_NaN()};  ///< true speed at its end [m/s]
};
/// @return of each fragment, by number - 1
[[nodiscard]] std::vector<Stay> stays(const FragmentTable& fragments, const DriveTable& table);

}  // namespace mrroc::rex_drive
