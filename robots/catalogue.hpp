// The robots that have been added to the IRb-6: what driver, tasks and simulated world must know of each. The build
// makes the list of what `mrroc_robot` in robots/NAME/CMakeLists.txt has registered (cmake/functions.cmake).
#pragma once
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "robots/driver_config.hpp"
#include "robots/motor.hpp"

namespace mrroc::robots {

/// Data of a robot and of its plant.
struct Kind {
  std::string_view name;                    ///< as in [robots.ARM] model; its driver is the program edp_NAME
  std::unique_ptr<edp::Robot> (*make)(){};  ///< the kernel of an arm of this kind
  DriverDefaults driver;                    ///< sensor, tool, limits
  std::string_view urdf;  ///< for the world: serial chain, ends in "sensor", "tool", "pen_tip" as
                          ///< robots/irb6/irb6_postument.urdf does; no products of inertia
  std::vector<MotorParameters> motors;  ///< of the world, one per axis
  std::vector<double> start;            ///< joints at the beginning of a simulation [rad, track m]
};

/// @return every robot that has been added, in no order; they live to the end of the program
[[nodiscard]] std::span<const Kind* const> catalogue();

/// @return the robot with that name, or null
[[nodiscard]] inline const Kind* find(std::string_view name) {
  for (const Kind* kind : catalogue())
    if (kind->name == name) return kind;
  return nullptr;
}

/// @return the effector driver process of an arm of this kind, for the main of edp_NAME. @param kind lives on
[[nodiscard]] link::PartBody driver_of(const Kind& kind);

}  // namespace mrroc::robots
