// What the task reads of its configuration.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/guide/guide.hpp"

namespace mrroc::guide {

/// @return the task's TOML file
std::string_view config();

/// @return the fixture, its law and the tool of the arm, from [task] and [robots.ARM.tool]
/// @throws ConfigError, FaultError bad_configuration: what cannot be a fixture, or a law that would swing
std::shared_ptr<const Setup> read_setup(const Config& config, const std::string& arm);

/// What a simulated operator does.
struct OperatorPlan {
  double speed{0.04};        ///< along the fixture [m/s]
  double acceleration{0.2};  ///< along and across his way [m/s^2]
  double push{10};           ///< across the fixture [N]
  double turn{3};            ///< time in which the push goes once around [s]
  double wall_push{15};      ///< against the walls [N]
  double start{0.03};        ///< he begins and ends so far off the fixture [m]
  double compliance{};       ///< of his hand, from where he wants to be to the tool [m/N]
  Law learnt;  ///< what he expects of the fixture: its stiffness, that of its walls and their softness
};

/// @param law  that he expects unless [operator] says otherwise
/// @param compliance  of the simulated hand [m/N] @return from [operator] @throws ConfigError
OperatorPlan read_operator(const Config& config, const Law& law, double compliance);

/// What --fixture and --size ask for, as settings KEY=VALUE of the configuration.
/// @param fixture  line, plane, circle or an SVG file; empty: as the configuration says
/// @param size     larger side of the drawing of a file [mm]; nothing: the usual one
/// @param stroke   of the file, from 1 on; 0: its only one
/// @throws FaultError bad_usage, bad_drawing
[[nodiscard]] std::vector<std::string> fixture_settings(const std::string& fixture,
                                                        std::optional<double> size, int stroke);

/// Body of the ECP.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::guide
