// The messages between embodied agents and the coordinator: the transmission images x_cT and y_cT.
#pragma once
#include <array>
#include <cstdint>

#include "base/effector_command.hpp"

namespace mrroc {

/// y_cT_0j = x_cT_j0: coordinator -> embodied agent. Trivially copyable.
struct Order {
  int m{};                      ///< behaviour of the coordinator
  int variant{};                ///< form of that behaviour, as the task says: a role, the number of a point
  std::array<bool, 2> go_on{};  ///< told<1>, told<2>: end your behaviour (MG 60)
  bool finished{};              ///< the task is over: release the effector
  ArmCommand arm{};  ///< continuous coordination: the effector's command, copied by the agent (MS 33)
  bool
      late{};  ///< not sent, told by the links: with the wall clock, no order has come for this macrostep and
               ///< this is an older one; an arm that copies orders keeps still
};

/// y_cT_j0 = x_cT_0j: embodied agent -> coordinator. Trivially copyable.
struct Report {
  int m{};                                                  ///< behaviour of the agent
  int event{};                                              ///< m of the event that it has seen, 0 if none
  bool ready{};                                             ///< initialised, executes commands
  int sensor{};                                             ///< discrete reading of its virtual sensor
  DriverState driver_state{DriverState::not_synchronised};  ///< as in its last reply
  Verdict verdict{Verdict::none};                           ///< on its last command
  Fault fault{};                                            ///< why that was refused or failed
  bool position_known{};         ///< as in its last reply; without it T_0E and F_a are zeros
  std::array<double, 6> T_0E{};  ///< measured pose of E in the base: x y z [m], angle-axis [rad]
  Wrench F_a{};                  ///< adjusted force in E
  double gripper{};              ///< distance of the jaws [m]
  bool blocked{};                ///< the jaws hold something
};

/// Order::m of a coordinator whose agents work on their own (coordination "none", MG 5).
/// wait: for the start; pause: the arm stands, and its time does.
enum class SoloOrder : std::uint8_t { wait, work, pause };
/// Report::event of such an agent when it has nothing left to do.
inline constexpr int kWorkDone = 1000;

/// x_cV: reading of a virtual sensor. Trivially copyable.
struct SensorReading {
  int state{};                     ///< discrete reading
  bool valid{};                    ///< something was seen
  std::array<double, 16> value{};  ///< continuous reading, meaning set by the sensor
};

/// y_cV: what an agent tells its virtual sensor, MG (2), (6); MS (12), (13). Zeros: nothing is asked of it. Trivially
/// copyable.
struct SensorSetting {
  int mode{};                     ///< what the sensor is to do, as the sensor says; 0: what it does by itself
  std::array<double, 8> value{};  ///< finite; meaning set by the sensor

  friend bool operator==(const SensorSetting&, const SensorSetting&) = default;
};

}  // namespace mrroc
