// What a run tells of box and platforms, as a table: box.csv.
#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/link/process.hpp"
#include "base/msg/convert_platform.hpp"
#include "tasks/box_push/formation.hpp"

namespace mrroc::box_push {

/// What the coordinator does in a macrostep.
struct PushStage {
  std::int64_t macrostep{};  ///< its number
  int m{};                   ///< behaviour
  int push{};                ///< number of the push, from 1; 0: before the first one
};

/// One macrostep of the simulation.
struct PushRow {
  PushStage stage{};                              ///< the coordinator's
  BoxTruth box{};                                 ///< what is true of the box
  std::array<PlanarPose, kPlatforms> platform{};  ///< true places
  std::array<double, kPlatforms> torque{};        ///< sums of the true torques of the wheels [N m]
};
using PushTable = std::vector<PushRow>;  ///< a row per macrostep, in order

/// Columns of the table of write_push_table(), as gnuplot counts them: the first of each group.
namespace column {
enum : int {
  box = 4,        ///< x, y, phi
  box_push = 7,   ///< force along x and y of the box, moment
  error = 10,     ///< distance from the goal [mm], turn from it without jumps [degrees]
  platforms = 12  ///< of each: x, y, phi, sum of the torques
};
}  // namespace column

/// Writes a row per macrostep; numbers are SI, angles rad unless the name says something else.
/// @param goal  of the box  @param macrostep  duration [s]  @throws FaultError cannot_write
void write_push_table(const std::filesystem::path& file, const PushTable& table, const PlanarPose& goal,
                      double macrostep);

/// Collects what the simulation tells. Used by MP's thread.
class PushRecord {
 public:
  /// Make this before the process assembles.
  explicit PushRecord(link::Process& process);

  /// Takes what has come; to be called in every macrostep.
  void collect(const PushStage& stage);
  /// @param last  macrostep: what comes later differs from run to run @return a row for every macrostep to that one
  [[nodiscard]] PushTable table(std::int64_t last) const;

 private:
  std::unique_ptr<link::Inbox<box_truth_t>> box_in_;
  std::array<std::unique_ptr<link::Inbox<platform_truth_t>>, kPlatforms> truth_in_;
  std::vector<box_truth_t> boxes_;
  std::array<std::vector<platform_truth_t>, kPlatforms> truths_;
  std::vector<PushStage> stages_;
};

}  // namespace mrroc::box_push
