// The true state of the cube during a run, for tables and figures.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "base/pose.hpp"
#include "mrroc/cube_truth_t.hpp"

namespace mrroc::rubik {

/// One macrostep.
struct CubeRow {
  std::int64_t i{};  ///< at whose beginning this was so
  Pose T_UC;         ///< in the world
  std::array<Vector3, 2> in_hand{Vector3::Zero(),
                                 Vector3::Zero()};  ///< its middle in E, as the hands truly are [m]
  std::string facelets;                             ///< U R F D L B
  double angle{};                                   ///< of the layer that is farthest from its seat [rad]
  double squeeze{};                                 ///< largest force of a pad or palm on it [N]
  bool on_floor{};                                  ///< it touched the floor then
};

/// Collects the simulator's messages. Used by MP's thread.
class CubeRecord {
 public:
  /// Make this before the process assembles.
  explicit CubeRecord(link::Process& process) : in_(process.inbox<cube_truth_t>("cube.truth")) {}
  /// Takes what has come; to be called in every macrostep.
  void collect();
  /// @return a row per macrostep of which a message has come, in order
  [[nodiscard]] const std::vector<CubeRow>& rows() const { return rows_; }
  /// @return the row of macrostep i or the nearest one before it; null: there is none
  [[nodiscard]] const CubeRow* at(std::int64_t i) const;

 private:
  std::unique_ptr<link::Inbox<cube_truth_t>> in_;
  std::vector<CubeRow> rows_;
};

}  // namespace mrroc::rubik
