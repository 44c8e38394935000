// Values of mobile platforms survive their messages bit for bit; numbers that nobody can use are found.
#include "base/msg/convert_platform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "base/link/transmission_link.hpp"
#include "base/msg/message_type.hpp"
#include "test/base/msg/brought_back.hpp"
#include "test/base/msg/wire.hpp"

namespace mrroc {
namespace {

using test::bytes_of;
using test::expect_all_back;
using test::type_of_message;
using test::with_random_bytes;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

static_assert(link::Transmitted<Plan> && link::Transmitted<MapReport> &&
              link::Transmitted<PlatformEstimate> && link::Transmitted<MotionCapture> &&
              link::Transmitted<OdometryReading> && link::Transmitted<PlatformTelemetry> &&
              link::Transmitted<PlatformTruth>);

/// @return the numbers of kind float64 of which any, when it is not finite, makes the message improper
template <class M>
std::vector<Field> numbers_of() {
  std::vector<Field> numbers = type_of_message<M>().fields;
  std::erase_if(numbers,
                [](const Field& f) { return f.kind != FieldKind::float64 || f.name.starts_with("fault."); });
  return numbers;
}

template <class M>
M with_number(const M& m, const Field& field, double number) {
  auto bytes = bytes_of(m);
  const auto raw = std::bit_cast<std::uint64_t>(number);
  for (std::size_t k = 0; k < 8; ++k)
    bytes[field.offset + k] = static_cast<std::uint8_t>(raw >> (8 * (7 - k)));
  M changed{};
  changed.decode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return changed;
}

/// @param good  a proper message that says everything that it can
template <class M>
void expect_every_number_looked_at(const M& good) {
  ASSERT_TRUE(is_proper(good));
  for (const Field& f : numbers_of<M>())
    for (const double bad : {kNaN, kInfinity, -kInfinity})
      EXPECT_FALSE(is_proper(with_number(good, f, bad))) << f.name;
}

MapPose a_pose() {
  return {.step = 7, .valid = true, .p = {1, 2, 3}, .covariance = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
}

OdometryReading a_motion() {
  OdometryReading r{.step_before = 40, .step = 80, .valid = true};
  r.A = {1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0};
  for (std::size_t k = 0; k < 6; ++k) r.covariance[7 * k] = 1e-4;
  return r;
}

Plan a_plan() { return {.number = 3, .n = 2, .point = {{{0, 0}, {1, 0}}}, .speed = 0.4}; }

TEST(PlatformMessages, BringBackWhateverWasSent) {
  with_random_bytes<fragment_t>([](const fragment_t& m) { expect_all_back(m); });
  with_random_bytes<map_pose_t>([](const map_pose_t& m) { expect_all_back(m); });
  with_random_bytes<platform_command_t>([](const platform_command_t& m) {
    expect_all_back(m);
    ASSERT_EQ(from_message(m).macrostep, m.header.stamp);
  });
  with_random_bytes<platform_telemetry_t>([](const platform_telemetry_t& m) { expect_all_back(m); });
  with_random_bytes<platform_drive_t>([](const platform_drive_t& m) {
    expect_all_back(m);
    ASSERT_EQ(from_message(m).step, m.header.stamp);
  });
  with_random_bytes<odometry_reading_t>([](const odometry_reading_t& m) { expect_all_back(m); });
  with_random_bytes<motion_capture_t>([](const motion_capture_t& m) { expect_all_back(m); });
  with_random_bytes<map_report_t>([](const map_report_t& m) { expect_all_back(m); });
  with_random_bytes<platform_estimate_t>([](const platform_estimate_t& m) { expect_all_back(m); });
  with_random_bytes<plan_t>([](const plan_t& m) { expect_all_back(m); });
  with_random_bytes<fragment_order_t>([](const fragment_order_t& m) { expect_all_back(m); });
  with_random_bytes<box_truth_t>([](const box_truth_t& m) { expect_all_back(m); });
  with_random_bytes<platform_truth_t>([](const platform_truth_t& m) { expect_all_back(m); });
}

TEST(PlatformMessages, BringBackARepliesEveryFieldAndAFaultThatThereIs) {
  with_random_bytes<platform_reply_t>([](platform_reply_t m) {
    ASSERT_EQ(from_message(m).macrostep, m.header.stamp);
    ASSERT_TRUE(fault_code(static_cast<std::int64_t>(from_message(m).fault.code)));
    m.fault.code = static_cast<int>(FaultCode::lost_command);
    m.fault.axis = 3;
    expect_all_back(m);
  });
}

TEST(PlatformMessages, BringBackAReadingThatIsMeasured) {
  with_random_bytes<platform_reading_t>([](platform_reading_t m) {
    ASSERT_EQ(from_message(m).step, m.header.stamp);
    m.imu_valid = m.load_valid = 1;
    const auto bytes = bytes_of(m);
    if (std::ranges::all_of(numbers_of<platform_reading_t>(),
                            [&](const Field& f) { return std::isfinite(number_in(bytes, f)); }))
      expect_all_back(m);
  });
}

TEST(PlatformMessages, AReadingThatIsNoNumberIsNoMeasurement) {
  platform_reading_t m{};
  m.imu_valid = m.load_valid = 1;
  for (const double bad : {kNaN, kInfinity}) {
    for (double platform_reading_t::*field : {&platform_reading_t::yaw, &platform_reading_t::yaw_rate}) {
      platform_reading_t spoilt = m;
      spoilt.*field = bad;
      const PlatformReading r = from_message(spoilt);
      EXPECT_FALSE(r.imu_valid);
      EXPECT_TRUE(r.load_valid);
      EXPECT_TRUE(std::isfinite(r.yaw) && std::isfinite(r.yaw_rate));
    }
    for (std::size_t k = 0; k < kWheels; ++k) {
      platform_reading_t spoilt = m;
      spoilt.load[k] = spoilt.current[k] = bad;
      const PlatformReading r = from_message(spoilt);
      EXPECT_FALSE(r.load_valid);
      EXPECT_TRUE(r.imu_valid);
      EXPECT_EQ(r.load[k], 0);
      EXPECT_EQ(r.current[k], 0);
    }
  }
}

TEST(PlatformMessages, EveryNumberThatSomebodyComputesWithIsLookedAt) {
  expect_every_number_looked_at(to_message(PlatformReply{}));
  expect_every_number_looked_at(to_message(PlatformTelemetry{}));
  expect_every_number_looked_at(to_message(PlatformDrive{}));
  expect_every_number_looked_at(to_message(a_motion()));
  expect_every_number_looked_at(to_message(MotionCapture{.step = 50, .seen = true, .p = {1, 2, 3}}));
  expect_every_number_looked_at(to_message(MapReport{.pose = a_pose()}));
  expect_every_number_looked_at(to_message(PlatformEstimate{}));
  expect_every_number_looked_at(to_message(a_plan()));
  expect_every_number_looked_at(to_message(FragmentOrder{}));
  expect_every_number_looked_at(to_message(BoxTruth{}));
  expect_every_number_looked_at(to_message(PlatformTruth{}));
}

TEST(PlatformMessages, WhatAnAgentSaysBeforeItKnowsAnythingIsProper) {
  EXPECT_TRUE(is_proper(to_message(Plan{})));
  EXPECT_TRUE(is_proper(to_message(MapReport{})));
  EXPECT_TRUE(is_proper(to_message(PlatformEstimate{})));
  EXPECT_TRUE(is_proper(to_message(OdometryReading{})));
  EXPECT_TRUE(is_proper(to_message(MotionCapture{})));
}

TEST(PlatformMessages, APlanHasPointsWithinItsBoundsAndASpeed) {
  const auto proper = [](auto change) {
    plan_t m = to_message(a_plan());
    change(m);
    return is_proper(m);
  };
  EXPECT_TRUE(proper([](plan_t&) {}));
  EXPECT_TRUE(proper([](plan_t& m) { m.n = static_cast<int>(kPlanPoints); }));
  EXPECT_FALSE(proper([](plan_t& m) { m.n = static_cast<int>(kPlanPoints) + 1; }));
  EXPECT_TRUE(proper([](plan_t& m) { m.n = static_cast<int>(kPlanPoints) - 2, m.ahead = 2; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.n = static_cast<int>(kPlanPoints) - 1, m.ahead = 2; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.ahead = static_cast<int>(kPlanAhead) + 1; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.ahead = -1; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.n = 0; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.n = -1; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.number = 0; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.number = -1; }));
  EXPECT_FALSE(proper([](plan_t& m) { m.speed = 0; }));
}

TEST(PlatformMessages, AReplySaysWhatThereIs) {
  const auto proper = [](auto field, std::int64_t value) {
    platform_reply_t m = to_message(PlatformReply{});
    m.*field = static_cast<std::remove_reference_t<decltype(m.*field)>>(value);
    return is_proper(m);
  };
  EXPECT_TRUE(proper(&platform_reply_t::verdict, static_cast<int>(Verdict::failed)));
  EXPECT_FALSE(proper(&platform_reply_t::verdict, static_cast<int>(Verdict::failed) + 1));
  EXPECT_FALSE(proper(&platform_reply_t::verdict, -1));
  EXPECT_TRUE(proper(&platform_reply_t::state, kDriverStates - 1));
  EXPECT_FALSE(proper(&platform_reply_t::state, kDriverStates));
  EXPECT_FALSE(proper(&platform_reply_t::state, -1));
  EXPECT_FALSE(proper(&platform_reply_t::step, -1));
  EXPECT_FALSE(proper(&platform_reply_t::step, std::numeric_limits<std::int64_t>::max()));
  for (const auto field :
       {&platform_reply_t::accepted, &platform_reply_t::notified, &platform_reply_t::executing})
    EXPECT_FALSE(proper(field, -1));
  for (const auto field :
       {&platform_reply_t::iteration, &platform_reply_t::remaining, &platform_reply_t::late_odometry,
        &platform_reply_t::late_map, &platform_reply_t::rejected, &platform_reply_t::solver_failures})
    EXPECT_FALSE(proper(field, -1));
}

TEST(PlatformMessages, AMeasurementHasACovarianceAndARotation) {
  MapReport map{.pose = a_pose()};
  map.pose.covariance[4] = 0;
  EXPECT_FALSE(is_proper(to_message(map))) << "not positive";
  map.pose = a_pose();
  map.pose.covariance[1] = 0.5;
  EXPECT_FALSE(is_proper(to_message(map))) << "not symmetric";
  map.pose.covariance[3] = 0.5;
  EXPECT_TRUE(is_proper(to_message(map)));
  map.pose.covariance[1] = map.pose.covariance[3] = 1.5;
  EXPECT_FALSE(is_proper(to_message(map))) << "not definite";
  map.pose = a_pose();
  map.pose.step = -1;
  EXPECT_FALSE(is_proper(to_message(map)));
  OdometryReading odometry = a_motion();
  odometry.A[0] = 1.1;
  EXPECT_FALSE(is_proper(to_message(odometry))) << "no rotation";
  odometry = a_motion();
  odometry.step_before = odometry.step;
  EXPECT_FALSE(is_proper(to_message(odometry)));
  odometry = a_motion();
  odometry.covariance[35] = -1e-4;
  EXPECT_FALSE(is_proper(to_message(odometry)));
  PlatformEstimate estimate;
  estimate.covariance[8] = -1e-9;
  EXPECT_FALSE(is_proper(to_message(estimate)));
}

constexpr std::int64_t kLargestStep = 1'000'000'000'000;

/// @param field  of a proper message, a step: 0 to kLargestStep
template <class M, class Field>
void expect_step(const M& good, Field field) {
  for (const std::int64_t step : {std::int64_t{0}, std::int64_t{1}, kLargestStep}) {
    M m = good;
    field(m) = step;
    EXPECT_TRUE(is_proper(m)) << step;
  }
  for (const std::int64_t step : {std::int64_t{-1}, kLargestStep + 1}) {
    M m = good;
    field(m) = step;
    EXPECT_FALSE(is_proper(m)) << step;
  }
}

TEST(PlatformMessages, StepsAreCountedFromZeroToTheLargestThatIsBelieved) {
  expect_step(
      to_message(PlatformReply{}), [](auto& m) -> auto& { return m.step; });
  expect_step(
      to_message(PlatformReply{}), [](auto& m) -> auto& { return m.estimate.step; });
  expect_step(
      to_message(PlatformTelemetry{}), [](auto& m) -> auto& { return m.step; });
  expect_step(
      to_message(MotionCapture{.step = 50, .seen = true, .p = {1, 2, 3}}),
      [](auto& m) -> auto& { return m.step; });
  expect_step(
      to_message(MapReport{.pose = a_pose()}), [](auto& m) -> auto& { return m.pose.step; });
  expect_step(
      to_message(PlatformEstimate{}), [](auto& m) -> auto& { return m.estimate.step; });
}

TEST(PlatformMessages, AMotionGoesForwardsInTime) {
  const auto proper = [](std::int64_t before, std::int64_t step) {
    OdometryReading r = a_motion();
    r.step_before = before;
    r.step = step;
    return is_proper(to_message(r));
  };
  EXPECT_TRUE(proper(0, 1));
  EXPECT_FALSE(proper(1, 1));
  EXPECT_FALSE(proper(2, 1));
  EXPECT_FALSE(proper(-1, 1));
  EXPECT_TRUE(proper(kLargestStep - 1, kLargestStep));
  EXPECT_FALSE(proper(kLargestStep, kLargestStep + 1));
}

TEST(PlatformMessages, BringBackWhatAReadingOfTheOdometryRestsOn) {
  odometry_reading_t m = to_message(a_motion(), {.frame = 7,
                                                 .finding = OdometryFinding::inexact,
                                                 .features = 5,
                                                 .matches = 4,
                                                 .inliers = 3,
                                                 .cells = 2,
                                                 .rms_px = 1.5});
  m.header.stamp = 7;
  EXPECT_TRUE(is_proper(m));
  const OdometrySupport s = support_of(m);
  EXPECT_EQ(s.frame, 7);
  EXPECT_EQ(s.finding, OdometryFinding::inexact);
  EXPECT_EQ(s.features, 5);
  EXPECT_EQ(s.matches, 4);
  EXPECT_EQ(s.inliers, 3);
  EXPECT_EQ(s.cells, 2);
  EXPECT_EQ(s.rms_px, 1.5);
}

TEST(PlatformMessages, AReadingOfTheOdometryRestsOnCountsAndAFindingThatThereIs) {
  using S = odometry_support_t;
  for (const auto count : {&S::finding, &S::features, &S::matches, &S::inliers, &S::cells}) {
    odometry_reading_t m = to_message(a_motion());
    m.support.*count = -1;
    EXPECT_FALSE(is_proper(m));
  }
  odometry_reading_t m = to_message(a_motion());
  for (int finding = 0; finding < kOdometryFindings; ++finding) {
    m.support.finding = finding;
    EXPECT_TRUE(is_proper(m)) << finding;
    EXPECT_STRNE(to_words(support_of(m).finding), "unknown") << finding;
  }
  m.support.finding = kOdometryFindings;
  EXPECT_FALSE(is_proper(m));
  m = to_message(a_motion());
  m.support.rms_px = -1;
  EXPECT_FALSE(is_proper(m));
}

TEST(PlatformMessages, NothingIsCountedBelowZero) {
  PlatformTelemetry telemetry;
  telemetry.tracker_iterations = -1;
  EXPECT_FALSE(is_proper(to_message(telemetry)));
  telemetry = {};
  telemetry.estimator_iterations = -1;
  EXPECT_FALSE(is_proper(to_message(telemetry)));
  MapReport map{.pose = a_pose()};
  map.rejected = -1;
  EXPECT_FALSE(is_proper(to_message(map)));
  for (const std::size_t k : {0U, 4U, 8U}) {
    PlatformEstimate estimate;
    estimate.covariance[k] = -1e-9;
    EXPECT_FALSE(is_proper(to_message(estimate))) << k;
    estimate.covariance[k] = 0;
    EXPECT_TRUE(is_proper(to_message(estimate))) << k;
  }
}

TEST(PlatformMessages, NumbersOfWhatIsNotThereAreNotLookedAt) {
  OdometryReading odometry;
  odometry.step = -5;
  odometry.A[0] = kNaN;
  EXPECT_TRUE(is_proper(to_message(odometry)));
  MapReport map;
  map.pose.step = -5;
  map.pose.p.x = kNaN;
  EXPECT_TRUE(is_proper(to_message(map)));
  MotionCapture capture;
  capture.p.x = kNaN;
  EXPECT_TRUE(is_proper(to_message(capture)));
  capture.step = -1;
  EXPECT_FALSE(is_proper(to_message(capture))) << "when nothing was seen is known all the same";
}

// Of unequal deviations, 10 and 0.1: their product is 1.
TEST(PlatformMessages, ACovarianceIsSymmetricToAMillionthOfItsDeviations) {
  const auto proper = [](double one, double other) {
    MapReport map{.pose = a_pose()};
    map.pose.covariance = {100, one, 0, other, 0.01, 0, 0, 0, 1};
    return is_proper(to_message(map));
  };
  EXPECT_TRUE(proper(0.5, 0.5));
  EXPECT_TRUE(proper(0.5 + 0.9e-6, 0.5));
  EXPECT_TRUE(proper(0.5, 0.5 + 0.9e-6));
  EXPECT_FALSE(proper(0.5 + 1.1e-6, 0.5));
  EXPECT_FALSE(proper(0.5, 0.5 + 1.1e-6));
}

/// Looks at messages of random bytes, which say that there is something: those that are proper are finite.
template <class M>
void expect_proper_ones_finite() {
  const std::vector<Field> numbers = numbers_of<M>();
  with_random_bytes<M>([&](M m) {
    if constexpr (requires { m.motion.valid; }) m.motion.valid = 1;
    if constexpr (requires { m.pose.valid; }) m.pose.valid = 1;
    if constexpr (requires { m.seen; }) m.seen = 1;
    if (!is_proper(m)) return;
    const auto bytes = bytes_of(m);
    for (const Field& f : numbers) ASSERT_TRUE(std::isfinite(number_in(bytes, f))) << f.name;
  });
}

TEST(PlatformMessages, AnOrderHasNoFragmentOrOneWhoseStepsAreWithinTheirBounds) {
  fragment_order_t m{};
  EXPECT_TRUE(is_proper(m)) << "none";
  const auto proper = [&](std::int64_t number, std::int32_t steps, std::int32_t notify) {
    m.fragment.number = number;
    m.fragment.steps = steps;
    m.fragment.notify = notify;
    return is_proper(m);
  };
  EXPECT_TRUE(proper(1, 1, 0));
  EXPECT_TRUE(proper(1, kMaxFragmentSteps, -kMaxFragmentSteps));
  EXPECT_FALSE(proper(-1, 1, 0));
  EXPECT_FALSE(proper(1, 0, -1));
  EXPECT_FALSE(proper(1, kMaxFragmentSteps + 1, 0));
  EXPECT_FALSE(proper(1, 5, 5));
  EXPECT_FALSE(proper(1, 5, -kMaxFragmentSteps - 1));
}

TEST(PlatformMessages, OfAnyBytesThoseThatAreProperAreFinite) {
  expect_proper_ones_finite<platform_reply_t>();
  expect_proper_ones_finite<platform_telemetry_t>();
  expect_proper_ones_finite<platform_drive_t>();
  expect_proper_ones_finite<odometry_reading_t>();
  expect_proper_ones_finite<motion_capture_t>();
  expect_proper_ones_finite<map_report_t>();
  expect_proper_ones_finite<platform_estimate_t>();
  expect_proper_ones_finite<plan_t>();
  expect_proper_ones_finite<fragment_order_t>();
  expect_proper_ones_finite<box_truth_t>();
  expect_proper_ones_finite<platform_truth_t>();
}

}  // namespace
}  // namespace mrroc
