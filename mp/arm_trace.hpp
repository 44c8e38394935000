// The table of an arm's run: arm1.csv, arm2.csv.
#pragma once
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "base/spatial.hpp"
#include "mp/figure_table.hpp"

namespace mrroc::mp {

/// One macrostep of one arm.
struct ArmRow {
  std::int64_t i{};               ///< macrostep
  double t{};                     ///< simulated time at its end [s]
  int m{};                        ///< behaviour, MS tables 1-4
  Vector6 pose{Vector6::Zero()};  ///< of E in the arm's base: x, y, z [m], angle-axis [rad]
  Wrench F{};                     ///< F_a in E: x, y, z [N], moments [N m]
  /// Largest F_a along and about each axis in the steps since the row before; nothing: the steps are not known. Not
  /// in the table.
  std::optional<Wrench> F_most{};
  double gap{};    ///< of the gripper's jaws [m]
  bool blocked{};  ///< whether the jaws hold something
};

using ArmTrace = std::vector<ArmRow>;  ///< a row per macrostep, in order

/// @param m     behaviours that count
/// @return largest F_a along or about an axis of E, of every step where the steps are known [N], [N m]; NaN without a
///         row
[[nodiscard]] double largest_force(const ArmTrace& trace, Axis axis, std::initializer_list<int> m);
/// @param last  time at the end of behaviour m that counts [s]
/// @return mean F_a along or about an axis of E [N], [N m]; NaN without a row
[[nodiscard]] double mean_force(const ArmTrace& trace, Axis axis, int m, double last);

/// Writes `i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked`, a row per macrostep.
/// @throws FaultError cannot_write; FileError  a number is not finite
void write_arm_trace(const std::filesystem::path& file, const ArmTrace& trace);

/// Reads what write_arm_trace writes.
/// @throws FileError  naming file and line
[[nodiscard]] ArmTrace read_arm_trace(const std::filesystem::path& file);

}  // namespace mrroc::mp
