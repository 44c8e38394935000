// The record of a run: what is missing is counted where numbers mean something, and a full disk is told.
#include "base/link/event_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/log_reader.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "test/base/link/buses.hpp"
#include "test/open_files.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSession = 1;

class LogFile : public ::testing::Test {
 protected:
  ~LogFile() override { fs::remove_all(folder_); }

  static fs::path new_folder() {
    std::string pattern = (fs::temp_directory_path() / "event_log_test.XXXXXX").string();
    return ::mkdtemp(pattern.data());
  }

  static test::Bytes order(std::int64_t number, std::int64_t stamp = 0) {
    operator_order_t m{};
    m.header = {kSession, number, stamp};
    test::Bytes bytes(static_cast<std::size_t>(encoded_size<operator_order_t>()));
    m.encode(bytes.data(), 0, encoded_size<operator_order_t>());
    return bytes;
  }
  static void give(EventLog& log, const std::string& channel, std::int64_t number, std::int64_t stamp = 0) {
    log.receive(channel, order(number, stamp));
  }

  const fs::path folder_ = new_folder();
  const fs::path file_ = folder_ / "events.lcmlog";
};

TEST_F(LogFile, IsClosedWithItsLog) {
  const auto before = mrroc::test::open_files();
  {
    EventLog log(file_, kSession);
    EXPECT_EQ(mrroc::test::open_files(), before + 1);
  }
  EXPECT_EQ(mrroc::test::open_files(), before);
}

TEST_F(LogFile, EndsAtItsBoundAndKeepsTheEndInMemory) {
  constexpr std::uintmax_t kLimit = 10'000;
  const fs::path tail = folder_ / kEventTail;
  std::int64_t written = 0;
  {
    EventLog log(file_, kSession, kLimit);
    for (std::int64_t k = 1; k <= 1000; ++k) give(log, "s.order", k, k);
    EXPECT_TRUE(log.flush()) << "that is no failure";
    EXPECT_GT(log.left_out(), 0);
    EXPECT_EQ(log.gaps(), 0);
    written = 1000 - log.left_out();
    log.write_tail(tail);
  }
  EXPECT_LE(fs::file_size(file_), kLimit);
  EXPECT_GT(fs::file_size(file_), kLimit - 200);
  const LogReader begins(file_), ends(tail);
  ASSERT_EQ(static_cast<std::int64_t>(begins.messages().size()), written);
  EXPECT_EQ(header_of(begins.messages().back().bytes).number, written);
  EXPECT_EQ(header_of(ends.messages().front().bytes).number, written + 1);
  EXPECT_EQ(header_of(ends.messages().back().bytes).number, 1000);
}

TEST_F(LogFile, OfWhatComesBeyondItsBoundAsMuchIsKeptAsMemoryIsMeantFor) {
  EventLog log(file_, kSession, 1000);
  test::Bytes large = order(1);
  for (std::int64_t k = 1; k <= 400'000; ++k) {
    for (int b = 0; b < 8; ++b) large[16 + b] = static_cast<std::uint8_t>(k >> (56 - 8 * b));  // its number
    log.receive("s.order", large);
  }
  log.write_tail(folder_ / kEventTail);
  EXPECT_LE(fs::file_size(folder_ / kEventTail), EventLog::kTail);
  EXPECT_GT(fs::file_size(folder_ / kEventTail), EventLog::kTail / 2);
}

TEST_F(LogFile, TellsItsSessionItsChannelsAndTheirMessages) {
  {
    EventLog log(file_, kSession);
    give(log, "s-1.b.two", 1, 5);
    give(log, "s-1.a", 1, 6);
    give(log, "s-1.a", 2, 7);
    test::Bytes stranger = order(9);
    stranger[15] = 2;  // of another session
    log.receive("s-1.a", stranger);
  }
  for (const fs::path& where : {file_, folder_}) {
    const LogReader reader(where);
    EXPECT_EQ(reader.session(), "s-1");
    EXPECT_EQ(reader.session_id(), kSession);
    EXPECT_EQ(reader.channels(), (std::vector<std::string>{"a", "b.two"}));
    EXPECT_EQ(reader.damaged(), 0);
    const auto a = reader.messages<operator_order_t>("a");
    ASSERT_EQ(a.size(), 2U);
    EXPECT_EQ(a.at(6).header.number, 1);
    EXPECT_EQ(a.at(7).header.number, 2);
    EXPECT_TRUE(reader.messages<sensor_reading_t>("a").empty()) << "of another type";
    EXPECT_TRUE(reader.messages<operator_order_t>("c").empty());
  }
  EXPECT_EQ(header_of(test::Bytes(31)).number, 0) << "too short for a header";
}

TEST_F(LogFile, WithoutABoundThatIsReachedHasNoTail) {
  EventLog log(file_, kSession);
  give(log, "s.order", 1);
  log.write_tail(folder_ / kEventTail);
  EXPECT_EQ(log.left_out(), 0);
  EXPECT_FALSE(fs::exists(folder_ / kEventTail));
}

/// The log of everything on a bus.
class LogOfABus : public LogFile {
 protected:
  LogOfABus() { bus_.subscribe_all("s.", *log_); }
  /// @return the file, closed
  fs::path finished() {
    log_.reset();
    return file_;
  }

  test::DirectBus bus_;
  std::optional<EventLog> log_{std::in_place, file_, kSession};
};

