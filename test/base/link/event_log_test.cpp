// The record of a run: what is missing is counted where numbers mean something, and a full disk is told.
#include "base/link/event_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/link/channel.hpp"
#include "base/link/log_reader.hpp"
#include "mrroc/operator_order_t.hpp"
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

}  // namespace
}  // namespace mrroc::link
