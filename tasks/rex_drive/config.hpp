// Everything that the task reads from the configuration, and what its programs have in common.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "base/link/clocked_inbox.hpp"
#include "tasks/rex_drive/images.hpp"
#include "tasks/rex_drive/ontology.hpp"
#include "tasks/rex_drive/plan/plan_file.hpp"
#include "tasks/rex_drive/planner/survey.hpp"

namespace mrroc::rex_drive {

/// @return the task's built-in configuration, tasks/rex_drive/rex_drive.toml
std::string_view config();
/// @return the pair of cameras of `task.eyes`, tasks/rex_drive/eyes.toml
std::string_view eyes();

/// Farthest part of the platform from its middle, with a reserve [m].
inline constexpr double kReach = 0.55;

/// @return [task] of a_1 @throws ConfigError
[[nodiscard]] Parameters read_parameters(const Config& config);
/// @return speed wanted between the points, task.speed [m/s] @throws ConfigError
[[nodiscard]] double read_speed(const Config& config);
/// @return [task] of a_2 @throws ConfigError
[[nodiscard]] OntologyParameters read_ontology(const Config& config);

/// @return when the visual odometry measures; nothing when `task.eyes` is false
/// @throws ConfigError; FaultError bad_configuration: pictures are not taken at macrosteps
[[nodiscard]] std::optional<link::SensorClock> read_eyes(const Config& config);

/// The plans of a run and what the planner makes of them.
struct Itinerary {
  PlanList list;            ///< as they were read
  std::vector<Plan> plans;  ///< as they are sent
  PlannerSurvey survey;     ///< all trajectories
};

/// @return the plans that `task.plan` names: built-in ones or a file
/// @throws ConfigError; FaultError bad_plan
[[nodiscard]] PlanList read_plan_list(const Config& config);
/// Examines where the platform begins. @throws ConfigError; FaultError bad_plan: it does not fit in there
void examine_start(const PlanList& list, const Config& config);
/// Examines plans: where they begin, their legs in the room, whether there are trajectories, and the curves of these in the room.
/// @param list  as read_plan_list() gives it @throws ConfigError; FaultError bad_plan, path_not_found
[[nodiscard]] Itinerary examine(const PlanList& list, const Config& config);

/// The plans in a run folder.
inline constexpr const char* kPlanFile = "plan.txt";

/// Body of the ECP of a_1.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);
/// Body of the process of a_3.
void run_map(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::rex_drive
