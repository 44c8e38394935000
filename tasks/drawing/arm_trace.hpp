// The table of an arm's run: arm1.csv, arm2.csv.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/spatial.hpp"

namespace mrroc::drawing {

/// One macrostep of one arm.
struct ArmRow {
  std::int64_t i{};               ///< macrostep
  double t{};                     ///< simulated time at its end [s]
  int m{};                        ///< behaviour, MS tables 1-4
  Vector6 pose{Vector6::Zero()};  ///< of E in the arm's base: x, y, z [m], angle-axis [rad]
  Wrench F{};                     ///< F_a in E: x, y, z [N], moments [N m]
  double gap{};                   ///< of the gripper's jaws [m]
  bool blocked{};                 ///< whether the jaws hold something
};

using ArmTrace = std::vector<ArmRow>;

/// Writes `i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked`, a row per macrostep.
/// @throws DrawingError  if the file cannot be written or a number is not finite
void write_arm_trace(const std::filesystem::path& file, const ArmTrace& trace);

/// Reads what write_arm_trace writes.
/// @throws DrawingError  naming file and line
[[nodiscard]] ArmTrace read_arm_trace(const std::filesystem::path& file);

}  // namespace mrroc::drawing
