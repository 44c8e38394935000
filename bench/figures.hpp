// Figures that a benchmark has measured, and the groups of benchmarks.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace mrroc::bench {

/// One figure: a key that scripts rely on (docs/interfaces.md) and what the table says about it.
struct Figure {
  std::string key;    ///< such as "rebuild_s"; unique
  double value{};     ///< in the unit
  std::string unit;   ///< such as "s"; empty: a number
  std::string about;  ///< what was measured, for the table
};
using Figures = std::vector<Figure>;  ///< in the order of the table

/// Step of the effector driver, kinematics, force measurement, the tasks press and edge_follow. Takes about a
/// minute.
Figures run_edp_group();
/// Signing and checking one message; in the group edp.
/// @throws FaultError internal_error
Figure sign_figure();
/// Both algorithms of the servo over motor friction, in contact and in free motion. Takes about a minute.
/// @param plots folder for the picture servo.png and its script; empty: none
/// @throws FaultError cannot_write, internal_error
Figures run_servo_group(const std::filesystem::path& plots);
/// The task move: 1,000 random files on the simulated arms. Takes some minutes.
Figures run_trajectory_group();
/// The predicted limit of stable contact against the time domain; in the groups edp and stability.
Figure stability_limit_figure();
/// Predicted against simulated limits of stable contact. Takes some minutes.
/// @param plots folder for the picture stability_arm.png, its table and script; empty: none
Figures run_stability_group(const std::filesystem::path& plots);
/// Pictures of the simulated cell: their time, the receptors' accuracy, adverse pictures, calibration; the visual
/// servoing task. Takes about ten minutes, most of it for ten thousand adverse pictures and OpenCV's detector.
/// @throws FaultError no_renderer
Figures run_vision_group();
/// Runs the drawing task several times in separate processes, and kills its parts. Takes about a minute.
/// @throws FaultError a run did not do what it should
Figures run_drawing_group();

/// The pen-state sensor in 300 drawings over tremors, hands and papers, in one thread. Takes ten minutes.
/// @param plots folder for the picture pen_state.png and its table; empty: none
/// @throws FaultError a driver refused to start
Figures run_pen_state_group(const std::filesystem::path& plots);
/// The drawing task over the stiffness of paper and hand: worst figures. Takes about a minute.
Figures run_robustness_group();
/// The task guide over its fixtures and over hands: worst figures. Takes some minutes.
Figures run_guide_group();
/// Pairs of master and slave: 200 predictions, 500 random channels, and 21 runs of the task haptic. Takes some minutes.
Figures run_haptic_group();
/// The task ball with 100 seeds over masses, frictions, sizes, stiffnesses and places. Takes some minutes.
Figures run_ball_group();
/// The task calibrate_cell in 50 cells whose bases, balls and sensors are drawn. Takes a quarter of an hour.
Figures run_calibrate_cell_group();
/// The trajectory planner of a platform on 1,000 random plans. Takes some seconds.
Figures rex_planner_figures();
/// Visual odometry in 20 rooms: its drift and its work; and in rooms and with cameras that nobody tuned it to. Takes four minutes.
/// @throws FaultError no_renderer
Figures rex_odometry_figures();
/// Kernels of the platform Rex along a figure eight, in process. Takes some seconds. Only where that platform is built.
/// @throws FaultError internal_error: it is not followed to its end
Figures rex_kernel_figures();
/// Runs the visual servoing task several times in separate processes; part of the group vision. Takes about two minutes.
/// @throws FaultError a run did not do what it should
Figures visual_servo_figures();
/// Solvers of the cube, with default and with large tables. Takes about two minutes, and some more to make the tables
/// when they are not in the cache.
/// @throws FaultError a solution is wrong
Figures run_solver_group();
/// Turns of a face of the cube by two arms. Takes some minutes.
/// @throws FaultError a driver refused to start
Figures run_cube_group();
/// Plans of grasps for solutions of 100 cubes, beside the original's fixed table; the meeting place
/// beside the best one that a search finds. Takes about two minutes.
/// @throws FaultError a plan is wrong, or there is none
Figures run_plan_group();
/// The task of the cube over twenty seeds, in separate processes. Takes an hour. Summaries are kept in
/// runs/bench-rubik below the working directory.
/// @param resume  cubes whose summary is there already are not solved again
/// @throws FaultError start_failed, cannot_write
Figures run_rubik_group(bool resume);
/// The platform's task on named grounds and plans, in 100 plants that its driver does not know, with adaptation and
/// without; its planner, its kernels. Takes a quarter of an hour.
/// @throws FaultError start_failed; internal_error: a run on a named ground did not end well
/// @param plots folder for the picture algorithms.png and its table; empty: none
Figures run_rex_group(const std::filesystem::path& plots);
/// The platform at 0.8 m/s: each of its processes killed, and stops that the operator orders, at 50 random moments each.
/// Takes ten minutes.
/// @throws FaultError start_failed; internal_error: a run did not begin, or left no summary
Figures run_rex_stops_group();
/// The platform's visual odometry, and its task with eyes. Takes a quarter of an hour.
/// @throws FaultError start_failed; no_renderer; internal_error: a run on a named ground did not end well
Figures run_rex_eyes_group();
/// Two platforms push a box, with twenty seeds. Takes two minutes. Only where the platform Rex is built.
/// @throws FaultError start_failed; internal_error: a run left no summary
Figures run_box_group();
/// Small errors in the framework, one at a time, and whether a test notices them: a sample of all areas. Takes hours.
/// @param resume  what the last sample has found is not tried again
/// @throws FaultError start_failed: a test fails without an error, or universalmutator cannot be installed
Figures run_mutation_group(bool resume);
/// The documents' commands, viewer, recomputed logs, latencies of keys, a fresh clone, a rebuild. Takes half an hour.
/// @throws FaultError cannot_write, start_failed, no_such_session, peer_silent
Figures run_operator_group();

}  // namespace mrroc::bench
