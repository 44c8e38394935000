// The commands for run folders, on a small folder made here.
#include <fmt/core.h>

#include <random>

#include "base/file_content.hpp"
#include "test/docs/json_table.hpp"
#include "test/ui_cli/run_folder.hpp"
#include "ui_cli/log/log_check.hpp"
#include "ui_cli/log/log_compare.hpp"
#include "ui_cli/log/log_csv.hpp"
#include "ui_cli/log/log_show.hpp"
#include "ui_cli/log/log_whole.hpp"

namespace mrroc::test {
namespace {

TEST_F(RunFolder, ShowTellsEveryMacrostepAndEveryChange) {
  ASSERT_EQ(run({"show", a_.string()}), 0) << err_.str();
  EXPECT_GT(lines().size(), static_cast<std::size_t>(kMacrosteps));
  ASSERT_EQ(run({"show", a_.string(), "--m"}), 0);
  std::string story = out_.str();
  for (const char* what : {"0.400 s     20  * arm1       behaviour m = 2", "operator   start", "too_fast",
                           "ecp-arm1   late: 3 skipped"})
    EXPECT_NE(story.find(what), std::string::npos) << what << "\n" << story;
  EXPECT_LT(lines().size(), 8U);
  ASSERT_EQ(run({"show", a_.string(), "--m", "--from", "0.39", "--to", "0.41", "--json"}), 0);
  ASSERT_EQ(lines().size(), 1U);
  EXPECT_EQ(Json::parse(lines()[0])["i"], 20);
  EXPECT_TRUE(documented("log show RUN", Json::parse(lines()[0])));
}

TEST_F(RunFolder, ShowRefusesATimeThatEndsBeforeItBegins) {
  EXPECT_EQ(run({"show", a_.string(), "--from", "0.4", "--to", "0.3"}), 2);
  EXPECT_NE(err_.str().find("--from 0.4 is after --to 0.3"), std::string::npos) << err_.str();
}

TEST_F(RunFolder, ShowNamesTheBehavioursOfAnArmAsItsAgentDoes) {
  {
    const link::LogReader before(a_);
    link::EventLog to(a_ / link::kEventLog, before.session_id());
    for (const link::LoggedMessage& m : before.messages()) to.receive("s." + m.channel, m.bytes);
    task_status_t s{};
    s.m = 1;
    link::put_text(s.behaviour, "manual operation");
    s.n_agents = 1;
    link::put_text(s.agent[0], "arm1");
    s.agent_m[0] = 1;
    link::put_text(s.agent_behaviour[0], "wait for an order");
    log(to, "task_status", s, 1, 1, 1);
    process_status_t p{};
    p.m = 2;
    link::put_text(p.behaviour, "find the position");
    log(to, "ecp-arm1.status", p, 1, 1, 20);
  }
  ASSERT_EQ(run({"show", a_.string(), "--m"}), 0) << err_.str();
  EXPECT_NE(out_.str().find("behaviour m = 1, wait for an order"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("behaviour m = 2, find the position"), std::string::npos)
      << "a behaviour that is too short for the task's status is known from the agent's own";
  EXPECT_EQ(out_.str().find("manual operation"), std::string::npos) << "that is the coordinator's";
}

TEST_F(RunFolder, ShowReadsADamagedLogAndTellsTheDamage) {
  ASSERT_EQ(run({"show", a_.string(), "--m"}), 0) << err_.str();
  const std::vector<std::string> before = lines();
  const fs::path file = a_ / link::kEventLog;
  const std::string whole = file_content(file);
  std::ofstream(file, std::ios::binary) << "what a stranger wrote" << whole << whole.substr(0, 40);
  ASSERT_EQ(run({"show", a_.string(), "--m"}), 0) << err_.str();
  std::vector<std::string> after = lines();
  EXPECT_EQ(after.back(), "outcome: done; the log is damaged in 2 places, what stood there is left out");
  after.back() = before.back();
  EXPECT_EQ(after, before);
  ASSERT_EQ(run({"show", a_.string(), "--m", "--json"}), 0);
  EXPECT_EQ(Json::parse(lines().back())["damaged"], 2);
  fs::remove(a_ / "summary.json");
  ASSERT_EQ(run({"show", a_.string(), "--m", "--json"}), 0);
  EXPECT_TRUE(documented("log show RUN, its last line", Json::parse(lines().back())))
      << "without a summary, of a damaged log: everything that it can tell";
}

TEST_F(RunFolder, ShowClosesWithTheOutcomeOfTheRun) {
  const auto last = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"show", a_.string(), "--m"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words), 0) << err_.str();
    return lines().back();
  };
  EXPECT_EQ(last(), "outcome: done");
  EXPECT_EQ(last({"--to", "1"}).find("outcome"), std::string::npos) << "the end is not asked for";
  std::ofstream(a_ / "summary.json")
      << R"x({"outcome": "fault", "fault": {"class": "system", "code": "process_died", "process": "vsp-arm1",
                "text": "a process has died (signal 9)"}})x";
  EXPECT_EQ(last(), "outcome: fault, process_died, vsp-arm1: a process has died (signal 9)");
  EXPECT_EQ(Json::parse(last({"--json"}))["fault"]["code"], "process_died");
  fs::remove(a_ / "summary.json");
  std::ofstream(a_ / "messages.log") << "start\n12.3 s ecp-arm1: too_fast\n";
  EXPECT_NE(last().find("no summary"), std::string::npos);
  EXPECT_NE(last().find("its last message: 12.3 s ecp-arm1: too_fast"), std::string::npos);
  EXPECT_EQ(Json::parse(last({"--json"}))["last_message"], "12.3 s ecp-arm1: too_fast");
}

