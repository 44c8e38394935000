// Damaged logs: what is damaged is left out and counted, the rest is read.
#include "base/link/event_reader.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "base/fault.hpp"
#include "base/link/decode.hpp"
#include "base/link/event_log.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/link/log_reader.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using Bytes = std::string;

constexpr std::int64_t kSession = 1;

class DamagedLog : public ::testing::Test {
 protected:
  DamagedLog() {
    std::string pattern = (fs::temp_directory_path() / "event_reader_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    file_ = folder_ / "events.lcmlog";
  }
  ~DamagedLog() override { fs::remove_all(folder_); }

  static Bytes number(std::uint64_t value, int size) {
    Bytes bytes;
    for (int k = size - 1; k >= 0; --k) bytes += static_cast<char>(value >> (8 * k));
    return bytes;
  }
  /// An event with any lengths in its header.
  static Bytes event(const Bytes& channel, const Bytes& message, std::uint64_t channel_length,
                     std::uint64_t message_length) {
    return number(0xEDA1DA01, 4) + number(0, 8) + number(77, 8) + number(channel_length, 4) +
           number(message_length, 4) + channel + message;
  }
  static Bytes event(const Bytes& channel, const Bytes& message) {
    return event(channel, message, channel.size(), message.size());
  }
  static Bytes order(std::int64_t stamp) {
    operator_order_t m{};
    m.header = {kSession, stamp, stamp};
    Bytes bytes(static_cast<std::size_t>(encoded_size<operator_order_t>()), '\0');
    m.encode(bytes.data(), 0, encoded_size<operator_order_t>());
    return bytes;
  }
  static Bytes good(std::int64_t stamp) { return event("s.operator", order(stamp)); }

  /// @return stamps of the orders that the reader finds
  std::vector<std::int64_t> stamps(const Bytes& content) {
    std::ofstream(file_, std::ios::binary) << content;
    const LogReader reader(file_);
    damaged_ = reader.damaged();
    std::vector<std::int64_t> found;
    for (const LoggedMessage& m : reader.messages())
      if (const auto o = decode<operator_order_t>(m.bytes)) found.push_back(o->header.stamp);
    return found;
  }

  fs::path folder_, file_;
  std::int64_t damaged_{};
};

using Stamps = std::vector<std::int64_t>;

TEST_F(DamagedLog, OneThatIsSoundIsReadWhole) {
  EXPECT_EQ(stamps(good(1) + event("s.x", "") + good(2)), (Stamps{1, 2}));
  EXPECT_EQ(damaged_, 0);
  EXPECT_EQ(LogReader(file_).messages()[0].time_us, 77);
  EXPECT_EQ(LogReader(file_).messages().size(), 3U);
}

// The channel of a packet without a NUL was the rest of the datagram: LCM's reader ended there.
TEST_F(DamagedLog, ALengthOutOfBoundsLeavesOutOneEventOnly) {
  const Bytes longest(kLongestChannel, 'c');
  for (const Bytes& bad :
       {event(Bytes(1500, 'c'), ""), event(longest + "c", "x"), event("", "x"),
        event("s.a", "", 0xFFFFFFFF, 0), event("s.a", "x", 3, 0xFFFFFFFF), event("s.a", "x", 3, 0x7FFFFFFF),
        event("s.a", "x", 3, 65'508), event("s.a", "x", 0x80000000, 1), event("s\ta", "x"),
        event(Bytes("s\0a", 3), "x"), event("s.\x1b[2J", "x")}) {
    EXPECT_EQ(stamps(good(1) + bad + good(2) + bad + bad + good(3)), (Stamps{1, 2, 3})) << bad.substr(20, 20);
    EXPECT_EQ(damaged_, 2);
  }
  EXPECT_EQ(stamps(good(1) + event(longest, "x") + good(2)), (Stamps{1, 2}));
  EXPECT_EQ(damaged_, 0);
}

TEST_F(DamagedLog, ALengthThatReachesIntoTheNextEventDoesNotSwallowIt) {
  for (const int more : {1, 5, 28, 100, 300})
    EXPECT_EQ(stamps(good(1) + event("s.a", "x", 3, static_cast<std::uint64_t>(1 + more)) + good(2) +
                     good(3) + good(4) + good(5)),
              (Stamps{1, 2, 3, 4, 5}))
        << more;
  EXPECT_EQ(stamps(good(1) + event("s.a", "123456789", 3, 4) + good(2)), (Stamps{1, 2})) << "too short";
  EXPECT_EQ(damaged_, 1);
}

TEST_F(DamagedLog, BytesBetweenEventsAreLeftOut) {
  EXPECT_EQ(stamps("junk" + good(1) + "\xed\xa1\xda" + good(2) + Bytes(3'000'000, '\xed') + good(3)),
            (Stamps{1, 2, 3}));
  EXPECT_EQ(damaged_, 3);
}

TEST_F(DamagedLog, ALogThatIsCutOffIsReadUpToThere) {
  const Bytes last = good(2);
  for (std::size_t size = 1; size < last.size(); ++size) {
    EXPECT_EQ(stamps(good(1) + last.substr(0, size)), Stamps{1}) << size;
    EXPECT_EQ(damaged_, 1) << size;
  }
}

// Behind what may be read there is no memory that belongs to the reader: with the sanitizers every byte beyond is seen.
TEST_F(DamagedLog, APartOfALogThatEndsAnywhereHasTheEventsThatLieInItWhole) {
  const Bytes first = good(1), second = good(2);
  std::ofstream(file_, std::ios::binary) << first << second << good(3);
  for (std::size_t end = 0; end <= first.size() + second.size(); ++end) {
    EventReader reader(file_, 0, end);
    int events = 0;
    while (reader.next()) ++events;
    const bool whole = end == 0 || end == first.size() || end == first.size() + second.size();
    EXPECT_EQ(events, end < first.size() ? 0 : end < first.size() + second.size() ? 1 : 2) << end;
    EXPECT_EQ(reader.damaged(), whole ? 0 : 1) << end;
  }
}

TEST_F(DamagedLog, WhatHoldsNoEventOrIsNoFileIsRefused) {
  const auto code_of = [&](const fs::path& file) {
    try {
      const LogReader reader(file);
    } catch (const FaultError& e) {
      return e.fault().code;
    }
    return FaultCode::none;
  };
  for (const Bytes& content : {Bytes(), Bytes("x"), Bytes(100'000, '\0'), number(0xEDA1DA01, 4)}) {
    std::ofstream(file_, std::ios::binary) << content;
    EXPECT_EQ(code_of(file_), FaultCode::bad_log);
  }
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const fs::path& none :
       {folder_ / "pipe", fs::path("/dev/zero"), folder_ / "none", folder_ / "none" / "x"})
    EXPECT_EQ(code_of(none), FaultCode::bad_log) << none;
  EXPECT_EQ(code_of(folder_), FaultCode::bad_log) << "its log is empty";
}

TEST_F(DamagedLog, TheReaderReadsWhatTheLogWrites) {
  {
    EventLog log(file_, kSession);
    for (std::int64_t k = 1; k <= 500; ++k) {
      const Bytes bytes = order(k);
      log.receive("s.operator", {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    }
  }
  const LogReader reader(file_);
  EXPECT_EQ(reader.messages<operator_order_t>("operator").size(), 500U);
  EXPECT_EQ(reader.damaged(), 0);
}

// Each damage costs the events that it touches, and no more than one before them.
TEST_F(DamagedLog, RandomDamageCostsWhatItTouches) {
  std::mt19937_64 random(3);
  constexpr int kEvents = 60;
  Bytes whole;
  for (int k = 1; k <= kEvents; ++k) whole += good(k);
  for (int trial = 0; trial < 300; ++trial) {
    Bytes damaged = whole;
    const int places = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < places; ++k) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 3) {
        case 0:
          damaged[at] = static_cast<char>(random());
          break;
        case 1:
          damaged.erase(at, random() % 20);
          break;
        default:
          damaged.insert(at, Bytes(random() % 20, static_cast<char>(random())));
          break;
      }
    }
    const Stamps found = stamps(damaged);
    EXPECT_GE(found.size(), static_cast<std::size_t>(kEvents - 2 * places)) << trial;
  }
}

}  // namespace
}  // namespace mrroc::link
