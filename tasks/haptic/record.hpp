// What a coupled pair does, macrostep by macrostep: haptic.csv, from which figures and pictures are made.
#pragma once
#include <filesystem>
#include <vector>

#include "tasks/haptic/haptic.hpp"

namespace mrroc::haptic {

/// One macrostep in which the arms are coupled, as the coordinator sees it: reports are two macrosteps old.
struct HapticRow {
  double t{};                    ///< of the readings [s]
  Vector3 x_m{Vector3::Zero()};  ///< way of the master [m]
  Vector3 x_s{Vector3::Zero()};  ///< way of the slave [m]
  Vector3 F_m{
      Vector3::
          Zero()};  ///< that the hand feels: against what it exerts on the master, in the sense of F_s [N]
  Vector3 F_s{Vector3::Zero()};  ///< that the slave exerts [N]
  double E_m{};                  ///< energy of the observer at the master's port [J]
  double E_s{};                  ///< and at the slave's [J]
  double kept{};                 ///< energy that both controllers have kept back so far [J]
  double age{};                  ///< of what the slave knows of the master [s]
};
using HapticRecord = std::vector<HapticRow>;  ///< in the order of time

/// Adds a row while the arms are coupled. @param m  behaviour of the coordinator
void note(HapticRecord& record, int m, const Coordinator::X& x);

/// File of the run folder.
inline constexpr const char* kRecordFile = "haptic.csv";

/// Columns of the file, as gnuplot counts them: the first of each group.
namespace column {
enum : int { t = 1, x_m = 2, x_s = 5, F_m = 8, F_s = 11, E_m = 14, E_s = 15, kept = 16, age = 17 };
}  // namespace column

/// Writes ways in mm, forces in N, energies in mJ, ages in ms. @throws FaultError cannot_write
void write_record(const std::filesystem::path& file, const HapticRecord& record);

}  // namespace mrroc::haptic
