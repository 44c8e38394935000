#include "ui_cli/explain.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/fault_table.hpp"

namespace mrroc::ui {
namespace {

struct Ended {
  int status;
  std::string out, err;
};
Ended run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int status = run_explain(arguments, out, err);
  return {status, out.str(), err.str()};
}

TEST(Explain, SaysEverythingThatTheTableKnowsOfEveryError) {
  for (const FaultEntry& e : kFaultTable) {
    const std::string text = explanation(e.code);
    for (const std::string_view part : {e.name, e.text, e.remedy, e.causes.substr(0, e.causes.find(';'))})
      EXPECT_NE(text.find(part), std::string::npos) << e.name << " lacks: " << part << "\n" << text;
  }
}

TEST(Explain, KnowsNamesAndNumbers) {
  EXPECT_EQ(run({"over_current"}).out, explanation(FaultCode::over_current));
  EXPECT_EQ(run({"1"}).out, explanation(FaultCode::lost_command));
  EXPECT_EQ(nlohmann::json::parse(run({"over_current", "--json"}).out)["class"], "fatal");
}

TEST(Explain, ListsAllWithoutACode) {
  const auto all = nlohmann::json::parse(run({"--json"}).out);
  EXPECT_EQ(all.size(), kFaultTable.size() - 1);
  const std::string text = run({}).out;
  for (const auto& e : all) EXPECT_NE(text.find(e["code"].get<std::string>()), std::string::npos);
}

TEST(Explain, RefusesUnknownCodesWithTheNearest) {
  for (const char* word : {"over_curent", "99999", "-1", ""}) {
    const Ended end = run({word});
    EXPECT_EQ(end.status, 2) << word;
    EXPECT_TRUE(end.out.empty());
  }
  EXPECT_NE(run({"over_curent"}).err.find("did you mean 'over_current'?"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::ui
