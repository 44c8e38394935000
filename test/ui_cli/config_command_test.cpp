#include "ui_cli/config_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "base/fault.hpp"

namespace mrroc::ui {
namespace {

using nlohmann::json;

struct Ended {
  int status;
  std::string out;
};
Ended run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = run_config(arguments, out, err);
  EXPECT_EQ(err.str(), "");
  return {status, out.str()};
}

json entry(const json& list, const std::string& key) {
  const auto found = std::ranges::find_if(list, [&](const json& p) { return p.at("key") == key; });
  return found == list.end() ? json() : *found;
}

TEST(ConfigCommand, ListsWhatIsTrueOfATasksPlantWithWhatIsBelievedInstead) {
  const Ended ended = run({"--truth", "press", "--json"});
  EXPECT_EQ(ended.status, 0);
  const json list = json::parse(ended.out);
  for (const json& p : list) EXPECT_TRUE(p.at("key").get<std::string>().starts_with("sim.")) << p;
  const json stiffness = entry(list, "sim.paper.stiffness");
  EXPECT_EQ(stiffness.at("believed"), "table.stiffness");
  EXPECT_EQ(stiffness.at("unit"), "N/m");
  EXPECT_EQ(stiffness.at("default"), "10000.0");
  EXPECT_EQ(stiffness.at("range"), "100 to 1000000");
  EXPECT_EQ(entry(list, "sim.speed"), json()) << "it is no matter of the plant";
  EXPECT_NE(run({"press", "--truth"}).out.find("\nsim.paper.stiffness  "), std::string::npos);
}

TEST(ConfigCommand, ListsAllParametersWithoutTruth) {
  const json list = json::parse(run({"press", "--json"}).out);
  EXPECT_EQ(entry(list, "task.force").at("unit"), "N");
  EXPECT_NE(entry(list, "table.stiffness"), json());
}

TEST(ConfigCommand, HandsSettingsToTheTask) {
  const json list = json::parse(run({"--truth", "press", "--set", "table.stiffness=2e4", "--json"}).out);
  EXPECT_EQ(entry(list, "sim.paper.stiffness").at("value"), "20000.0") << "the truth begins as what is told";
}

TEST(ConfigCommand, WithoutATaskListsThoseOfAllTasksEachKeyOnce) {
  const json list = json::parse(run({"--truth", "--json"}).out);
  EXPECT_EQ(entry(list, "sim.paper.stiffness").at("tasks").at("press"), "10000.0");
  std::vector<std::string> keys;
  for (const json& p : list) keys.push_back(p.at("key"));
  EXPECT_TRUE(std::ranges::is_sorted(keys));
  EXPECT_EQ(std::ranges::adjacent_find(keys), keys.end());
}

TEST(ConfigCommand, RefusesATaskThatThereIsNotWithTheNearest) {
  std::ostringstream out, err;
  try {
    std::ignore = run_config({"--truth", "pres"}, out, err);
    ADD_FAILURE() << "it was taken";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    EXPECT_NE(std::string(e.what()).find("did you mean 'press'?"), std::string::npos) << e.what();
  }
}

TEST(ConfigCommand, KnowsItsWords) {
  const std::vector<std::string> words = config_words();
  for (const char* const word : {"--truth", "--json", "press", "rubik"})
    EXPECT_TRUE(std::ranges::count(words, word)) << word;
}

}  // namespace
}  // namespace mrroc::ui