TEST_F(LogFile, CountsWhatIsMissingAndWritesRepetitionsOnce) {
  {
    EventLog log(file_, kSession);
    for (const std::int64_t number : {1, 2, 2, 1, 3, 7}) give(log, "s.a", number, number);
    EXPECT_EQ(log.gaps(), 3);
    EXPECT_TRUE(log.flush());
    EXPECT_FALSE(log.failed());
  }
  EXPECT_EQ(LogReader(file_).messages<operator_order_t>("a").size(), 4U);
}

TEST_F(LogFile, WritesWhatWasMissingWhenItIsRepeated) {
  {
    EventLog log(file_, kSession);
    for (const std::int64_t number : {1, 4, 2, 2, 4, 3, 3}) give(log, "s.a", number, number);
    EXPECT_EQ(log.gaps(), 0);
  }
  EXPECT_EQ(LogReader(file_).messages().size(), 4U);
}

TEST_F(LogFile, RemembersOfAJumpTheLastThousandNumbersThatAreMissing) {
  EventLog log(file_, kSession);
  for (const std::int64_t number : {1, 3001}) give(log, "s.a", number);
  EXPECT_EQ(log.gaps(), 2999);
  for (const std::int64_t number : {2, 2000}) give(log, "s.a", number);
  EXPECT_EQ(log.gaps(), 2999) << "forgotten";
  for (const std::int64_t number : {2001, 3000, 2500, 2001}) give(log, "s.a", number);
  EXPECT_EQ(log.gaps(), 2996);
}

TEST_F(LogFile, IsReadWithEveryMessageBeforeTheNextOfItsChannelAlsoWhereItCameLate) {
  using Message = std::pair<std::string, std::int64_t>;
  {
    EventLog log(file_, kSession);
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
  const LogReader reader(file_);
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
  {
    EventLog log(file_, kSession);
    const std::int64_t by_time = 1'760'000'000'000'000;  // as terminals number their orders
    for (const std::int64_t number : {by_time, by_time + 500'000, by_time - 7, std::int64_t{3}})
      give(log, "s.operator", number, number);
    EXPECT_EQ(log.gaps(), 0);
    give(log, "s.a", 3);
    EXPECT_EQ(log.gaps(), 2);
  }
  EXPECT_EQ(LogReader(file_).messages<operator_order_t>("operator").size(), 4U);
}

TEST_F(LogFile, AFullDiskIsTold) {
  EventLog log("/dev/full", kSession);
  for (std::int64_t number = 1; number < 2000; ++number) give(log, "s.a", number);
  EXPECT_TRUE(log.failed()) << "as soon as the buffer could not be written";
  EventLog small("/dev/full", kSession);
  give(small, "s.a", 1);
  EXPECT_FALSE(small.flush());
  EXPECT_TRUE(small.failed());
}

TEST_F(LogOfABus, HoldsEveryMessageOnceAndCountsWhatIsMissing) {
  Outbox<operator_order_t> sent(bus_, {Group::agents, "s.a"}, kSession);
  Outbox<sensor_reading_t> b(bus_, {Group::agents, "s.b"}, kSession);
  for (std::int64_t stamp = 1; stamp <= 50; ++stamp) {
    operator_order_t m{};
    m.id = 7 * stamp;
    sent.publish(m, stamp);
    b.publish({}, stamp);
    sent.repeat();
  }
  EXPECT_EQ(log_->gaps(), 0);
  bus_.deliver("s.a", order(53, 53));
  EXPECT_EQ(log_->gaps(), 2);
  bus_.deliver("s.c", test::Bytes(3));  // no message at all

  const LogReader reader(finished());
  EXPECT_EQ(reader.channels(), (std::vector<std::string>{"a", "b"}));
  const auto a = reader.messages<operator_order_t>("a");
  ASSERT_EQ(a.size(), 51U);
  for (std::int64_t stamp = 1; stamp <= 50; ++stamp) EXPECT_EQ(a.at(stamp).id, 7 * stamp);
  EXPECT_EQ(reader.messages<sensor_reading_t>("b").size(), 50U);
  EXPECT_TRUE(reader.messages<sensor_reading_t>("a").empty());
  EXPECT_TRUE(reader.messages<sensor_reading_t>("nothing").empty());
}

TEST_F(LogOfABus, MessagesOfAnotherSessionWithTheSameNameAreLeftOut) {
  Outbox<operator_order_t> own(bus_, {Group::agents, "s.a"}, kSession);
  Outbox<operator_order_t> foreign(bus_, {Group::agents, "s.a"}, kSession + 1);
  Outbox<operator_order_t> foreign_operator(bus_, {Group::agents, "s.operator"}, kSession + 1);
  for (std::int64_t stamp = 1; stamp <= 9; ++stamp) foreign.publish({}, stamp);
  foreign_operator.publish({}, 1);
  own.publish({}, 1);
  EXPECT_EQ(log_->gaps(), 0);

  const LogReader reader(finished());
  EXPECT_EQ(reader.session_id(), kSession);
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
  EXPECT_EQ(code_of([&] { EventLog(folder_ / "no" / "such" / "folder", kSession); }),
            FaultCode::cannot_write);
  EXPECT_EQ(code_of([&] { LogReader(folder_ / "missing"); }), FaultCode::bad_log);
}

}  // namespace
}  // namespace mrroc::link
