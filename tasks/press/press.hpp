// One arm comes to a surface, holds 4 N and draws back. docs/tutorial.md explains every line.
#pragma once
#include "ecp/solo.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::press {

struct Arm : ecp::ArmAgent<ecp::None> {};
extern const std::array<Motion<Arm>, 4> kPress;
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config);
std::string_view config();

}  // namespace mrroc::press
