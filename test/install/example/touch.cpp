#include "touch.hpp"

namespace mrroc::touch {
namespace {

constexpr TaskFrameCommand kApproach{.z = g(0.005, 5, 0.0025)};  // the force settles at v/B = 2 N
constexpr TaskFrameCommand kDrawBack{.z = u(-0.02)};

bool touching(const Arm::X& x) { return x.e.F_a[Axis::z] > 1; }

}  // namespace

const std::array<Motion<Arm>, 3> kTouch{{
    ecp::row<Arm>(1, "approach", ecp::command<Arm, kApproach>, touching),
    ecp::row<Arm>(2, "touch", ecp::command<Arm, kApproach>, ecp::after<Arm, 100>),
    ecp::row<Arm>(3, "draw back", ecp::command<Arm, kDrawBack>, ecp::after<Arm, 25>),
}};

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config&) {
  return {{{"touch_N", "force of the touch", "N", 1.8, 2.2}, mp::mean_force(arms[0], Axis::z, 2, 0.5)}};
}

}  // namespace mrroc::touch
