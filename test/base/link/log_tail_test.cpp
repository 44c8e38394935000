// The end of an event log, without its beginning: whole events only, whatever is cut off or damaged.
#include "base/link/log_tail.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <random>

#include "base/link/channel.hpp"
#include "base/link/event_log.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

class Tail : public ::testing::Test {
 protected:
  Tail() {
    test::DirectBus bus;
    EventLog log(file_, 1);
    bus.subscribe_all("s.", log);
    Outbox<operator_order_t> out(bus, {Group::agents, "s.order"}, 1);
    for (int k = 1; k <= kMessages; ++k) out.publish({.header = {}, .id = k, .order = 0}, k);
  }
  ~Tail() override { fs::remove(file_); }
  static constexpr int kMessages = 500;
  const fs::path file_ = fs::temp_directory_path() / ("log_tail_test." + std::to_string(::getpid()));
};

std::int64_t stamp_of(const LoggedMessage& m) { return header_of(m.bytes).stamp; }

TEST_F(Tail, IsTheWholeLogWhereThereIsRoom) {
  const LogTail tail = read_tail(file_, 1'000'000);
  EXPECT_TRUE(tail.whole);
  const LogReader all(file_);
  ASSERT_EQ(tail.messages.size(), all.messages().size());
  for (std::size_t k = 0; k < tail.messages.size(); ++k) {
    EXPECT_EQ(tail.messages[k].channel, all.messages()[k].channel);
    EXPECT_EQ(tail.messages[k].bytes, all.messages()[k].bytes);
    EXPECT_EQ(tail.messages[k].time_us, all.messages()[k].time_us);
  }
}

TEST_F(Tail, BeginsWithTheFirstWholeEventAndHasAllThatFollow) {
  for (std::uintmax_t most = 1000; most < 1200; ++most) {
    const LogTail tail = read_tail(file_, most);
    EXPECT_FALSE(tail.whole);
    ASSERT_GT(tail.messages.size(), 8U);
    for (std::size_t k = 0; k < tail.messages.size(); ++k)
      EXPECT_EQ(stamp_of(tail.messages[tail.messages.size() - 1 - k]),
                kMessages - static_cast<std::int64_t>(k));
  }
}

TEST_F(Tail, LeavesOutAnEventThatIsCutOff) {
  fs::resize_file(file_, fs::file_size(file_) - 10);
  EXPECT_EQ(stamp_of(read_tail(file_, 1000).messages.back()), kMessages - 1);
}

TEST_F(Tail, ADamagedLogGivesWhatIsWholeAndNothingElse) {
  std::ifstream in(file_, std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(4);
  for (int k = 0; k < 300; ++k) {
    std::string bad = good.substr(0, 20'000);
    for (int n = 0; n < 40; ++n) bad[random() % bad.size()] = static_cast<char>(random());
    std::ofstream(file_, std::ios::binary) << bad;
    EXPECT_LE(read_tail(file_, 10'000 + random() % 10'000).messages.size(), 500U);
  }
}

TEST_F(Tail, OfNoFileIsEmpty) { EXPECT_TRUE(read_tail("/no/such/file", 1000).messages.empty()); }

}  // namespace
}  // namespace mrroc::link
