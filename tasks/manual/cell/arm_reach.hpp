// Joins the task `manual` with the robots: its arms refuse goals out of their ranges before anything moves.
#pragma once
#include <memory>
#include <string>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/manual/reach.hpp"

namespace mrroc::manual {

/// @param arm  key: [robots.ARM] names the model
/// @throws ConfigError
[[nodiscard]] std::unique_ptr<Reach> make_arm_reach(const Config& config, const std::string& arm);

/// Body of the ECP of the task `manual`.
void run_manual_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::manual
