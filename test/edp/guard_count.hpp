// Counts what passes the guards of a driver in a very long time: for tests, and in larger numbers for
// benchmarks.
#pragma once
#include <cstdint>
#include <string>

#include "edp/driver.hpp"

namespace mrroc::edp::test {

/// Outcome of many invalid commands.
struct InvalidCount {
  long commands{};
  long executed{};    ///< not refused, or decoded although their size is wrong
  long changed{};     ///< after which driver and drives were not what they would have been without them
  std::string first;  ///< what was the first of these
};

/// Sends commands with one thing wrong - any field, session, number, size of the message - to a driver that
/// holds its arm, beside a twin that gets none.
InvalidCount count_invalid(long commands, std::uint64_t seed);

/// Outcome of many steps of motion.
struct SetPointCount {
  long steps{};
  long moving{};              ///< steps in which the set point moved
  long violations{};          ///< steps with a speed, acceleration or position beyond its limit
  double speed{};             ///< greatest speed of a motor, of its limit
  double acceleration{};      ///< greatest acceleration of a motor, of its limit
  double tip_acceleration{};  ///< greatest acceleration of E while a TCIM command was executed, of its limit
  double tip_speed{};         ///< greatest speed of E while a command was executed, of its limit
};

/// Commands motions of every kind at random, legal and too fast ones, with silence in between, under a random
/// force, and looks at every set point. The drives follow at once.
/// @param parameters known_pose, the arm starts there
SetPointCount count_set_points(const Robot& robot, const DriverParameters& parameters, long steps,
                               std::uint64_t seed);

}  // namespace mrroc::edp::test