TEST_F(RunFolder, ShowTellsTheMessagesOfAChannel) {
  ASSERT_EQ(run({"show", a_.string(), "--channel", "arm1.report", "--to", "0.1"}), 0);
  EXPECT_EQ(lines().size(), 5U);
  EXPECT_NE(lines()[1].find("F_a[2]=0.2"), std::string::npos) << out_.str();
  EXPECT_EQ(run({"show", a_.string(), "--channel", "arm1.raport"}), 2);
  EXPECT_NE(err_.str().find("did you mean 'arm1.report'"), std::string::npos);
}

// The names stand in messages that this version cannot read.
TEST_F(RunFolder, ShowWarnsWhereTheNamesOfBehavioursAreOfAnotherVersion) {
  const std::string warning = "warning: behaviours of the task have numbers only";
  std::vector<std::uint8_t> old(400);
  operator_image_t header{};
  header.header = {1, 1, 2};
  header.encode(old.data(), 0, static_cast<int>(old.size()));
  old[0] ^= 0xff;
  link::EventLog(a_ / link::kEventLog, 1).receive("s.task_status", old);
  ASSERT_EQ(run({"show", a_.string()}), 0);
  EXPECT_NE(err_.str().find(warning), std::string::npos) << err_.str();
  {
    link::EventLog to(a_ / link::kEventLog, 1);
    log(to, "task_status", task_status_t{}, 1, 2, 3);
  }
  ASSERT_EQ(run({"show", a_.string()}), 0);
  EXPECT_EQ(err_.str().find(warning), std::string::npos) << "names could be read";
}

TEST_F(RunFolder, AMessageThatEndsALinkHasNoTime) {
  const ui::RunRecord record(a_);
  const auto time_of = [&](std::int64_t stamp) {
    operator_image_t m{};
    m.header = {1, 1, stamp};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<operator_image_t>()));
    m.encode(bytes.data(), 0, link::encoded_size<operator_image_t>());
    return record.time_of({.channel = "hand.order", .bytes = bytes});
  };
  EXPECT_DOUBLE_EQ(time_of(30).value_or(-1), 0.6);
  EXPECT_FALSE(time_of(link::kEndOfLink));
}

