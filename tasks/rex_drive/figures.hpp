// The figures of a run of the platform: their values, their meaning and their bounds.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/ground_area.hpp"
#include "base/room_config.hpp"
#include "mp/figure_table.hpp"
#include "tasks/rex_drive/drive_case.hpp"
#include "tasks/rex_drive/drive_table.hpp"
#include "tasks/rex_drive/odometry_table.hpp"

namespace mrroc::rex_drive {

/// What figures and pictures are made of.
struct DriveResults {
  DriveTable table;                 ///< a row per macrostep
  OdometryTable odometry;           ///< a row per pair of pictures
  FragmentTable fragments;          ///< a row per fragment
  std::vector<Plan> plans;          ///< as they were sent
  std::int64_t acked_in{};          ///< macrostep in which a_1 gave the last plan's ack; 0: it did not
  std::vector<double> map_returns;  ///< when a map that had been lost was back, or had jumped [s]
  std::int32_t rejected{};          ///< readings of the motion capture that the map agent did not believe
  std::vector<std::int32_t> iterations;  ///< of the planner's search, one per fragment
  Room room;                             ///< in which it drove
  DriveGround ground;                    ///< on which it drove
};

/// @return figures; those that a run cannot have are missing, errors of a friction that the estimator itself is unsure of are
///         not a number. "While it drives" is while a fragment is under way, and true
///         is what the simulation tells.
///   track_rms_mm, track_max_mm        true place against the reference, while it drives
///   pivot_rms_mm                      the same during turns on the spot
///   estimate_rms_mm, estimate_max_mm  true place against the estimate, while it drives
///   ellipse_95_pct                    how often the true place is within the estimate's 95 % ellipse
///   end_error_mm                      true place at last against the end of the last plan, when it was acknowledged
///   return_kick_mps                   change of the speed less that of the reference, within 0.2 s after a map that was lost
///                                     is back and can act, which takes two macrosteps, while it drives
///   friction_err                      mean of the second half against the mean of what is true
///   split_err                         the same of the split
///   split_rms                         its error in the second half, root of the mean square: over ground that differs left
///                                     and right its sign changes with the direction, and cancels in the means
///   friction_found_s                  after the ground changes by a quarter: until the estimates along and across
///                                     are within 10 %, the split within 0.1, and stay there for a second, or until it
///                                     changes again or the drive ends
///   joint_speed_pct                   least true speed at the end of a fragment that is passed at speed, of the planned one;
///                                     not until 1 s after full pace can have come back from a pause
///   plan_joint_speed_pct              the same where one plan goes on into the next
///   ack_before_rest_s                 from the last ack until the platform stands
///   speed_mean_mps, speed_max_mps     true, while it drives
///   drive_s, way_m                    time and way, while it drives
///   planner_iterations_p95            of the search for a fragment
///   late_map                          positions older than the estimator's window, from the beginning of the drive on
///   late_odometry                     readings of the odometry older than that
///   map_rejected, solver_failures     counts
///   odometry_...                      see odometry_figures()
[[nodiscard]] mp::Figures figures_of(const DriveResults& results);

/// In the order of the table, with what is wanted of a drive like the built-in one (DriveCase::usual).
inline constexpr std::array kFigures{
    mp::FigureInfo{
        .key = "track_rms_mm", .words = "distance from the reference", .unit = "mm rms", .high = 10},
    mp::FigureInfo{.key = "track_max_mm", .words = "  at most", .unit = "mm", .high = 40},
    mp::FigureInfo{.key = "pivot_rms_mm", .words = "  turning on the spot", .unit = "mm rms", .high = 10},
    mp::FigureInfo{
        .key = "estimate_rms_mm", .words = "distance from the estimate", .unit = "mm rms", .high = 8},
    mp::FigureInfo{.key = "estimate_max_mm", .words = "  at most", .unit = "mm"},
    mp::FigureInfo{
        .key = "ellipse_95_pct", .words = "  within its 95 % ellipse", .unit = "% of the time", .low = 80},
    mp::FigureInfo{
        .key = "end_error_mm", .words = "distance from the end of the plan", .unit = "mm", .high = 50},
    mp::FigureInfo{.key = "return_kick_mps", .words = "kick when the map is back", .unit = "m/s"},
    mp::FigureInfo{.key = "friction_err", .words = "error of the friction", .unit = ""},
    mp::FigureInfo{.key = "split_err", .words = "error of its split left and right", .unit = ""},
    mp::FigureInfo{.key = "split_rms", .words = "  at any time", .unit = "rms"},
    mp::FigureInfo{.key = "friction_found_s", .words = "until a change of it is found", .unit = "s"},
    mp::FigureInfo{.key = "joint_speed_pct",
                   .words = "least speed between fragments",
                   .unit = "% of the planned",
                   .low = 90},
    mp::FigureInfo{.key = "plan_joint_speed_pct",
                   .words = "least speed between plans",
                   .unit = "% of the planned",
                   .low = 85},
    mp::FigureInfo{.key = "ack_before_rest_s", .words = "last ack before it stands", .unit = "s", .low = 0.5},
    mp::FigureInfo{.key = "speed_mean_mps", .words = "speed", .unit = "m/s"},
    mp::FigureInfo{.key = "speed_max_mps", .words = "  at most", .unit = "m/s"},
    mp::FigureInfo{.key = "way_m", .words = "way", .unit = "m"},
    mp::FigureInfo{.key = "drive_s", .words = "  in", .unit = "s"},
    mp::FigureInfo{
        .key = "planner_iterations_p95", .words = "iterations of the planner, 95 %", .unit = "", .high = 6},
    mp::FigureInfo{
        .key = "odometry_valid_pct", .words = "pairs of pictures with a motion", .unit = "%", .low = 95},
    mp::FigureInfo{.key = "odometry_pairs", .words = "  pairs", .unit = ""},
    mp::FigureInfo{.key = "odometry_invalid", .words = "  of them without one", .unit = ""},
    mp::FigureInfo{.key = "odometry_inliers", .words = "  points that agree on one", .unit = ""},
    mp::FigureInfo{.key = "odometry_rms_mm", .words = "error from pair to pair", .unit = "mm rms"},
    mp::FigureInfo{.key = "odometry_turn_rms_mrad", .words = "  of the turn", .unit = "mrad rms"},
    mp::FigureInfo{.key = "odometry_95_pct", .words = "  within its 95 % ellipsoid", .unit = "% of pairs"},
    mp::FigureInfo{
        .key = "odometry_drift_pct", .words = "drift over 2 m", .unit = "% of the way", .high = 0.5},
    mp::FigureInfo{.key = "late_odometry", .words = "motions that came too late", .unit = ""},
    mp::FigureInfo{.key = "map_rejected", .words = "positions not believed", .unit = ""},
    mp::FigureInfo{.key = "late_map", .words = "positions that came too late", .unit = ""},
    mp::FigureInfo{.key = "solver_failures", .words = "failures of solvers", .unit = "", .high = 0},
    mp::FigureInfo{.key = "stop_steps_max",
                   .words = "steps until the platform was at rest",
                   .unit = "",
                   .high = 300,
                   .always = true},
};

/// @return says of a drive of which little is wanted what that is; empty of others
[[nodiscard]] std::string wanted_only(DriveCase drive);

/// @return kFigures with what is wanted of such a drive, which is less than of the usual one: the more the ground or the
///         speed asks of the platform, the farther it may be from its reference; what happens between fragments depends on the
///         user's plan; that a stop is short is wanted where the ground can do it and the speed is the usual one; of
///         DriveCase::other nothing is wanted but that planner and solvers do their work
[[nodiscard]] std::vector<mp::FigureInfo> figures_of_case(DriveCase drive);

}  // namespace mrroc::rex_drive
