// Runs a task whose arms work on their own; the task gives its name, behaviours and program.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "launch/evaluation.hpp"
#include "launch/force_picture.hpp"
#include "launch/task.hpp"

namespace mrroc::launch {

/// Definition of a task.
struct ArmTask {
  std::string name;                            ///< the program; `ecp_NAME` is its control subsystem
  std::string about;                           ///< for --help
  std::string_view config;                     ///< its TOML file
  std::vector<mp::BehaviourWords> behaviours;  ///< m = 1, 2, ...
  link::NodeMain ecp;                          ///< body of the ECP of each arm
  /// Reads the task's own parameters once, so that a wrong one is found before anything starts. May be empty.
  std::function<void(const Config&)> read{};
  /// As in Evaluation; all may be empty.
  std::function<mp::TaskFigures(const std::vector<mp::ArmTrace>&, const Config&)> figures{};
  std::function<std::vector<Picture>(const std::vector<mp::ArmTrace>&, const Config&)> pictures{};
  std::function<std::string(const std::vector<mp::ArmTrace>&)> result{};
  mp::Coordinate*
      coordinate{};  ///< what the arms are told of one another; null: nothing, the coordinator is dormant
  std::function<std::unique_ptr<mp::OperatorAgent>(mp::TaskRun&, bool gives_start)>
      make_operator{};  ///< as in mp::SoloParameters
  int n_s{10};          ///< steps of a macrostep, as the rows command it; all arms have the same
  std::vector<CellArm> arms{{"arm1", "irb6_postument"}};  ///< keys and kinematics
  std::vector<Receptor> receptors{};                      ///< the ECP says whose readings are its x_cV
};

/// @return the same for run_task(): the coordinator is mp::SoloRun
[[nodiscard]] Task task_of(const ArmTask& task);

/// run_task(task_of(task), argc, argv)
int run_arm_task(const ArmTask& task, int argc, char** argv);

}  // namespace mrroc::launch
