// The main of a task whose arms work on their own in the simulated cell: everything but the task itself.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "mp/run_folder.hpp"
#include "mp/solo_run.hpp"
#include "sim/cell_parts.hpp"

namespace mrroc::sim {

/// One picture of a run.
struct Picture {
  std::string name;    ///< file in plots/ without .png
  std::string script;  ///< gnuplot, run in the run folder; terminal and output are set before
};

/// A virtual sensor that every arm of a task has: process vsp-NAME-ARM, program vsp_NAME, channel ARM.NAME.
struct Receptor {
  std::string name;  ///< NAME of program and channel
  /// What its process does.
  link::PartBody body;
  /// Reads its parameters once, so that a wrong one is found before anything starts. May be empty.
  std::function<void(const Config&)> read{};
};

/// What a task is.
struct ArmTask {
  std::string name;                            ///< the program; `ecp_NAME` is its control subsystem
  std::string about;                           ///< for --help
  std::string_view config;                     ///< its TOML file
  std::vector<mp::BehaviourWords> behaviours;  ///< m = 1, 2, ...
  link::PartBody ecp;                          ///< body of the ECP of each arm
  /// Reads the task's own parameters once, so that a wrong one is found before anything starts. May be empty.
  std::function<void(const Config&)> read{};
  /// Figures for summary.json and the table at the end, from the rows of all arms.
  std::function<mp::TaskFigures(const std::vector<mp::ArmTrace>&, const Config&)> figures{};
  /// Pictures, which read arm1.csv and so on. May be empty.
  std::function<std::vector<Picture>(const std::vector<mp::ArmTrace>&, const Config&)> pictures{};
  /// What the run is for, in words, for the end of the output. May be empty.
  std::function<std::string(const std::vector<mp::ArmTrace>&)> result{};
  mp::Coordinate*
      coordinate{};  ///< what the arms are told of one another; null: nothing, the coordinator is dormant
  int n_s{10};       ///< steps of a macrostep, as the rows command it; all arms have the same
  std::vector<CellArm> arms{{"arm1", "irb6_postument"}};  ///< keys and kinematics
  std::vector<Receptor> receptors{};                      ///< the ECP says whose readings are its x_cV
};

/// @return the force of arm 1 along an axis of E over time, like MG fig. 16, and the force desired [N]
std::vector<Picture> force_picture(Axis axis, double desired);
/// The same for ArmTask::pictures.
template <Axis axis, int desired>
std::vector<Picture> force_picture(const std::vector<mp::ArmTrace>&, const Config&) {
  return force_picture(axis, desired);
}

/// Draws them as plots/NAME.png, and says so when gnuplot cannot.
/// @param folder  of the run, with the tables
void draw(const std::filesystem::path& folder, const std::vector<Picture>& pictures);

/// Reads the command line, runs the task, leaves the run folder.
/// @return exit status
int run_arm_task(const ArmTask& task, int argc, char** argv);

/// @return what the rows of a table say about themselves, in their order
template <class Rows>
std::vector<mp::BehaviourWords> words_of(const Rows& rows) {
  std::vector<mp::BehaviourWords> words;
  for (const auto& row : rows) words.push_back({std::string(row.name), std::string(row.until)});
  return words;
}

}  // namespace mrroc::sim
