// The coordinator's means of planning: the believed cell, a planner of motions in it, and a solver of cubes.
#pragma once
#include <cstdio>
#include <optional>

#include "base/camera_config.hpp"
#include "tasks/rubik/cell/belief.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/rubik_run.hpp"
#include "tasks/rubik/solver/table_progress.hpp"

namespace mrroc::rubik {

/// Settings of a run, from its configuration.
struct RunSetup {
  Parameters k;                       ///< of the coordinator
  std::optional<CameraSetup> camera;  ///< to which faces are shown; none: the state of the cube is told
  CellBelief belief;                  ///< arms, cube and what stands around them
  TableSet tables{};                  ///< of the solver
};

/// Reads all of it, and what the arms' agents will read.
/// @throws ConfigError; FaultError bad_configuration
[[nodiscard]] RunSetup read_setup(const Config& config);

/// Plans and solves. Used by one thread at a time.
class PlanningContext {
 public:
  /// Opens the solver's tables, which may have to be made: it shows on standard error how that goes on.
  explicit PlanningContext(const RunSetup& setup);

  /// @return the same for a run of the coordinator; this object must outlive it
  [[nodiscard]] PlannerServices services();

 private:
  /// Plans when faces are shown at one place.
  struct Planning {
    Planning(const CellBelief& belief, const std::optional<Viewing>& viewing)
        : cell(belief, viewing), planner(cell) {}
    CubePlanCell cell;
    Planner planner;
  };
  [[nodiscard]] Solution solve(const Cube& cube) const;
  [[nodiscard]] Planned plan_reading(const PlanStart& start, int reading);

  TableProgress progress_{stderr};
  CellBelief belief_;
  std::optional<CameraSetup> camera_;
  Planning planning_;
  CubeSolver solver_;
};

}  // namespace mrroc::rubik
