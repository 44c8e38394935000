// One arm approaches a surface, holds a force and draws back. docs/tutorial.md explains every line.
#pragma once
#include "ecp/solo.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::press {

struct Arm : ArmAgent<ecp::Parameter<4>> {};     ///< remembers F_d [N], reads no sensor
extern const std::array<Motion<Arm>, 4> kPress;  ///< approach, settle, hold, draw back
inline double read_force(const Config& k) { return k.number("task.force", 4, {1, 10}, "N"); }  ///< F_d [N]
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config&);  ///< of F_z of the one arm [N]
std::string_view config();                                                      ///< press.toml

}  // namespace mrroc::press
