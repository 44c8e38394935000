// One arm touches a surface with 2 N and draws back.
#pragma once
#include "ecp/solo.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::touch {

struct Arm : ArmAgent<None> {};
extern const std::array<Motion<Arm>, 3> kTouch;
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config);
std::string_view config();

}  // namespace mrroc::touch
