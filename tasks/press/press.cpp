#include "tasks/press/press.hpp"

namespace mrroc::press {
namespace {

constexpr TaskFrameCommand kApproach{.z = g(0.01, 5, 0.0025)};  // the force settles at v/B = 4 N
constexpr TaskFrameCommand kHold{.z = c(4, 20, 0.005)};
constexpr TaskFrameCommand kDrawBack{.z = u(-0.02)};

bool pushing(const Arm::X& x) { return x.e.F_a[Axis::z] > 0.9 * 4; }  // MG (66)

}  // namespace

const std::array<Motion<Arm>, 4> kPress{{
    ecp::row<Arm>(1, "approach", ecp::command<Arm, kApproach>, pushing, "F_z above 3.6 N"),
    ecp::row<Arm>(2, "settle", ecp::command<Arm, kApproach>, ecp::after<Arm, 150>, "3 s have passed"),
    ecp::row<Arm>(3, "hold", ecp::command<Arm, kHold>, ecp::after<Arm, 100>, "2 s have passed"),
    ecp::row<Arm>(4, "draw back", ecp::command<Arm, kDrawBack>, ecp::after<Arm, 50>, "1 s has passed"),
}};

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config&) {
  return {{{"approach_peak_N", "peak of the approach", "N"}, mp::largest_force(arms[0], Axis::z, {1, 2})},
          {{"approach_settled_N", "  settled", "N", 3.9, 4.1}, mp::mean_force(arms[0], Axis::z, 2, 1.0)},
          {{"hold_N", "force held", "N", 3.9, 4.1}, mp::mean_force(arms[0], Axis::z, 3, 1.0)}};
}

}  // namespace mrroc::press
