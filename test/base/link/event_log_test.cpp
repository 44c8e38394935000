// The record of a run: what is missing is counted where numbers mean something, and a full disk is told.
#include "base/link/event_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/log_reader.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

class LogFile : public ::testing::Test {
 protected:
  LogFile() {
    std::string pattern = (fs::temp_directory_path() / "event_log_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~LogFile() override { fs::remove_all(folder_); }

  static void give(EventLog& log, const std::string& channel, std::int64_t number, std::int64_t stamp = 0) {
    operator_order_t m{};
    m.header = {1, number, stamp};
    test::Bytes bytes(static_cast<std::size_t>(encoded_size<operator_order_t>()));
    m.encode(bytes.data(), 0, encoded_size<operator_order_t>());
    log.receive(channel, bytes);
  }
  fs::path folder_;
};

TEST_F(LogFile, CountsWhatIsMissingAndWritesRepetitionsOnce) {
  const fs::path file = folder_ / "log";
  {
    EventLog log(file, 1);
    for (const std::int64_t number : {1, 2, 2, 1, 3, 7}) give(log, "s.a", number, number);
    EXPECT_EQ(log.gaps(), 3);
    EXPECT_TRUE(log.flush());
    EXPECT_FALSE(log.failed());
  }
  EXPECT_EQ(LogReader(file).messages<operator_order_t>("a").size(), 4U);
}

TEST_F(LogFile, WritesWhatWasMissingWhenItIsRepeated) {
  const fs::path file = folder_ / "log";
  {
    EventLog log(file, 1);
    for (const std::int64_t number : {1, 4, 2, 2, 4, 3, 3}) give(log, "s.a", number, number);
    EXPECT_EQ(log.gaps(), 0);
  }
  EXPECT_EQ(LogReader(file).messages().size(), 4U);
}

TEST_F(LogFile, IsReadWithEveryMessageBeforeTheNextOfItsChannelAlsoWhereItCameLate) {
  const fs::path file = folder_ / "log";
  using Message = std::pair<std::string, std::int64_t>;
  {
    EventLog log(file, 1);
    for (const auto& [channel, number] : {Message{"a", 1},
                                          {"b", 1},
                                          {"a", 4},
                                          {"operator", 9},
                                          {"b", 2},
                                          {"a", 3},
                                          {"operator", 5},
                                          {"a", 2},
                                          {"b", 3}})
      give(log, "s." + channel, number);
  }
  std::vector<Message> read;
  const LogReader reader(file);
  for (const LoggedMessage& m : reader.messages()) read.emplace_back(m.channel, header_of(m.bytes).number);
  EXPECT_EQ(read, (std::vector<Message>{{"a", 1},
                                        {"b", 1},
                                        {"a", 2},
                                        {"a", 3},
                                        {"a", 4},
                                        {"operator", 9},
                                        {"b", 2},
                                        {"operator", 5},
                                        {"b", 3}}));
}

TEST_F(LogFile, CountsNothingOnAChannelWithSeveralSendersAndWritesEverything) {
  const fs::path file = folder_ / "log";
  {
    EventLog log(file, 1);
    const std::int64_t by_time = 1'760'000'000'000'000;  // as terminals number their orders
    for (const std::int64_t number : {by_time, by_time + 500'000, by_time - 7, std::int64_t{3}})
      give(log, "s.operator", number, number);
    EXPECT_EQ(log.gaps(), 0);
    give(log, "s.a", 3);
    EXPECT_EQ(log.gaps(), 2);
  }
  EXPECT_EQ(LogReader(file).messages<operator_order_t>("operator").size(), 4U);
}

TEST_F(LogFile, AFullDiskIsTold) {
  EventLog log("/dev/full", 1);
  for (std::int64_t number = 1; number < 2000; ++number) give(log, "s.a", number);
  EXPECT_TRUE(log.failed()) << "as soon as the buffer could not be written";
  EventLog small("/dev/full", 1);
  give(small, "s.a", 1);
  EXPECT_FALSE(small.flush());
  EXPECT_TRUE(small.failed());
}

TEST_F(LogFile, HoldsEveryMessageOnceAndCountsWhatIsMissing) {
  const auto file = folder_ / "events.lcmlog";
  {
    test::DirectBus bus;
    EventLog log(file, 1);
    bus.subscribe_all("s.", log);
    Outbox<operator_order_t> a(bus, {Group::agents, "s.a"}, 1);
    Outbox<sensor_reading_t> b(bus, {Group::agents, "s.b"}, 1);
    for (std::int64_t stamp = 1; stamp <= 50; ++stamp) {
      operator_order_t m{};
      m.id = 7 * stamp;
      a.publish(m, stamp);
      b.publish({}, stamp);
      a.repeat();
    }
    EXPECT_EQ(log.gaps(), 0);
    operator_order_t late{};
    late.header = {1, 53, 53};
    test::Bytes bytes(static_cast<std::size_t>(encoded_size<operator_order_t>()));
    late.encode(bytes.data(), 0, encoded_size<operator_order_t>());
    bus.deliver("s.a", bytes);
    EXPECT_EQ(log.gaps(), 2);
    bus.deliver("s.c", test::Bytes(3));  // no message at all
  }
  const LogReader reader(file);
  EXPECT_EQ(reader.channels(), (std::vector<std::string>{"a", "b"}));
  const auto a = reader.messages<operator_order_t>("a");
  ASSERT_EQ(a.size(), 51U);
  for (std::int64_t stamp = 1; stamp <= 50; ++stamp) EXPECT_EQ(a.at(stamp).id, 7 * stamp);
  EXPECT_EQ(reader.messages<sensor_reading_t>("b").size(), 50U);
  EXPECT_TRUE(reader.messages<sensor_reading_t>("a").empty());
  EXPECT_TRUE(reader.messages<sensor_reading_t>("nothing").empty());
}

TEST_F(LogFile, MessagesOfAnotherSessionWithTheSameNameAreLeftOut) {
  const auto file = folder_ / "events.lcmlog";
  {
    test::DirectBus bus;
    EventLog log(file, 1);
    bus.subscribe_all("s.", log);
    Outbox<operator_order_t> own(bus, {Group::agents, "s.a"}, 1);
    Outbox<operator_order_t> foreign(bus, {Group::agents, "s.a"}, 2);
    Outbox<operator_order_t> foreign_operator(bus, {Group::agents, "s.operator"}, 2);
    for (std::int64_t stamp = 1; stamp <= 9; ++stamp) foreign.publish({}, stamp);
    foreign_operator.publish({}, 1);
    own.publish({}, 1);
    EXPECT_EQ(log.gaps(), 0);
  }
  const LogReader reader(file);
  EXPECT_EQ(reader.session_id(), 1);
  EXPECT_EQ(reader.messages().size(), 1U);
}

TEST_F(LogFile, WhatCannotBeWrittenOrReadIsSaid) {
  const auto code_of = [](const auto& f) {
    try {
      f();
    } catch (const FaultError& e) {
      return e.fault().code;
    }
    return FaultCode::none;
  };
  EXPECT_EQ(code_of([&] { EventLog(folder_ / "no" / "such" / "folder", 1); }), FaultCode::cannot_write);
  EXPECT_EQ(code_of([&] { LogReader(folder_ / "missing"); }), FaultCode::bad_log);
}

}  // namespace
}  // namespace mrroc::link
