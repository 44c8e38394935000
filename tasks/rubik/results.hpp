// Makes the tables and figures of a run.
#pragma once
#include <filesystem>
#include <vector>

#include "tasks/rubik/rubik_run.hpp"

namespace mrroc::rubik {

/// One turn of a face, for moves.csv.
struct TurnRow {
  int k{};            ///< 1, 2, ...
  Move turn;          ///< face and quarters
  double t_start{};   ///< the free motions to it begin [s]
  double t_end{};     ///< the hand that lets go has retreated [s]
  int attempts{};     ///< at m = 5
  double tool_deg{};  ///< turned by the tool
  double face_deg{};  ///< by the face, at the end of m = 5
  double
      behind_deg{};  ///< the face behind the tool, largest from half of the turn until its seat draws it in
  double slip_mm{};  ///< of the cube in the track arm's jaws during m = 5, largest
  double force_peak_N{};    ///< of x, y, z of the track arm in m = 5
  double torque_peak_Nm{};  ///< about z
  double force_std_N{};     ///< largest of the standard deviations of x, y and z
};

/// @param entry  of a cycle with a turn
/// @return its row, with number k
[[nodiscard]] TurnRow turn_of(const CycleRecord& entry, int k, const RunRecord& record,
                              const CubeRecord& cube);

/// @return a row for every turn that was begun
[[nodiscard]] std::vector<TurnRow> turns_of(const RunRecord& record, const CubeRecord& cube);

/// Writes `k,turn,t_start,t_end,attempts,tool_deg,face_deg,behind_deg,slip_mm,force_peak_N,torque_peak_Nm,
/// force_std_N`.
/// @throws FaultError cannot_write
void write_turns(const std::filesystem::path& file, const std::vector<TurnRow>& turns);

/// @return figures of the run as far as they can be told; keys and meaning in figure_info.hpp
[[nodiscard]] mp::Figures figures_of(const RunRecord& record, const CubeRecord& cube,
                                     const std::vector<TurnRow>& turns);

/// Writes moves.csv, cube_start.txt and cube_end.txt, and cube_read.txt when the cube was read.
/// @throws FaultError cannot_write
mp::Figures write_results(const std::filesystem::path& folder, const RunRecord& record,
                          const CubeRecord& cube);

}  // namespace mrroc::rubik
