// What a log gives to a process that listens, wait by wait.
#include "base/link/replay_bus.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/link/event_log.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/process.hpp"
#include "base/msg/convert.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

template <FixedMessage M>
std::vector<std::uint8_t> bytes_of(M m, std::int64_t number) {
  m.header = {77, number, number};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(encoded_size<M>()));
  m.encode(bytes.data(), 0, encoded_size<M>());
  return bytes;
}

/// Remembers what it gets, as "channel number".
class Ear final : public Sink {
 public:
  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override {
    heard.push_back(std::string(channel) + " " + std::to_string(header_of(bytes).number));
  }
  std::vector<std::string> heard;
};

class Replay : public ::testing::Test {
 protected:
  Replay() {
    std::string pattern = (fs::temp_directory_path() / "replay_bus_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    EventLog log(folder_ / kEventLog, 77);
    const auto supervisor = [&](Phase phase, std::int64_t as_of, std::int64_t number) {
      supervisor_t m{};
      m.phase = static_cast<int>(phase);
      m.as_of = as_of;
      log.receive("s.supervisor", bytes_of(m, number));
    };
    const auto report = [&](const std::string& arm, std::int64_t number) {
      log.receive("s." + arm + ".report", bytes_of(to_message(Report{}), number));
    };
    supervisor(Phase::running, 0, 1);
    report("arm1", 1);
    supervisor(Phase::stopping, 0, 2);  // at once
    report("arm2", 1);
    report("arm1", 2);
    supervisor(Phase::stopping, 9, 3);  // in a macrostep that was agreed on
    report("arm1", 3);
  }
  ~Replay() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(Replay, EveryWaitGivesTheNextMessageToAllWhoListenAndTellsSoUntilTheLogEnds) {
  const LogReader log(folder_);
  ReplayBus bus(log);
  Ear one, other;
  for (Ear* const ear : {&one, &other}) bus.subscribe({Group::agents, "s.arm1.report"}, *ear);
  for (std::size_t k = 1; k <= 3; ++k) {
    EXPECT_FALSE(bus.wait(0ms)) << "who does not wait gets nothing: he would not have known what had come";
    EXPECT_EQ(one.heard.size(), k - 1);
    EXPECT_TRUE(bus.wait(1ms));
    ASSERT_EQ(one.heard.size(), k);
    EXPECT_EQ(one.heard.back(), "s.arm1.report " + std::to_string(k));
  }
  EXPECT_EQ(other.heard, one.heard);
  EXPECT_FALSE(bus.wait(0ms));
  EXPECT_THROW((void)bus.wait(1ms), LogEnded);
  EXPECT_EQ(one.heard.size(), 3U);
}

TEST_F(Replay, AStopAtOnceComesWhenAllElseHasAndIsAMessageLikeOthers) {
  const LogReader log(folder_);
  ReplayBus bus(log);
  Ear ear;
  for (const char* channel : {"s.supervisor", "s.arm1.report"}) bus.subscribe({Group::agents, channel}, ear);
  const std::vector<std::string> wanted{"s.supervisor 1", "s.arm1.report 1", "s.arm1.report 2",
                                        "s.supervisor 3", "s.arm1.report 3", "s.supervisor 2"};
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_TRUE(bus.wait(1ms)) << k;
  EXPECT_EQ(ear.heard, wanted);
  EXPECT_THROW((void)bus.wait(1ms), LogEnded);
}

TEST_F(Replay, AChannelThatIsLeftOutIsSilent) {
  const LogReader log(folder_);
  ReplayBus bus(log, {"arm1.report"});
  Ear ear;
  for (const char* channel : {"s.arm1.report", "s.arm2.report"}) bus.subscribe({Group::agents, channel}, ear);
  EXPECT_TRUE(bus.wait(1ms));
  EXPECT_EQ(ear.heard, std::vector<std::string>{"s.arm2.report 1"});
  EXPECT_THROW((void)bus.wait(1ms), LogEnded);
}

}  // namespace
}  // namespace mrroc::link
