// A configuration of two robots, for tests.
#pragma once
#include "base/config.hpp"

namespace mrroc::test {

inline constexpr const char* kRobots = R"(clock = "step"

[robots.arm1]
model = "irb6"
track = 0.5
gains = [1, 2.5, 3]

[robots.arm2]
model = "irb6"
n_s = 10
attended = true
sensors = ["pen", "camera"]
)";

inline Config robots() { return Config::parse(kRobots, "robots.toml"); }

}  // namespace mrroc::test
