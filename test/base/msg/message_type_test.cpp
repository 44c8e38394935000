// Messages known at run time are those that the generated code encodes.
#include "base/msg/message_type.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc {
namespace {

template <link::FixedMessage M>
std::vector<std::uint8_t> bytes_of(const M& m) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<M>()));
  m.encode(bytes.data(), 0, link::encoded_size<M>());
  return bytes;
}

TEST(MessageType, AllFieldsTogetherAreTheWholeMessage) {
  ASSERT_GT(message_types().size(), 20U);
  for (const MessageType& type : message_types()) {
    std::size_t end = 8;
    for (const Field& f : type.fields) {
      EXPECT_EQ(f.offset, end) << type.name << "." << f.name;
      end += f.size;
    }
    EXPECT_EQ(end, type.size) << type.name;
  }
}

TEST(MessageType, IsFoundByTheBytesOfAMessage) {
  const auto bytes = bytes_of(effector_reply_t{});
  const MessageType* const type = type_of(bytes);
  ASSERT_TRUE(type);
  EXPECT_EQ(type->name, "effector_reply_t");
  EXPECT_EQ(type->size, bytes.size());
  EXPECT_EQ(type_of(std::span(bytes).first(bytes.size() - 1)), nullptr);
  EXPECT_EQ(type_of({}), nullptr);
}

TEST(MessageType, GivesTheValuesThatWereEncoded) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    effector_reply_t m{};
    m.header.stamp = static_cast<std::int64_t>(random());
    m.state = static_cast<std::int8_t>(random());
    m.inputs = static_cast<std::int16_t>(random());
    m.fault.code = static_cast<std::int32_t>(random());
    m.blocked = trial % 2 == 1;
    m.robot_model.servo_algorithm[3] = static_cast<std::uint8_t>(random());
    m.motors[5] = std::ldexp(static_cast<double>(random()), -60);
    const auto bytes = bytes_of(m);
    const MessageType& type = *type_of(bytes);
    const auto value = [&](const char* name) { return value_in(bytes, *type.field(name)); };
    EXPECT_EQ(value("header.stamp"), std::to_string(m.header.stamp));
    EXPECT_EQ(value("state"), std::to_string(static_cast<int>(m.state)));
    EXPECT_EQ(value("inputs"), std::to_string(m.inputs));
    EXPECT_EQ(value("fault.code"), std::to_string(m.fault.code));
    EXPECT_EQ(value("blocked"), std::to_string(static_cast<int>(m.blocked)));
    for (const char* name :
         {"header.stamp", "state", "inputs", "fault.code", "robot_model.servo_algorithm[3]"})
      EXPECT_EQ(number_in(bytes, *type.field(name)), std::stod(value(name))) << name;
    EXPECT_EQ(value("robot_model.servo_algorithm[3]"),
              std::to_string(static_cast<int>(m.robot_model.servo_algorithm[3])));
    EXPECT_EQ(std::stod(value("motors[5]")), m.motors[5]);
    EXPECT_EQ(number_in(bytes, *type.field("motors[5]")), m.motors[5]);
  }
}

TEST(MessageType, EveryKindOfNumberIsReadWithItsSizeAndSign) {
  const MessageType type = parse_message_type(
      "struct a_t\n{\n int8_t a;\n int16_t b;\n int32_t c;\n int64_t d;\n byte e;\n boolean f;\n float g;\n"
      " double h;\n}\n",
      {});
  EXPECT_EQ(type.name, "a_t");
  EXPECT_EQ(type.size, 8U + 1 + 2 + 4 + 8 + 1 + 1 + 4 + 8);
  std::vector<std::uint8_t> bytes(type.size, 0xff);
  const auto put = [&](const char* name, std::uint64_t raw) {
    const Field& f = *type.field(name);
    for (std::size_t k = 0; k < f.size; ++k)
      bytes[f.offset + k] = static_cast<std::uint8_t>(raw >> (8 * (f.size - 1 - k)));
  };
  put("g", std::bit_cast<std::uint32_t>(-2.5F));
  put("h", std::bit_cast<std::uint64_t>(1e-300));
  const auto value = [&](const char* name) { return value_in(bytes, *type.field(name)); };
  for (const char* name : {"a", "b", "c", "d"}) {
    EXPECT_EQ(value(name), "-1");
    EXPECT_EQ(number_in(bytes, *type.field(name)), -1);
  }
  EXPECT_EQ(value("e"), "255");
  EXPECT_EQ(value("g"), "-2.5");
  EXPECT_EQ(number_in(bytes, *type.field("g")), -2.5);
  EXPECT_EQ(value("h"), "1e-300");
  put("a", 0x80);
  put("b", 0x8000);
  put("c", 0x80000000);
  put("d", 0x8000000000000000);
  put("f", 1);
  EXPECT_EQ(value("a"), "-128");
  EXPECT_EQ(value("b"), "-32768");
  EXPECT_EQ(value("c"), "-2147483648");
  EXPECT_EQ(value("d"), "-9223372036854775808");
  EXPECT_EQ(value("f"), "1");
}

TEST(MessageType, TextsEndWithTheFirstZeroAndStayPrintable) {
  console_t m{};
  const std::string text = "say \"yes\"\n";
  std::copy(text.begin(), text.end(), m.text);
  const auto bytes = bytes_of(m);
  const Field& field = *type_of(bytes)->field("text");
  EXPECT_EQ(field.kind, FieldKind::text);
  EXPECT_EQ(value_in(bytes, field), R"("say \"yes\"?")");
  EXPECT_TRUE(std::isnan(number_in(bytes, field)));
  const auto status = bytes_of(task_status_t{});
  EXPECT_TRUE(type_of(status)->field("agent[3]")) << "an array of texts";
  EXPECT_EQ(type_of(status)->field("agent[4]"), nullptr);
}

TEST(MessageType, EveryMessageOfAChannelTellsItsTimeOrThatItHasNone) {
  for (const MessageType& type : message_types()) {
    if (!type.field("header.stamp")) continue;
    EXPECT_EQ(type.time.empty(), type.time_unit == TimeUnit::none) << type.name;
    EXPECT_TRUE(type.time.empty() || type.field(type.time)) << type.name;
  }
  const auto with = [](const std::string& comment) {
    return "struct a_t {\n header_t header;" + comment + "\n int64_t step;\n}";
  };
  const auto parsed = [&](const std::string& comment) {
    return parse_message_type(with(comment), message_types());
  };
  EXPECT_EQ(parsed("  // time: header.stamp [macrosteps]").time_unit, TimeUnit::macrosteps);
  EXPECT_EQ(parsed("  // time: step [steps]").time, "step");
  EXPECT_EQ(parsed("  // time: none").time_unit, TimeUnit::none);
  for (const char* const forgotten : {"", "  // first", "  // time: step", "  // time: steps [steps]"})
    EXPECT_THROW(static_cast<void>(parsed(forgotten)), FaultError) << forgotten;
}

TEST(MessageType, WhatHasNoFixedSizeIsRefused) {
  EXPECT_THROW(static_cast<void>(parse_message_type("struct a_t {\n string s;\n b_t c;\n}", {})), FaultError);
  EXPECT_THROW(static_cast<void>(parse_message_type("struct a_t {\n double x[n];\n}", {})), FaultError);
  EXPECT_EQ(parse_message_type("struct a_t {\n double x[2][3]; // m\n}", {}).fields.at(5).name, "x[1][2]");
}

}  // namespace
}  // namespace mrroc
