// The platforms that drivers, tasks and the simulator know. The build makes the list from what `mrroc_platform` in
// robots/NAME/CMakeLists.txt has registered (cmake/functions.cmake), as it makes that of the arms (robots/catalogue.hpp).
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "edp/platform/parameters.hpp"
#include "edp/platform/platform.hpp"
#include "robots/skid_steer.hpp"

namespace mrroc::robots {

/// Data of a platform and of its plant.
struct PlatformType {
  std::string_view name;                 ///< as in [platforms.KEY] model
  std::string_view program;              ///< of its driver; empty: edp_NAME
  const edp::Platform& (*platform)(){};  ///< its kernel, which lives to the end of the program; not null
  SkidSteerParameters plant;             ///< what its makers say of it, for the simulator
  std::string_view urdf;                 ///< for viewers
};

/// @return every platform, in the order of their registration; they live to the end of the program
[[nodiscard]] std::span<const PlatformType* const> platforms();

/// @return the program that is the driver of this type
[[nodiscard]] std::string driver_program(const PlatformType& type);

/// @return `platforms.order`: keys of the platforms
/// @throws ConfigError; FaultError bad_configuration: a key twice, one that an arm has too, one that is no word
[[nodiscard]] std::vector<std::string> read_platform_order(const Config& config);

/// @param key    of the platform, e.g. "rex"
/// @param types  that are allowed
/// @return [platforms.KEY] model; if it is not given the type with the name of the key, or else the first
/// @throws ConfigError  [platforms.KEY] model is none of them; FaultError bad_configuration: there are none
[[nodiscard]] const PlatformType& read_platform_type(const Config& config, const std::string& key,
                                                     std::span<const PlatformType* const> types);

/// @param key  of the platform
/// @return parameters of its driver, from [platforms.KEY]
/// @throws ConfigError
[[nodiscard]] edp::PlatformDriverParameters read_platform_driver(const Config& config, const std::string& key,
                                                                 const PlatformType& type);

/// @return the effector driver process of a platform of one of these types, for the main of its program.
/// @param types  live on
[[nodiscard]] link::NodeMain platform_driver_of(std::vector<const PlatformType*> types);

}  // namespace mrroc::robots
