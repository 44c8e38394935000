#include "mp/options.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/command_line.hpp"
#include "base/fault.hpp"

namespace mrroc::mp {
namespace {

/// @return why the words are refused; empty if they are not
std::string refusal(const std::vector<std::string>& words, TaskOptions* result = nullptr) {
  TaskOptions options;
  CommandLine line;
  add_task_options(line, options);
  try {
    line.parse(words);
  } catch (const FaultError& e) {
    if (e.fault().code != FaultCode::bad_usage) throw;
    return e.what();
  }
  if (result) *result = options;
  return "";
}

TEST(TaskOptions, AreWhatTheCommandLineSays) {
  TaskOptions o;
  EXPECT_EQ(refusal({}, &o), "");
  EXPECT_EQ(o.speed, 0);
  EXPECT_FALSE(o.speed_asked);
  EXPECT_EQ(refusal({"--seed", "7", "--speed", "2.5", "--clock", "wall", "--processes", "one"}, &o), "");
  EXPECT_EQ(o.seed, 7U);
  EXPECT_EQ(o.speed, 2.5);
  EXPECT_EQ(o.clock, ClockKind::wall);
  EXPECT_FALSE(o.separate);
  EXPECT_EQ(refusal({"--speed", "max", "--seed", "9223372036854775807"}, &o), "");
  EXPECT_EQ(o.speed, 0);
  EXPECT_TRUE(o.speed_asked);
  EXPECT_EQ(o.seed, 9223372036854775807U);
}

TEST(TaskOptions, ASeedThatCannotBeIsRefusedByItsName) {
  for (const std::string seed : {"-1", "1.5", "x", "", "9223372036854775808", "99999999999999999999999"}) {
    const std::string why = refusal({"--seed=" + seed});
    EXPECT_NE(why.find("--seed"), std::string::npos) << seed << ": " << why;
  }
  EXPECT_NE(refusal({"--seed", "-1"}).find("--seed: '-1' is not a whole number from 0"), std::string::npos)
      << refusal({"--seed", "-1"});
}

TEST(TaskOptions, ASpeedThatCannotBeIsRefusedWithTheLimit) {
  for (const std::string speed : {"0", "-2", "1e9", "nan", "inf", "fast", "2x"}) {
    const std::string why = refusal({"--speed=" + speed});
    EXPECT_NE(why.find("up to 10000"), std::string::npos) << speed << ": " << why;
  }
}

TEST(TaskOptions, ACheckOfWhatIsNoRunIsRefusedInTheWordsOfEveryProgramThatReadsRuns) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "no-run";
  std::filesystem::create_directories(folder);
  const auto said = [](const std::filesystem::path& run) -> std::string {
    try {
      return refusal({"--check", run.string()});
    } catch (const FaultError& e) {
      return e.error_line();
    }
  };
  EXPECT_EQ(
      said(folder).find("error: bad_log: " + folder.string() + " is no run folder: it has no events.lcmlog"),
      0U)
      << said(folder);
  EXPECT_EQ(said(folder / "nowhere").find("error: bad_log: there is no folder "), 0U)
      << said(folder / "nowhere");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mrroc::mp
