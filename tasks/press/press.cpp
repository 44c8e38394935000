#include "tasks/press/press.hpp"

namespace mrroc::press {
namespace {
EffectorCommand approach(const Arm::X& x) { return ecp::move_arm({.z = g(0.0025 * x.c.value, 5, 0.0025)}); }
EffectorCommand hold(const Arm::X& x) { return ecp::move_arm({.z = c(x.c.value, 20, 0.005)}); }
EffectorCommand draw_back(const Arm::X&) { return ecp::move_arm({.z = u(-0.02)}); }
bool pushing(const Arm::X& x) { return x.e.F_a[Axis::z] > 0.9 * x.c.value; }  // MG (66)
}  // namespace

const std::array<Motion<Arm>, 4> kPress{{
    ecp::row<Arm>(1, "approach", approach, pushing, "F_z above 0.9 of the force"),
    ecp::row<Arm>(2, "settle", approach, ecp::after<Arm, 150>, "3 s have passed"),
    ecp::row<Arm>(3, "hold", hold, ecp::after<Arm, 100>, "2 s have passed"),
    ecp::row<Arm>(4, "draw back", draw_back, ecp::after<Arm, 50>, "1 s has passed"),
}};

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& k) {
  const double low = 0.975 * read_force(k), high = 1.025 * read_force(k);
  return {{{"approach_peak_N", "peak of the approach", "N"}, mp::largest_force(arms[0], Axis::z, {1, 2})},
          {{"approach_settled_N", "  settled", "N", low, high}, mp::mean_force(arms[0], Axis::z, 2, 1.0)},
          {{"hold_N", "force held", "N", low, high}, mp::mean_force(arms[0], Axis::z, 3, 1.0)}};
}

}  // namespace mrroc::press
