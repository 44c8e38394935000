// Converts the values of mobile platforms to and from messages. As in base/msg/convert.hpp meaning and units stay, the header
// is left to the channel, and the stamp of a message's header becomes the number of the macrostep or step where the value
// has one.
//
// What a command says is passed on as it is: the effector driver refuses it with the axis, the value and the limit, or
// drops and counts it (edp/platform). Of all other messages is_proper() says whether their numbers can be used: they are
// finite, enumerators are ones that there are, counts and steps are within their bounds.
#pragma once
#include "base/odometry_support.hpp"
#include "base/platform_command.hpp"
#include "base/platform_hardware.hpp"
#include "base/platform_path.hpp"
#include "base/platform_transmission.hpp"
#include "mrroc/box_truth_t.hpp"
#include "mrroc/fragment_order_t.hpp"
#include "mrroc/fragment_t.hpp"
#include "mrroc/map_pose_t.hpp"
#include "mrroc/map_report_t.hpp"
#include "mrroc/motion_capture_t.hpp"
#include "mrroc/odometry_reading_t.hpp"
#include "mrroc/plan_t.hpp"
#include "mrroc/platform_command_t.hpp"
#include "mrroc/platform_drive_t.hpp"
#include "mrroc/platform_estimate_t.hpp"
#include "mrroc/platform_reading_t.hpp"
#include "mrroc/platform_reply_t.hpp"
#include "mrroc/platform_telemetry_t.hpp"
#include "mrroc/platform_truth_t.hpp"

namespace mrroc {

/// Real-time safe, as everything here is.
fragment_t to_message(const Fragment& f);
Fragment from_message(const fragment_t& m);

map_pose_t to_message(const MapPose& p);
MapPose from_message(const map_pose_t& m);

platform_command_t to_message(const PlatformCommand& c);
/// The stamp of the message's header becomes PlatformCommand::macrostep.
PlatformCommand from_message(const platform_command_t& m);

platform_reply_t to_message(const PlatformReply& r);
/// The stamp of the message's header becomes PlatformReply::macrostep.
PlatformReply from_message(const platform_reply_t& m);
/// @return whether all numbers that somebody computes with are finite, verdict and state are ones that there are, and no
///         count is negative
bool is_proper(const platform_reply_t& m) noexcept;

platform_telemetry_t to_message(const PlatformTelemetry& t);
PlatformTelemetry from_message(const platform_telemetry_t& m);
/// @return whether all numbers are finite
bool is_proper(const platform_telemetry_t& m) noexcept;

/// The step becomes the stamp of the header, which the channel writes.
platform_reading_t to_message(const PlatformReading& r);
/// The stamp of the message's header becomes PlatformReading::step. What is not finite is no measurement: the reading says
/// then that IMU or load cells have none; a current becomes 0.
PlatformReading from_message(const platform_reading_t& m);

/// The step becomes the stamp of the header, which the channel writes.
platform_drive_t to_message(const PlatformDrive& d);
/// The stamp of the message's header becomes PlatformDrive::step.
PlatformDrive from_message(const platform_drive_t& m);
/// @return whether the torques are finite
bool is_proper(const platform_drive_t& m) noexcept;

/// @param support  what the reading rests on; its frame becomes the stamp of the header, which the channel writes
odometry_reading_t to_message(const OdometryReading& r, const OdometrySupport& support);
/// The same of a reading of which that is not known.
odometry_reading_t to_message(const OdometryReading& r);
OdometryReading from_message(const odometry_reading_t& m);
/// @param m  a proper message @return what its reading rests on
OdometrySupport support_of(const odometry_reading_t& m);
/// @return whether there is no measurement, or one: a rotation, a covariance, a first step before the second; and what it rests on
///         are counts and a finding that there is
bool is_proper(const odometry_reading_t& m) noexcept;

motion_capture_t to_message(const MotionCapture& c);
MotionCapture from_message(const motion_capture_t& m);
/// @return whether the platform was not seen, or its pose is finite
bool is_proper(const motion_capture_t& m) noexcept;

map_report_t to_message(const MapReport& r);
MapReport from_message(const map_report_t& m);
/// @return whether there is no pose, or a finite one with a covariance
bool is_proper(const map_report_t& m) noexcept;

platform_estimate_t to_message(const PlatformEstimate& e);
PlatformEstimate from_message(const platform_estimate_t& m);
/// @return whether all numbers are finite, and no variance is negative
bool is_proper(const platform_estimate_t& m) noexcept;

plan_t to_message(const Plan& p);
Plan from_message(const plan_t& m);
/// @return whether there is no plan, or one: 1..kPlanPoints points, all finite, and a speed above 0
bool is_proper(const plan_t& m) noexcept;

fragment_order_t to_message(const FragmentOrder& o);
FragmentOrder from_message(const fragment_order_t& m);
/// @return whether there is no fragment, or one of finite knots
bool is_proper(const fragment_order_t& m) noexcept;

box_truth_t to_message(const BoxTruth& t);
BoxTruth from_message(const box_truth_t& m);
/// @return whether all numbers are finite
bool is_proper(const box_truth_t& m) noexcept;

platform_truth_t to_message(const PlatformTruth& t);
PlatformTruth from_message(const platform_truth_t& m);
/// @return whether all numbers are finite
bool is_proper(const platform_truth_t& m) noexcept;

}  // namespace mrroc
