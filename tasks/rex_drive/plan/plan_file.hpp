// Plans of a run: points of the map that the platform is to pass one after another, from a file or built in.
//
//   # comment
//   start 0 0 1.57     where the platform stands at the beginning: x y [m], phi [rad]; only as the first line
//   0.5 0.2            x y on the map [m]
//   1.0 0.4
//   plan               the next plan begins
//   1.5 0.4
//   1.8 0.9
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/platform_transmission.hpp"

namespace mrroc::rex_drive {

/// A point of the map.
struct MapPoint {
  double x{};  ///< [m]
  double y{};  ///< [m]
  int line{};  ///< of the file, counted from 1; 0: of no file

  friend bool operator==(const MapPoint&, const MapPoint&) = default;
};

/// Points of one plan, in the order in which they are to be passed.
using MapPoints = std::vector<MapPoint>;

/// The plans of a run.
struct PlanList {
  std::string name{};              ///< of the file or of the built-in plan, for the operator
  PlanarPose start{};              ///< where the platform stands at the beginning
  int start_line{};                ///< of the file, which says so; 0: none
  std::vector<MapPoints> plans{};  ///< at least one, each with 1..kPointsOfPlan points

  /// @return the points of all of them
  [[nodiscard]] std::size_t points() const;
};

/// Most points of one plan: the message has room for the next one's beginning.
inline constexpr std::size_t kPointsOfPlan = kPlanPoints - kPlanAhead;
/// Points nearer to the one before them are the same point [m].
inline constexpr double kSamePoint = 0.05;
/// Most points of all plans of a run.
inline constexpr std::size_t kMostPoints = 10'000;

/// Reads plans from the text of a file; a UTF-8 byte order mark before it is left out. A plan of more than
/// kPointsOfPlan points is cut into several of the same size.
/// @param name  of the file, for errors
/// @throws FaultError  bad_plan with the line: no two numbers, not finite, beyond 1 km, too few or too many points, points that are
///         all the same, `start` elsewhere than in the first line
[[nodiscard]] PlanList parse_plans(std::string_view text, const std::string& name);
/// Reads a plan file. @throws FaultError  bad_plan: missing, a folder, too large, empty; as parse_plans()
[[nodiscard]] PlanList load_plans(const std::filesystem::path& file);

/// @return the text of a plan file with these plans; its first comment is their name
[[nodiscard]] std::string to_text(const PlanList& plans);

/// Says what is in the way of the platform on the straight line between two points; empty: nothing.
/// @param to  the same as `from`: whether the platform can stand there
using LegCheck = std::function<std::string(const MapPoint& from, const MapPoint& to)>;
/// Looks at the start. @throws FaultError  bad_plan with its line: it is not free
void check_start(const PlanList& plans, const LegCheck& check);
/// Looks at every leg. @throws FaultError  bad_plan with the line of the point at the end of a leg that is not free
void check_legs(const PlanList& plans, const LegCheck& check);

/// @param speed  wanted [m/s]
/// @return the plans as the ontology agent sends them, numbered from 1. A plan that another one follows without a turn on
///         the spot knows how that one begins
[[nodiscard]] std::vector<Plan> to_messages(const PlanList& plans, double speed);

}  // namespace mrroc::rex_drive