TEST_F(RunFolder, CsvHasARowPerMessageThatCanBeReadBack) {
  ASSERT_EQ(run({"csv", a_.string(), "arm1.report", "--fields", "m,F_a"}), 0) << err_.str();
  EXPECT_EQ(lines().at(0), "t,m,F_a[0],F_a[1],F_a[2],F_a[3],F_a[4],F_a[5]");
  ASSERT_EQ(lines().size(), kMacrosteps + 1U);
  EXPECT_EQ(lines().at(3), "0.06,1,0,0,0.30000000000000004,0,0,0");
  ASSERT_EQ(run({"csv", a_.string(), "ecp-arm1.console", "--fields", "text"}), 0);
  EXPECT_EQ(lines().at(1), "0.5,\"late: 3 skipped\"");
  ASSERT_EQ(run({"csv", a_.string(), "arm1.report", "--json"}), 0);
  EXPECT_EQ(Json::parse(out_.str())[29]["verdict"], static_cast<int>(Verdict::refused));
  ASSERT_EQ(run({"csv", a_.string()}), 0);
  EXPECT_NE(out_.str().find("agent_report_t"), std::string::npos);
  ASSERT_EQ(run({"csv", a_.string(), "--json"}), 0);
  EXPECT_TRUE(documented("log csv RUN", Json::parse(out_.str())));
  EXPECT_EQ(run({"csv", a_.string(), "arm1.report", "--fields", "F_b"}), 2);
}

TEST_F(RunFolder, WhoeverReadsALogThatIsCutOffIsWarned) {
  const std::string warning = "warning: the log is not whole: ";
  tell_channels(a_, "vsp-arm1", "no.such");  // a process that came to its end
  ASSERT_EQ(run({"show", a_.string()}), 0);
  EXPECT_EQ(err_.str(), "");
  const fs::path log = a_ / link::kEventLog;
  fs::resize_file(log, fs::file_size(log) - 7);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"show", a_.string()}, {"csv", a_.string(), "arm1.report"}}) {
    ASSERT_EQ(run(words), 0);
    EXPECT_EQ(err_.str().find(warning), 0U) << words[0] << ": " << err_.str();
    EXPECT_EQ(out_.str().find(warning), std::string::npos) << "tables stay tables";
  }
  fs::remove(a_ / "processes.json");
  ASSERT_EQ(run({"show", a_.string()}), 0);
  EXPECT_EQ(err_.str(), "") << "who ran is not known";
}

TEST_F(RunFolder, ALogThatHasNotWhatWasSentIsDamaged) {
  tell_channels(a_, "edp-arm1", "arm1.report");
  EXPECT_EQ(ui::damage_of(ui::RunRecord(a_)), "");
  const link::LogReader before(a_);
  const auto damage_with = [&](const auto& change) {
    {
      link::EventLog to(a_ / link::kEventLog, 1);
      for (link::LoggedMessage m : before.messages())
        if (m.channel != "arm1.report" || change(m)) to.receive("s." + m.channel, m.bytes);
    }
    return ui::damage_of(ui::RunRecord(a_));
  };
  EXPECT_EQ(damage_with([](const auto&) { return true; }), "");
  {
    // After a stop a process goes on for a while: that is behind its fingerprint.
    link::EventLog to(a_ / link::kEventLog, 1);
    for (const link::LoggedMessage& m : before.messages()) to.receive("s." + m.channel, m.bytes);
    for (std::int64_t i = 1; i <= 3; ++i)
      log(to, "arm1.report", to_message(Report{}), 1, kMacrosteps + i, kMacrosteps + i);
  }
  EXPECT_EQ(ui::damage_of(ui::RunRecord(a_)), "");
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto number = std::uniform_int_distribution<std::int64_t>(1, kMacrosteps)(random);
    const auto is_it = [&](const link::LoggedMessage& m) {
      return link::header_of(m.bytes).number == number;
    };
    EXPECT_EQ(damage_with([&](link::LoggedMessage& m) {
                if (is_it(m))
                  m.bytes[std::uniform_int_distribution<std::size_t>(48, m.bytes.size() - 1)(random)] ^= 1;
                return true;
              }),
              "arm1.report has not the bytes that edp-arm1 sent");
    EXPECT_EQ(damage_with([&](const link::LoggedMessage& m) { return !is_it(m); }),
              fmt::format("arm1.report has {} messages, edp-arm1 sent {}", kMacrosteps - 1, kMacrosteps));
  }
}

