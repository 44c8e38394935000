#include "ui_cli/explain.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/effector_command.hpp"
#include "base/fault.hpp"
#include "base/link/process.hpp"
#include "base/operator.hpp"
#include "test/docs/json_table.hpp"
#include "ui_cli/consequence.hpp"

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

/// @return its words with one blank between them
std::string in_one_line(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  for (std::string word; in >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

TEST(Explain, SaysEverythingThatTheTableKnowsOfEveryError) {
  for (const FaultEntry& e : all_faults()) {
    const std::string text = in_one_line(explanation(e.code));
    for (const std::string_view part : {e.name, e.text, e.remedy, e.causes.substr(0, e.causes.find(';'))})
      EXPECT_NE(text.find(part), std::string::npos) << e.name << " lacks: " << part << "\n" << text;
  }
}

TEST(Explain, SaysWhatFollowsFromThatVeryError) {
  const auto follows = [](FaultCode code) { return std::string(consequence(code)); };
  for (const FaultEntry& e : all_faults()) {
    if (e.code == FaultCode::none) continue;
    EXPECT_NE(in_one_line(explanation(e.code)).find(follows(e.code)), std::string::npos) << e.name;
    EXPECT_EQ(exit_status(e.code) == 2, follows(e.code) == "nothing is started") << e.name;
    EXPECT_EQ(nlohmann::json::parse(run({std::string(e.name), "--json"}).out)["follows"], follows(e.code));
  }
  // None of these is a command that is refused while the task goes on.
  for (const FaultCode code : {FaultCode::time_limit, FaultCode::script_ended, FaultCode::operator_stop,
                               FaultCode::interrupted, FaultCode::path_not_found, FaultCode::no_contact})
    EXPECT_EQ(follows(code), "the effectors come to rest, and the task ends");
  EXPECT_EQ(follows(FaultCode::bad_plan), "nothing is started");
  EXPECT_NE(follows(FaultCode::position_lost).find("goes on when its position is back"), std::string::npos);
  EXPECT_NE(follows(FaultCode::over_current).find("reset"), std::string::npos);
  EXPECT_NE(follows(FaultCode::synchro_switch_stuck).find("a reset and then SYNCHRO"), std::string::npos);
  EXPECT_NE(follows(FaultCode::wheel_blocked).find("no task takes a reset of a platform"), std::string::npos);
  EXPECT_EQ(follows(FaultCode::process_died), "the task ends and the drives brake");
}

// A task that has ended takes no reset: what can be typed is told where it can be.
TEST(Explain, NoAdviceAsksForAResetThatATaskWhichHasEndedCannotTake) {
  for (const FaultEntry& e : all_faults())
    if (e.code != FaultCode::reset_required) {
      EXPECT_EQ(e.remedy.find("reset"), std::string_view::npos) << e.name << ": " << e.remedy;
    }
}

/// @return the words that come behind that one, anywhere in the text
std::vector<std::string> words_behind(std::string_view text, std::string_view word) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::string_view rest = text.substr(at + word.size());
    found.emplace_back(rest.substr(0, rest.find_first_of(" `,;.):")));
  }
  return found;
}

TEST(Explain, EveryErrorHasACauseAndAnAdviceOfItsOwnThatCanBeFollowed) {
  const std::set<std::string> commands{"status", "stop", "e-stop", "stability", "doctor"};
  const std::set<FaultCode> about_files{FaultCode::cannot_write};
  for (const FaultEntry& e : all_faults()) {
    if (e.code == FaultCode::none) continue;
    EXPECT_GT(e.remedy.size(), 10U) << e.name;
    EXPECT_GT(e.causes.size(), 10U) << e.name;
    EXPECT_NE(e.causes, e.text) << e.name << ": a cause is more than what happened";
    EXPECT_NE(e.causes, e.remedy) << e.name;
    for (const std::string_view part : {e.remedy, e.causes})
      for (const std::string& command : words_behind(part, "`ui_cli "))
        EXPECT_TRUE(commands.contains(command))
            << e.name << " names a command that does not exist: " << command;
    EXPECT_EQ(e.remedy.find("--run-dir") != std::string_view::npos, about_files.contains(e.code)) << e.name;
  }
}

TEST(Explain, EveryExplanationFitsOnATerminal) {
  for (const FaultEntry& e : all_faults()) {
    std::istringstream text(explanation(e.code));
    std::string line;
    std::getline(text, line);  // the title
    for (; std::getline(text, line);)
      EXPECT_TRUE(line.size() <= 80 || line.find('`') != std::string::npos) << line;
  }
}

TEST(Explain, KnowsNamesAndNumbers) {
  EXPECT_EQ(run({"over_current"}).out, explanation(FaultCode::over_current));
  EXPECT_EQ(run({"1"}).out, explanation(FaultCode::lost_command));
  EXPECT_EQ(nlohmann::json::parse(run({"over_current", "--json"}).out)["class"], "fatal");
}

