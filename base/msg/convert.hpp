// Converts between messages and the values that they carry. Numbers that stand for enumerators are passed on
// as they are: the code that acts on a value checks it first.
#pragma once
#include "base/camera.hpp"
#include "base/effector_command.hpp"
#include "base/hardware.hpp"
#include "base/transmission.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/camera_reading_t.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/hardware_command_t.hpp"
#include "mrroc/hardware_state_t.hpp"
#include "mrroc/robot_model_t.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "mrroc/sensor_setting_t.hpp"
#include "mrroc/step_sample_t.hpp"

namespace mrroc {

/// A value as a message and back, here and below: meaning and units stay. The header is left to the channel.
fault_t to_message(const Fault& f);
Fault from_message(const fault_t& m);

arm_command_t to_message(const ArmCommand& c);
ArmCommand from_message(const arm_command_t& m);

robot_model_t to_message(const RobotModel& model);
RobotModel from_message(const robot_model_t& m);

effector_command_t to_message(const EffectorCommand& c);
/// The stamp of the message's header becomes EffectorCommand::macrostep.
EffectorCommand from_message(const effector_command_t& m);

effector_reply_t to_message(const EffectorReply& r);
EffectorReply from_message(const effector_reply_t& m);

step_sample_t to_message(const StepSample& s);
StepSample from_message(const step_sample_t& m);

agent_order_t to_message(const Order& o);
Order from_message(const agent_order_t& m);

agent_report_t to_message(const Report& r);
Report from_message(const agent_report_t& m);

sensor_reading_t to_message(const SensorReading& r);
SensorReading from_message(const sensor_reading_t& m);

sensor_setting_t to_message(const SensorSetting& s);
SensorSetting from_message(const sensor_setting_t& m);
/// @return whether all numbers are finite. Real-time safe
bool is_proper(const sensor_setting_t& m) noexcept;

/// The frame becomes the stamp of the header, which the channel writes.
camera_reading_t to_message(const CameraReading& r);
/// The stamp of the message's header becomes CameraReading::frame.
CameraReading from_message(const camera_reading_t& m);

hardware_command_t to_message(const HardwareCommand& c);
HardwareCommand from_message(const hardware_command_t& m);

/// The step becomes the stamp of the header, which the channel writes.
hardware_state_t to_message(const HardwareReading& r);
/// The stamp of the message's header becomes HardwareReading::step.
HardwareReading from_message(const hardware_state_t& m);

}  // namespace mrroc