TEST_F(RunFolder, CompareNamesTheFirstMessageThatDiffersAndTheFigures) {
  EXPECT_EQ(run({"compare", a_.string(), make("same", 77, 0).string()}), 0) << out_.str();
  EXPECT_EQ(run({"compare", a_.string(), make("other", 2, 0.5).string(), "--json"}), 1);
  const Json j = Json::parse(out_.str());
  EXPECT_TRUE(documented("log compare A B", j, {"figures"}));
  EXPECT_EQ(j.at("differences"), 10);
  EXPECT_EQ(j.at("first").at("channel"), "arm1.report");
  EXPECT_EQ(j.at("first").at("number"), 41);
  EXPECT_EQ(j.at("first").at("field"), "F_a[2]");
  EXPECT_EQ(j.at("figures").at("hold_N"), (Json{"4", "4.5"}));
}

TEST_F(RunFolder, CompareCountsNoMessageTwiceWhateverTheRunsAre) {
  const fs::path b = make("b", 3, 0);
  {
    link::EventLog to(b / link::kEventLog,
                      3);  // another task: other channels, and a message that was sent again
    for (std::int64_t i = 1; i <= 70; ++i) log(to, "arm9.report", to_message(Report{}), 3, i, i);
    log(to, "arm9.report", to_message(Report{}), 3, 70, 70);
  }
  std::ofstream(b / "processes.json") << R"({"task": "weigh", "clock": "step", "processes": []})";
  EXPECT_EQ(run({"compare", a_.string(), b.string(), "--json"}), 1);
  const Json j = Json::parse(out_.str());
  EXPECT_EQ(j.at("compared"), j.at("differences"));
  EXPECT_EQ(j.at("compared"), j.at("only_in_a").get<int>() + j.at("only_in_b").get<int>());
  EXPECT_EQ(j.at("only_in_b"), 70);
  EXPECT_EQ(j.at("only_in_a"), 2 * kMacrosteps);
  EXPECT_EQ(run({"compare", a_.string(), b.string()}), 1);
  EXPECT_NE(out_.str().find("two tasks: A is a run of press, B of weigh"), std::string::npos) << out_.str();
  EXPECT_NE(out_.str().find("170 messages compared, 170 differ: 100 only in A, 70 only in B"),
            std::string::npos)
      << out_.str();
}

TEST_F(RunFolder, PlotTakesAnyNameOfAPictureButItsScripts) {
  for (const char* wrong : {"x.gp", "x.jpg", "x", "nowhere/x.png"}) {
    EXPECT_EQ(run({"plot", a_.string(), "force", "--output", (home_ / wrong).string()}), 2);
    EXPECT_FALSE(fs::exists(home_ / wrong)) << wrong;
    EXPECT_FALSE(fs::exists(home_ / "nowhere"));
  }
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  const fs::path odd = home_ / "it's \"so\".png";
  EXPECT_EQ(run({"plot", a_.string(), "force", "--output", odd.string(), "--json"}), 0) << err_.str();
  EXPECT_TRUE(fs::exists(odd));
  EXPECT_EQ(Json::parse(out_.str())["picture"], odd.string());
  EXPECT_TRUE(documented("log plot RUN WHAT", Json::parse(out_.str())));
}

