// Receiving messages without free memory: they are lost, and the process lives.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <vector>

#include "base/link/channel.hpp"
#include "base/link/event_log.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/supervisor_t.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/no_memory.hpp"

namespace mrroc::link {
namespace {

/// Messages as they are on the wire, with the numbers 1, 2, 3...
template <class M>
std::vector<std::vector<std::uint8_t>> numbered(std::size_t count) {
  std::vector<std::vector<std::uint8_t>> messages;
  for (std::size_t k = 0; k < count; ++k) {
    M m{};
    m.header.session = 7;
    m.header.number = static_cast<std::int64_t>(k + 1);
    std::vector<std::uint8_t>& bytes = messages.emplace_back(static_cast<std::size_t>(m.getEncodedSize()));
    m.encode(bytes.data(), 0, m.getEncodedSize());
  }
  return messages;
}

TEST(WithoutMemory, AQueueLosesAMessageThatARepetitionBringsAgain) {
  constexpr std::size_t kMany = 500;  // more than any queue has room for from the beginning
  const auto messages = numbered<console_t>(kMany);
  test::DirectBus bus;
  Queue<console_t> queue(bus, {Group::agents, "s.mp.console"}, 7);
  {
    const test::NoMemory out;
    for (const auto& m : messages) queue.receive("s.mp.console", m);
  }
  for (const auto& m : messages) queue.receive("s.mp.console", m);
  std::set<std::int64_t> numbers;
  while (const auto m = queue.take()) EXPECT_TRUE(numbers.insert(m->header.number).second) << "twice";
  EXPECT_EQ(numbers.size(), kMany);
}

TEST(WithoutMemory, ALogHasFailedAsItDoesWhenTheDiskIsFull) {
  const std::filesystem::path file = ::testing::TempDir() + "memory_test.lcmlog";
  const auto messages = numbered<supervisor_t>(3);
  for (const std::uintmax_t limit : {UINTMAX_MAX, std::uintmax_t{1}}) {
    EventLog log(file, 7, limit);
    log.receive("s.supervisor", messages[0]);
    EXPECT_FALSE(log.failed());
    {
      const test::NoMemory out;
      log.receive("s.of_a_channel_that_is_new.status", messages[1]);
    }
    EXPECT_TRUE(log.failed()) << "so the run is stopped, and its log says no false word";
  }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace mrroc::link
