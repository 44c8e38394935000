// A configuration as text: it loads back the same, and is readable.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "test/base/robots_config.hpp"

namespace mrroc::test {
namespace {

struct Read {
  double number;
  int integer;
  std::vector<double> list;
  std::string text;
  std::vector<std::string> texts;
  bool flag;
  friend bool operator==(const Read&, const Read&) = default;
};

Read read(const Config& cfg) {
  return {cfg.number("sim.stiffness", 1e4, {100, 1e6}, "N/m"),
          cfg.integer("n_s", 10, {1, 1000}, "steps"),
          cfg.list("via", {{0.1, 1e-300, -0.0, 3}}, {}, "m"),
          cfg.text("sim.name", "a \"b\" \\ \t\n\x01 \xc3\xa9"),
          cfg.texts("names", {{}}),
          cfg.flag("attended", true)};
}

TEST(ConfigDump, LoadsBackIdentically) {
  const Config cfg = robots();
  const Read values = read(cfg);
  const Config again = Config::parse(cfg.dump(), "dump");
  EXPECT_EQ(read(again), values);
  EXPECT_EQ(again.dump(), cfg.dump());
  EXPECT_EQ(again.tables("robots"), cfg.tables("robots"));
}

TEST(ConfigDump, KeepsTablesWithoutKeys) {
  const Config cfg = Config::parse("[robots.arm1]\n[robots.arm2]\nmodel = 'irb6'\n", "");
  const Config again = Config::parse(cfg.dump(), "dump");
  EXPECT_EQ(again.tables("robots"), (std::vector<std::string>{"arm1", "arm2"}));
}

TEST(ConfigDump, KeepsEveryBitOfRandomNumbers) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 2000; ++k) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const Config cfg;
    (void)cfg.number("x", value);
    const Config again = Config::parse(cfg.dump(), "dump");
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again.number("x", 0)), std::bit_cast<std::uint64_t>(value))
        << cfg.dump();
  }
}

TEST(ConfigDump, ALongLineDoesNotPushTheNotesOfOthersAside) {
  const Config cfg = Config::parse("gap = 0.5\nway = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875]\n", "");
  static_cast<void>(cfg.number("gap", {}, {0, 1}, "m"));
  static_cast<void>(cfg.numbers<7>("way", {}, {0, 1}, "m"));
  EXPECT_EQ(cfg.dump(),
            "gap = 0.5  # 0 to 1 m\n"
            "way = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875]  # 0 to 1 m\n");
}

TEST(ConfigDump, ShowsAllValuesWithUnitsAndRanges) {
  Config cfg = Config::parse("[sim]\nunread = 1", "a.toml");
  cfg.set("n_s=20");
  (void)cfg.number("sim.stiffness", 1e4, {100, 1e6}, "N/m");
  (void)cfg.integer("n_s", 10, {1, 1000});
  EXPECT_EQ(cfg.dump(), R"(n_s = 20  # 1 to 1000

[sim]
stiffness = 10000.0  # 100 to 1000000 N/m
unread = 1
)");
}

}  // namespace
}  // namespace mrroc::test
