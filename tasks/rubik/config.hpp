// The cube task's part of the configuration.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/rubik/coordinator.hpp"

namespace mrroc::rubik {

/// Keys of the arms, by index(Hand).
inline const std::array<std::string, kArms> kArmKeys{"arm1", "arm2"};
/// Their models, as in [robots.ARM] model.
inline constexpr std::array<std::string_view, kArms> kArmModels{"irb6_postument", "irb6_track"};

/// The task's configuration, as built in.
std::string_view config();

/// @return the parameters in [task], [time] and [robots.ARM.tool]; without the latter the loads are zero
/// @throws ConfigError
Parameters read_parameters(const Config& config);

/// @return largest speeds and accelerations of an arm's motors in free motions, from [robots.ARM.motion] velocity and
///         acceleration, one number per axis
/// @param axes  of the arm
ecp::MotionLimits read_motion_limits(const Config& config, const std::string& arm, int axes);

/// The ECP process of an arm.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::rubik