TEST_F(RunFolder, PlotDrawsArmsWhoseNamesMeanSomethingElseToGnuplot) {
  const std::string odd = "arm-1's_$x_2<<EOD";  // channels have no blanks
  {
    const link::LogReader before(a_);
    link::EventLog to(a_ / link::kEventLog, before.session_id());
    for (const link::LoggedMessage& m : before.messages())
      to.receive(m.channel == "arm1.report" ? "s." + odd + ".report" : "s." + m.channel, m.bytes);
  }
  const fs::path picture = home_ / "odd.png";
  const int status = run({"plot", a_.string(), "force", "--output", picture.string()});
  std::ifstream in(home_ / "odd.gp");
  const std::string script{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(script.find("\n$table1 << EOD\n"), std::string::npos) << script.substr(0, 600);
  EXPECT_NE(script.find("set label 'arm-1''s\\_$x\\_2<<EOD: "), std::string::npos) << script;
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_EQ(status, 0) << err_.str();
  EXPECT_TRUE(fs::exists(picture));
}

TEST_F(RunFolder, CheckAsksEveryProgramAndJoinsTheVerdicts) {
  std::vector<std::string> asked;
  const ui::RunRecord record(a_);
  const auto verdicts = ui::check_run(record, [&](const std::string& program, const auto& arguments) {
    asked.push_back(program + " " + arguments.at(0) + " " + arguments.at(arguments.size() - 1));
    link::LogVerdict v{.process = program, .compared = 10};
    if (program == "ecp_press") {
      v.differences = 2;
      v.first = link::LogDifference{.channel = "arm1.command",
                                    .number = 4,
                                    .stamp = 5,
                                    .behaviour = "2, settle",
                                    .function = "f_ce",
                                    .field = "arm.n_s",
                                    .logged = "10",
                                    .recomputed = "9"};
    }
    return link::to_json(v);
  });
  EXPECT_EQ(asked, (std::vector<std::string>{"press --check step", "ecp_press --check ecp-arm1"}));
  EXPECT_EQ(ui::report_check(a_, verdicts, {}, "", false, out_), 1);
  for (const char* what : {"2 DIFFER", "behaviour 2, settle", "f_ce", "field arm.n_s",
                           "logged 10, recomputed 9", "20 messages recomputed, 2 differ"})
    EXPECT_NE(out_.str().find(what), std::string::npos) << out_.str();
  out_.str("");
  EXPECT_EQ(ui::report_check(a_, verdicts, {}, "", true, out_), 1);
  EXPECT_TRUE(documented("log check RUN", Json::parse(out_.str())));
}

// A difference is then what was changed in the programs, and the run is not to blame.
TEST_F(RunFolder, CheckTellsThatTheProgramsHaveChangedSinceTheRun) {
  Json run = Json::parse(std::ifstream(a_ / "processes.json"));
  run["processes"][0]["build_id"] = "0a1b";
  run["processes"][1]["build_id"] = "2c3d";
  std::ofstream(a_ / "processes.json") << run;
  const ui::RunRecord record(a_);
  const auto with = [&](const std::string& of_press, const std::string& of_ecp) {
    return ui::changed_programs(
        record, [&](const std::string& program) { return program == "press" ? of_press : of_ecp; });
  };
  EXPECT_TRUE(with("0a1b", "2c3d").empty());
  EXPECT_TRUE(with("", "").empty()) << "what is not known is not told";
  EXPECT_EQ(with("0a1b", "4e5f"), std::vector<std::string>{"ecp-arm1"});
  EXPECT_EQ(ui::changed_programs_line({}), "");
  EXPECT_EQ(
      ui::changed_programs_line(with("9", "9")).find("this log is of other programs: mp, ecp-arm1 have"), 0U);
  EXPECT_TRUE(ui::changed_programs(ui::RunRecord(make("b", 2, 0)),
                                   [](const std::string&) { return std::string("1"); })
                  .empty())
      << "a log of an older version does not tell";
  EXPECT_EQ(ui::report_check(a_, {{.process = "mp", .compared = 1}}, {"mp"}, "", true, out_), 0);
  EXPECT_EQ(Json::parse(out_.str()).at("changed_programs"), Json({"mp"}));
}

TEST_F(RunFolder, ARunOfWhichNothingCanBeCheckedIsNotTakenForOneWithoutADifference) {
  std::vector<link::LogVerdict> verdicts{
      {.process = "mp", .not_checked = "the run went by the wall clock"},
      {.process = "simulator", .not_checked = "the run went by the wall clock"}};
  EXPECT_EQ(ui::report_check(a_, verdicts, {}, "", true, out_), 1);
  const Json none = Json::parse(out_.str());
  EXPECT_EQ(none.at("checked"), false);
  EXPECT_EQ(none.at("differences"), nullptr);
  EXPECT_EQ(none.at("complete"), false);
  out_.str("");
  EXPECT_EQ(ui::report_check(a_, verdicts, {}, "", false, out_), 1);
  EXPECT_NE(out_.str().find("NOT CHECKED"), std::string::npos) << out_.str();
  EXPECT_EQ(out_.str().find("differ"), std::string::npos) << out_.str();
  out_.str("");
  verdicts[0] = {.process = "mp", .compared = 10};
  EXPECT_EQ(ui::report_check(a_, verdicts, {}, "", true, out_), 0)
      << "links that are not in the log are no fault";
  const Json some = Json::parse(out_.str());
  EXPECT_EQ(some.at("checked"), true);
  EXPECT_EQ(some.at("differences"), 0);
}

TEST_F(RunFolder, AFolderThatIsNoneIsToldWhatItLacksAndWhereRunsAre) {
  const auto error = [&](const fs::path& folder) {
    EXPECT_EQ(run({"show", folder.string()}), 2);
    return err_.str();
  };
  const fs::path before = fs::current_path(), bare = home_ / "bare";
  fs::current_path(home_);
  EXPECT_NE(error("nowhere").find("there is no folder nowhere"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("there are none here"), std::string::npos) << err_.str();
  fs::create_directories("runs");
  fs::rename(make("older", 1, 0), "runs/older");
  fs::rename(make("newer", 1, 0), "runs/newer");
  fs::last_write_time(fs::path("runs/older") / link::kEventLog,
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  fs::create_directories(bare);
  EXPECT_NE(error(bare).find("it has no events.lcmlog"), std::string::npos) << err_.str();
  EXPECT_NE(err_.str().find("the newest here is runs/newer"), std::string::npos) << err_.str();
  std::ofstream(bare / link::kEventLog) << "x";
  EXPECT_NE(error(bare).find("it has no config.toml"), std::string::npos) << err_.str();
  fs::current_path(before);
}

TEST_F(RunFolder, ProgramsOfARunAreThoseBesideThisOneAndNoOthers) {
  const auto write = [&](const std::string& task, const std::string& program) {
    std::ofstream(a_ / "processes.json")
        << Json{{"task", task},
                {"clock", "step"},
                {"processes", {{{"name", "mp"}, {"program", program}, {"arguments", Json::array()}}}}};
  };
  write("press", "press");
  EXPECT_EQ(bad_run(a_), "");
  for (const char* elsewhere : {"/bin/true", "../press", "bin/press", "./press", "..", ".", "press/", ""}) {
    write("press", elsewhere);
    EXPECT_EQ(bad_run(a_), "bad_log") << elsewhere;
    write(elsewhere, "press");
    EXPECT_EQ(bad_run(a_), "bad_log") << elsewhere;
  }
}

TEST_F(RunFolder, AWordThatIsMissingIsNamedWithALineToType) {
  const auto said_of = [&](const std::vector<std::string>& words) {
    EXPECT_EQ(run(words), 2);
    return err_.str();
  };
  const std::string whole = " type for example `ui_cli log ";
  for (const char* command : {"show", "csv", "check"})
    EXPECT_NE(said_of({command}).find("error: bad_usage: RUN ("), std::string::npos) << err_.str();
  EXPECT_NE(said_of({"show"}).find(whole + "show runs/"), std::string::npos) << err_.str();
  EXPECT_NE(said_of({"compare", "one"}).find("B (another) is missing;" + whole + "compare runs/"),
            std::string::npos)
      << err_.str();
  EXPECT_NE(said_of({"plot", "one"}).find("behaviours of platforms) is missing;" + whole), std::string::npos)
      << err_.str();
  EXPECT_NE(said_of({}).find("a command is missing; there are show, csv, plot, compare and check;" + whole),
            std::string::npos)
      << err_.str();
  EXPECT_NE(said_of({"show", "one", "--channel"}).find("a value is missing behind --channel"),
            std::string::npos)
      << err_.str();
}

TEST_F(RunFolder, WhatIsNoRunFolderIsRefused) {
  EXPECT_EQ(bad_run(home_), "bad_log");
  EXPECT_EQ(run({"show", (home_ / "nothing").string()}), 2);
  EXPECT_EQ(run({"dance"}), 2);
  EXPECT_EQ(run({}), 2);
  fs::remove(a_ / "processes.json");
  EXPECT_EQ(run({"check", a_.string()}), 2);
  EXPECT_NE(err_.str().find("processes.json"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::test