TEST(Explain, TakesAWholeErrorLineInOneOrMoreWords) {
  const std::string wanted = run({"no_contact"}).out;
  EXPECT_EQ(run({"error: no_contact: the pen met nothing; lower it"}).out, wanted);
  EXPECT_EQ(run({"error:", "no_contact:", "the", "pen"}).out, wanted);
  EXPECT_EQ(run({"error: nothing_like_it: so"}).status, 2);
}

TEST(Explain, SeveralCodesAreOneDocument) {
  const auto both = nlohmann::json::parse(run({"over_current", "1", "--json"}).out);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(test::documented("explain CODE", both));
  EXPECT_EQ(both.at(1).at("code"), "lost_command");
}

TEST(Explain, ListsAllWithoutACode) {
  const auto all = nlohmann::json::parse(run({"--json"}).out);
  EXPECT_EQ(all.size(), all_faults().size() - 1);
  const std::string text = run({}).out;
  for (const auto& e : all) EXPECT_NE(text.find(e.at("code").get<std::string>()), std::string::npos);
}

TEST(Explain, RefusesUnknownCodesWithTheNearest) {
  for (const char* word : {"over_curent", "99999", "-1", ""}) {
    const Ended end = run({word});
    EXPECT_EQ(end.status, 2) << word;
    EXPECT_TRUE(end.out.empty());
  }
  EXPECT_NE(run({"over_curent"}).err.find("did you mean 'over_current'?"), std::string::npos);
}

TEST(Explain, KnowsEveryStateThatAPersonMeets) {
  std::vector<std::string> names;
  for (int s = 0; s <= static_cast<int>(TaskState::ended); ++s)
    names.emplace_back(to_string(static_cast<TaskState>(s)));
  for (std::size_t s = 0; s < kDriverStates; ++s) names.emplace_back(to_string(static_cast<DriverState>(s)));
  for (int s = 0; s <= static_cast<int>(link::ProcessState::dead); ++s)
    names.emplace_back(to_string(static_cast<link::ProcessState>(s)));
  for (const std::string& name : names) {
    EXPECT_EQ(run({name}).status, 0) << name;
    EXPECT_NE(run({name}).out.find("what to do:"), std::string::npos) << name;
  }
  EXPECT_EQ(run({"waiting", "for", "start"}).out, run({"waiting_for_start"}).out);
  EXPECT_NE(run({"faulted"}).out.find("of a process"), std::string::npos)
      << "what several have is told of all";
  EXPECT_EQ(nlohmann::json::parse(run({"holding", "--json"}).out)["state"], "holding");
  EXPECT_NE(run({}).out.find("waiting for start"), std::string::npos);
}

TEST(Explain, AStateIsNamedOnceWhosesoeverItIs) {
  const auto count = [](const std::string& text, const std::string& line_begin) {
    int lines = 0;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines += line.starts_with(line_begin);
    return lines;
  };
  const std::string faulted = run({"faulted"}).out;
  EXPECT_EQ(count(faulted, "faulted"), 1) << faulted;
  EXPECT_EQ(count(faulted, "  of "), 2) << faulted;
  EXPECT_EQ(count(run({}).out, "ready "), 1) << run({}).out;
}

TEST(Explain, CapitalsDoNotMatter) {
  EXPECT_EQ(run({"HOLDING"}).out, run({"holding"}).out);
  EXPECT_EQ(run({"Waiting", "For", "Start"}).out, run({"waiting for start"}).out);
  EXPECT_EQ(run({"Over_Current"}).out, run({"over_current"}).out);
  EXPECT_NE(run({"HOLDIN"}).err.find("did you mean 'holding'?"), std::string::npos) << run({"HOLDIN"}).err;
}

TEST(Explain, AnOrderAndTheScriptsErrorsAreKnownToo) {
  EXPECT_EQ(run({"e-stop"}).out, run({"emergency_stop"}).out);
  EXPECT_NE(run({"emergency_stop"}).out.find("what to do:"), std::string::npos);
  for (const char* code : {"missing_packages", "install_failed", "configure_failed", "build_failed",
                           "tests_failed", "package_failed", "wall_time", "no_summary", "worker_lost",
                           "host_failed", "no_scheduler", "runs_lost", "nothing_found"})
    EXPECT_EQ(run({code}).status, 0) << code;
}

TEST(Explain, EverySignalThatEndsARunHasOneText) {
  const auto known = run({"signal_11"});
  EXPECT_EQ(known.status, 0);
  EXPECT_NE(known.out.find("signal_N"), std::string::npos) << known.out;
  EXPECT_EQ(run({"signal_N"}).out, known.out);
  for (const char* code : {"signal_", "signal_1a", "signal"}) EXPECT_EQ(run({code}).status, 2) << code;
}

}  // namespace
}  // namespace mrroc::ui
