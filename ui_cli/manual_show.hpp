// The text of `ui_cli manual show` about an arm.
#pragma once
#include <iosfwd>
#include <string>

#include "base/effector_command.hpp"

namespace mrroc::ui {

/// Prints state, fault, positions, pose, force and jaws, and what the driver works with: tool, weight, kinematic model and
/// servo algorithms. Joints and pose are - (JSON: null) as long as the arm does not know them.
/// @param r     newest reply of the driver  @param arm  its name
/// @param json  one line of JSON; its keys are in docs/operator.md
void show_arm(const EffectorReply& r, const std::string& arm, bool json, std::ostream& out);

}  // namespace mrroc::ui
