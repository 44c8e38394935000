// One arm comes to a surface, holds 4 N and draws back. docs/tutorial.md explains every line.
#pragma once
#include "ecp/solo.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::press {

struct Arm : ecp::ArmAgent<ecp::None> {};        ///< remembers nothing, reads no sensor
extern const std::array<Motion<Arm>, 4> kPress;  ///< approach, settle, hold, draw back
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config&);  ///< of F_z of the one arm [N]
std::string_view config();                                                      ///< press.toml

}  // namespace mrroc::press
