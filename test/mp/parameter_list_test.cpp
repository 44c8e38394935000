// The list of a task's parameters.
#include "mp/parameter_list.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <tuple>

namespace mrroc::mp {
namespace {

Config read_config() {
  Config c = Config::parse("[task]\nforce = 5\n[run]\nfolder = \"here\"\n[other]\nunread = 1\n", "test");
  std::ignore = c.number("task.force", 4, {1, 10}, "N");
  std::ignore = c.integer("time.n_s", 10, {.min = 2}, "steps");
  std::ignore = c.flag("sim.fast", true);
  std::ignore = c.choice("a.way", 1, {{"one", 1}, {"two", 2}});
  std::ignore = c.numbers<2>("operator.start", {{0, 1.5}}, {-500, 500}, "mm");
  std::ignore = c.text("run.folder", "");
  return c;
}

TEST(ParameterTable, HasEveryKeyThatIsReadThoseOfTheTaskFirst) {
  EXPECT_EQ(parameter_table(read_config()),
            "key             default     range        unit\n"
            "task.force      5.0         1 to 10      N\n"
            "a.way           \"one\"       one or two\n"
            "operator.start  [0.0, 1.5]  -500 to 500  mm\n"
            "sim.fast        true\n"
            "time.n_s        10          at least 2   steps\n");
}

TEST(ParameterTable, IsTheSameAsJson) {
  const auto list = nlohmann::json::parse(parameter_json(read_config()));
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0],
            (nlohmann::json{{"key", "task.force"}, {"default", "5.0"}, {"range", "1 to 10"}, {"unit", "N"}}));
  EXPECT_EQ(list[3], (nlohmann::json{
                         {"key", "sim.fast"}, {"default", "true"}, {"range", nullptr}, {"unit", nullptr}}));
}

TEST(ParameterTable, WhatOptionsGiveIsLeftOutAndALongValueDoesNotPushTheOthersAside) {
  Config c = Config::parse("", "test");
  for (const char* key : {"run.folder", "run.strokes", "run.other"}) std::ignore = c.text(key, "");
  std::ignore = c.number("sim.speed", 1, {0, 2});
  std::ignore = c.text("a.short", std::string(42, 'x'));  // 44 with its quotes
  EXPECT_EQ(parameter_table(c),
            "key        default                                       range  unit\n"
            "a.short    \"" +
                std::string(42, 'x') +
                "\"\n"
                "run.other  \"\"\n");
  Config d = Config::parse("", "test");
  std::ignore = d.text("a.long", std::string(43, 'x'));
  std::ignore = d.number("b", 1, {0, 2}, "N");
  EXPECT_EQ(parameter_table(d),
            "key     default  range   unit\n"
            "a.long  \"" +
                std::string(43, 'x') +
                "\"\n"
                "b       1.0      0 to 2  N\n");
}

TEST(TruthTable, HasWhatThePlantIsWithItsMeaningAndWhatIsBelievedInstead) {
  Config c = read_config();
  std::ignore = c.number("sim.paper.stiffness", 1e4, {100, 1e6}, {"N/m", "of the paper", "table.stiffness"});
  std::ignore = c.number("sim.speed", 1);
  EXPECT_EQ(truth_table(c),
            "key                  unit  default  range           believed         meaning\n"
            "sim.fast                   true\n"
            "sim.paper.stiffness  N/m   10000.0  100 to 1000000  table.stiffness  of the paper\n");
  const auto list = nlohmann::json::parse(truth_json(c));
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list.at(1), (nlohmann::json{{"key", "sim.paper.stiffness"},
                                        {"unit", "N/m"},
                                        {"default", "10000.0"},
                                        {"range", "100 to 1000000"},
                                        {"believed", "table.stiffness"},
                                        {"meaning", "of the paper"}}));
  EXPECT_TRUE(list.at(0).at("believed").is_null());
}

TEST(ParameterList, ValuesThatWereGivenAreNotCalledDefaults) {
  const auto listed = [](const TaskOptions& options) {
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(list_parameters(read_config(), options), 0);
    return ::testing::internal::GetCapturedStdout();
  };
  TaskOptions plain, set, file, seed;
  set.settings = {"task.force=5"};
  file.config_file = "some.toml";
  seed.seed_asked = true;
  EXPECT_EQ(listed(plain), parameter_table(read_config(), "default"));
  for (TaskOptions* given : {&set, &file, &seed}) {
    EXPECT_EQ(listed(*given), parameter_table(read_config(), "value"));
    given->json = true;
    const auto first = nlohmann::json::parse(listed(*given)).at(0);
    EXPECT_EQ(first.at("value"), "5.0");
    EXPECT_FALSE(first.contains("default"));
  }
}

TEST(ParameterList, IsPrintedAsATableOrAsJson) {
  for (const bool json : {false, true}) {
    TaskOptions options;
    options.json = json;
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(list_parameters(read_config(), options), 0);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(),
              json ? parameter_json(read_config()) : parameter_table(read_config()));
  }
  EXPECT_TRUE(parameter_json(read_config()).starts_with("[\n  {\n    \"key\": \"task.force\",\n"));
}

}  // namespace
}  // namespace mrroc::mp
