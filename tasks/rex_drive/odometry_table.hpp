// odometry.csv: a row for every pair of pictures of a run: what visual odometry saw and measured, and what is true.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "base/odometry_support.hpp"
#include "tasks/rex_drive/drive_record.hpp"
#include "tasks/rex_drive/drive_table.hpp"

namespace mrroc::rex_drive {

/// One pair of pictures.
struct OdometryRow {
  double t{};                         ///< simulated time at which it was taken [s]
  OdometrySupport support{};          ///< what its motion rests on, and why there is none
  bool valid{};                       ///< a motion was measured; else the next three mean nothing
  PlanarPose motion{};                ///< of B since the pair before, in B of then
  PlanarCovariance covariance{};      ///< of its error
  std::optional<PlanarPose> truth{};  ///< the true motion; nothing: it is not known
  bool drives{};                      ///< a fragment was under way
};
using OdometryTable = std::vector<OdometryRow>;  ///< in the order of their times

/// @param drive  of the same messages @param dt  duration of a step [s] @param n_s  steps of a macrostep
/// @return a row for every pair of pictures; none without eyes
[[nodiscard]] OdometryTable join_odometry(const DriveMessages& messages, const DriveTable& drive, double dt,
                                          int n_s);

/// @return measured motion less the true one, along the true B of before; only where both are known
[[nodiscard]] std::optional<PlanarPose> motion_error(const OdometryRow& row);

/// Columns of the table of write_odometry_table(), as gnuplot counts them.
namespace odometry_column {
enum : int {
  t = 1,
  features = 4,
  matches = 5,
  inliers = 6,
  error = 17,       ///< of the place [mm]
  sd = 18,          ///< its standard deviation as the odometry says [mm]
  turn_error = 19,  ///< of the turn [mrad]
  turn_sd = 20      ///< its standard deviation [mrad]
};
}  // namespace odometry_column

/// Writes a row per pair; what is not known is nan. @throws FaultError cannot_write
void write_odometry_table(const std::filesystem::path& file, const OdometryTable& table);

}  // namespace mrroc::rex_drive
