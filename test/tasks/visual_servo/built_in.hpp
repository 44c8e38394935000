// The task's own configuration, with what a test sets.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "tasks/visual_servo/config.hpp"

namespace mrroc::visual_servo {

/// @return visual_servo.toml with these settings, each "KEY=VALUE"
inline Config built_in(const std::vector<std::string>& settings = {}) {
  Config c = Config::parse(config(), "visual_servo.toml");
  for (const std::string& s : settings) c.set(s);
  return c;
}

}  // namespace mrroc::visual_servo
