// A neighbour of the platform's processes that has the session's key and has gone mad: what it says may end the run with a
// fault, but kills nobody.
#include <gtest/gtest.h>

#include <csignal>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <random>
#include <thread>

#include "base/link/channel.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/session.hpp"
#include "mrroc/platform_drive_t.hpp"
#include "mrroc/platform_reading_t.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

template <link::FixedMessage M>
Bytes encoded(const M& m) {
  Bytes bytes(static_cast<std::size_t>(link::encoded_size<M>()));
  m.encode(bytes.data(), 0, link::encoded_size<M>());
  return bytes;
}

void put(Bytes& bytes, std::size_t at, std::uint64_t word) {
  for (std::size_t k = 0; k < 8 && at + k < bytes.size(); ++k)
    bytes[at + k] = static_cast<std::uint8_t>(word >> (56 - 8 * k));
}

std::uint64_t word_of(double x) {
  std::uint64_t word{};
  std::memcpy(&word, &x, sizeof word);
  return word;
}

constexpr std::size_t kSession = 8;  // behind the message's fingerprint
constexpr std::size_t kStamp = 16;
constexpr std::size_t kBody = 32;

/// @return the message with something wrong: numbers, bits, its length, or all of it
Bytes damaged(Bytes message, std::mt19937_64& random) {
  constexpr std::array kWrong{std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -1e308,
                              1e9,
                              -1.0,
                              0.0};
  const auto anywhere = [&](std::size_t from) {
    return message.size() > from ? from + random() % (message.size() - from) : 0;
  };
  switch (random() % 6) {
    case 0:
      for (int k = 0; k < 4; ++k)
        put(message, kBody + 8 * (anywhere(0) / 8), word_of(kWrong[random() % kWrong.size()]));
      break;
    case 1:
      for (int k = 0; k < 8; ++k) message[anywhere(kBody)] ^= static_cast<std::uint8_t>(1U << random() % 8);
      break;
    case 2:
      message.resize(anywhere(0));
      break;
    case 3:
      message.resize(message.size() + 1 + random() % 100, static_cast<std::uint8_t>(random()));
      break;
    case 4:
      for (std::size_t k = kBody; k < message.size(); ++k) message[k] = static_cast<std::uint8_t>(random());
      break;
    default:
      put(message, kStamp, random() % 2 == 0 ? random() : random() % 2000);
  }
  return message;
}

/// @return the only session that the folder's programs run
link::SessionInfo session_in(const Folder& folder) {
  const auto directory = folder / ("mrroc-" + std::to_string(::geteuid()));
  for (const auto end = Clock::now() + 10s; Clock::now() < end; std::this_thread::sleep_for(5ms))
    if (const auto running = link::running_sessions(directory); running.size() == 1) return running[0];
  return {};
}

std::vector<std::string> drive(const Folder& folder, const std::string& name, bool eyes) {
  std::vector<std::string> words{"--plan",      folder.write("plan.txt", "0 0\n0.7 0\n1.2 0.3\n"),
                                 "--processes", "separate",
                                 "--speed",     "2",
                                 "--eyes",      eyes ? "on" : "off",
                                 "--run-dir",   (folder / name).string()};
  if (!eyes) return words;
  for (const char* const camera : {"rex_left", "rex_right"})
    for (const char* const setting : {"width=320", "height=240", "fx=210"})
      words.insert(words.end(), {"--set", std::string("cameras.") + camera + "." + setting});
  return words;
}

/// A channel of the platform's system, and whom its messages concern.
struct Spoken {
  const char* name;
  const char* channel;
  link::Group group{link::Group::agents};
  bool eyes{};  ///< only a platform with cameras has it
};

class RexDriveWithAMadNeighbour : public ::testing::TestWithParam<Spoken> {
 protected:
  /// @return messages of the channel as they are in a run without disturbances
  static std::vector<Bytes> samples(const Folder& folder, const Spoken& spoken) {
    if (spoken.group == link::Group::servo_state) return {encoded(platform_reading_t{})};
    if (spoken.group == link::Group::servo_command) return {encoded(platform_drive_t{})};
    const Ended ended = run(folder, "rex_drive", drive(folder, "sample", spoken.eyes));
    EXPECT_EQ(ended.status, 0) << ended.all();
    std::vector<Bytes> all;
    const link::LogReader log(folder / "sample");
    for (const link::LoggedMessage& m : log.messages())
      if (m.channel == spoken.channel) all.emplace_back(m.bytes.begin(), m.bytes.end());
    return all;
  }
};

TEST_P(RexDriveWithAMadNeighbour, LosesNoProcess) {
  if (kSanitized) GTEST_SKIP() << "too long";
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder(false);
  const Spoken& spoken = GetParam();
  const std::vector<Bytes> samples = RexDriveWithAMadNeighbour::samples(folder, spoken);
  ASSERT_FALSE(samples.empty()) << "nobody speaks on " << spoken.channel;
  Started task(folder, "rex_drive", drive(folder, "run", spoken.eyes));
  const link::SessionInfo s = session_in(folder);
  ASSERT_TRUE(task.await_line("plan 1 of 1")) << task.end().all();
  const std::vector<ProcessId> children = task.children();
  const auto bus = link::open_session(s);
  const link::Route route{spoken.group, s.name + "." + spoken.channel};
  std::mt19937_64 random(1);
  for (int k = 0; k < 10'000; ++k) {
    Bytes message = samples[random() % samples.size()];
    put(message, kSession, static_cast<std::uint64_t>(s.id));
    bus->publish(route, damaged(message, random));
    if (k % 50 == 49) std::this_thread::sleep_for(1ms);
  }
  task.signal(SIGTERM);  // in lock-step, what was to come and did not would be waited for
  const Ended ended = task.end();
  EXPECT_TRUE(ended.status == 0 || ended.status == 1 || ended.status == 3) << ended.all();
  for (const char* const told : {"process_died", "internal_error", "process_hung", "stop_not_confirmed"})
    EXPECT_EQ(ended.all().find(told), std::string::npos) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

INSTANTIATE_TEST_SUITE_P(
    On, RexDriveWithAMadNeighbour,
    ::testing::Values(Spoken{"commands", "rex.command"}, Spoken{"replies", "rex.reply"},
                      Spoken{"telemetry", "rex.telemetry"}, Spoken{"truth", "rex.truth"},
                      Spoken{"captures", "rex.motion_capture"},
                      Spoken{"odometry", "rex.odometry", link::Group::agents, true},
                      Spoken{"orders", "rex.order"}, Spoken{"reports", "rex.report"},
                      Spoken{"plans", "mp.rex.plan"}, Spoken{"positions", "map.rex.pose"},
                      Spoken{"estimates", "rex.map.estimate"},
                      Spoken{"readings", "rex.hardware_state", link::Group::servo_state},
                      Spoken{"drives", "rex.hardware_command", link::Group::servo_command}),
    [](const auto& spoken) { return std::string(spoken.param.name); });

}  // namespace
}  // namespace mrroc::test
