// Whatever comes from the network in the right size can be converted and told: no crash, no number that means
// nothing where one is looked up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "base/link/decode.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/finite.hpp"
#include "mrroc/fault_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "test/base/msg/wire.hpp"

namespace mrroc {
namespace {

using test::with_random_bytes;

bool known(FaultCode code) { return fault_code(static_cast<std::int64_t>(code)).has_value(); }

bool printable(const std::string& text) {
  return std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; });
}

TEST(RandomBytes, FaultsHaveACodeAndCanBePrinted) {
  with_random_bytes<fault_t>([](const fault_t& m) {
    const Fault f = from_message(m);
    ASSERT_TRUE(known(f.code));
    ASSERT_TRUE(printable(what_happened(f)));
    ASSERT_FALSE(describe(f).empty());
    std::ignore = exit_status(f.code);
  });
}

TEST(RandomBytes, RepliesReportsAndCommandsAreConverted) {
  with_random_bytes<effector_reply_t>([](const effector_reply_t& m) {
    const EffectorReply r = from_message(m);
    ASSERT_TRUE(known(r.fault.code));
    ASSERT_FALSE(to_string(r.state).empty());
    if (!finite(m)) return;
    ASSERT_TRUE(std::ranges::all_of(r.T_0E, [](double x) { return std::isfinite(x); }));
  });
  with_random_bytes<agent_report_t>([](const agent_report_t& m) {
    const Report r = from_message(m);
    ASSERT_TRUE(known(r.fault.code));
    ASSERT_FALSE(to_string(r.driver_state).empty());
  });
  with_random_bytes<effector_command_t>([](const effector_command_t& m) {
    const EffectorCommand c = from_message(m);
    ASSERT_EQ(c.number, m.number);
    // Again into a message: the numbers of enumerators that do not exist are passed on as they are.
    ASSERT_EQ(to_message(c).instruction, m.instruction);
  });
  with_random_bytes<agent_order_t>([](const agent_order_t& m) { ASSERT_FALSE(from_message(m).late); });
}

/// @return whether all is finite, and is not with any number of the fields that is not
template <class M, std::size_t n>
void expect_found(double (M::*field)[n]) {
  M m{};
  EXPECT_TRUE(finite(m));
  for (std::size_t k = 0; k < n; ++k)
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      M spoilt = m;
      (spoilt.*field)[k] = bad;
      EXPECT_FALSE(finite(spoilt)) << k;
    }
}
template <class M>
void expect_found(double M::*field) {
  M m{};
  m.*field = std::nan("");
  EXPECT_FALSE(finite(m));
}

TEST(RandomBytes, EveryNumberThatSomebodyComputesWithIsLookedAt) {
  expect_found(&agent_report_t::T_0E);
  expect_found(&agent_report_t::F_a);
  expect_found(&agent_report_t::gripper);
  expect_found(&effector_reply_t::pose);
  expect_found(&effector_reply_t::T_0E);
  expect_found(&effector_reply_t::F_a);
  expect_found(&effector_reply_t::joints);
  expect_found(&effector_reply_t::motors);
  expect_found(&effector_reply_t::gripper);
  expect_found(&step_sample_t::T_0E);
  expect_found(&step_sample_t::F_a);
  expect_found(&camera_reading_t::T_CG);
  expect_found(&camera_reading_t::covariance);
  expect_found(&camera_reading_t::reprojection_px);
  expect_found(&hand_order_t::x);
  expect_found(&hand_order_t::y);
  expect_found(&hand_order_t::height);
}

TEST(RandomBytes, WhatIsNotFiniteIsFound) {
  hand_order_t order{};
  EXPECT_TRUE(finite(order));
  order.height[3] = std::nan("");
  EXPECT_FALSE(finite(order));
  agent_report_t report{};
  EXPECT_TRUE(finite(report));
  report.F_a[5] = -std::numeric_limits<double>::infinity();
  EXPECT_FALSE(finite(report));
  effector_reply_t reply{};
  EXPECT_TRUE(finite(reply));
  reply.motors[7] = std::nan("");
  EXPECT_FALSE(finite(reply));
  step_sample_t sample{};
  EXPECT_TRUE(finite(sample));
  sample.T_0E[0] = std::nan("");
  EXPECT_FALSE(finite(sample));
}

}  // namespace
}  // namespace mrroc
