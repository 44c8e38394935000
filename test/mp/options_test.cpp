#include "mp/options.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <filesystem>
#include <sstream>
#include <tuple>

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

TEST(TaskOptions, WordsThatExcludeEachOtherAreRefused) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--attended", "--unattended"}, {"--attended", "--script", "orders"}})
    EXPECT_NE(refusal(words), "") << words.front();
  TaskOptions o;
  EXPECT_EQ(refusal({"--attended", "--view", "--session", "mine"}, &o), "");
  EXPECT_TRUE(o.attended);
  EXPECT_TRUE(o.view);
  EXPECT_EQ(o.session, "mine");
  EXPECT_EQ(refusal({"--script", "orders"}, &o), "");
  EXPECT_EQ(o.script, "orders");
}

TEST(TaskOptions, WhoGivesTheOrdersIsSaid) {
  EXPECT_EQ(who_orders({}), "");
  TaskOptions o;
  o.script = "orders.txt";
  EXPECT_EQ(who_orders(o), ", orders from orders.txt");
  o.attended = true;
  EXPECT_NE(who_orders(o).find("waits for the operator"), std::string::npos);
}

/// @return the status of a task's main function, and what it was told
int status_of(std::vector<const char*> words, TaskOptions& o, const std::function<int()>& run) {
  CommandLine line("A task.", "press");
  add_task_options(line, o);
  words.insert(words.begin(), "press");
  return run_command_line(line, static_cast<int>(words.size()), const_cast<char**>(words.data()), run);
}

TEST(TaskCommandLine, IsReadBeforeTheTaskRunsAndItsStatusIsTheTasks) {
  TaskOptions o;
  EXPECT_EQ(status_of({"--seed", "9"}, o, [&] { return o.seed == 9 ? 5 : 6; }), 5);
}

TEST(TaskCommandLine, HelpAndWhatCannotBeMeantRunNothing) {
  TaskOptions o;
  const auto never = [] {
    ADD_FAILURE() << "it ran";
    return 0;
  };
  EXPECT_EQ(status_of({"--help"}, o, never), 0);
  EXPECT_EQ(status_of({"--no-such-option"}, o, never), 2);
  EXPECT_EQ(status_of({"--seed", "x"}, o, never), 2);
  EXPECT_EQ(status_of({"word"}, o, never), 2);
}

TEST(TaskCommandLine, AFaultOfTheTaskIsItsStatus) {
  TaskOptions o;
  EXPECT_EQ(status_of({}, o, []() -> int { throw FaultError(FaultCode::bad_configuration, "wrong"); }),
            exit_status(FaultCode::bad_configuration));
  EXPECT_EQ(status_of({}, o, []() -> int { throw std::runtime_error("unforeseen"); }),
            exit_status(FaultCode::internal_error));
}

TEST(TaskOptions, ASeedThatCannotBeIsRefusedByItsName) {
  for (const std::string seed : {"-1", "1.5", "x", "", "9223372036854775808", "99999999999999999999999"}) {
    const std::string why = refusal({"--seed=" + seed});
    EXPECT_NE(why.find("--seed"), std::string::npos) << seed << ": " << why;
  }
  EXPECT_NE(refusal({"--seed", "-1"}).find("--seed: '-1' is not a whole number from 0"), std::string::npos)
      << refusal({"--seed", "-1"});
}

TEST(TaskOptions, ARunFolderWithoutANameIsRefused) {
  EXPECT_NE(refusal({"--run-dir", ""}).find("names no folder; leave --run-dir out"), std::string::npos)
      << refusal({"--run-dir", ""});
}

TEST(TaskOptions, ASpeedThatCannotBeIsRefusedWithTheLimit) {
  for (const std::string speed : {"0", "-2", "1e9", "nan", "inf", "fast", "2x"}) {
    const std::string why = refusal({"--speed=" + speed});
    EXPECT_NE(why.find("up to 10000"), std::string::npos) << speed << ": " << why;
  }
}

TEST(TaskOptions, ALimitOfTimeIsASensibleNumberOfSeconds) {
  TaskOptions o;
  EXPECT_EQ(refusal({}, &o), "");
  EXPECT_EQ(o.max_time, 0);
  EXPECT_EQ(refusal({"--max-time", "2.5"}, &o), "");
  EXPECT_EQ(o.max_time, 2.5);
  for (const std::string time : {"0", "-2", "1e9", "nan", "inf", "long", "2s", ""}) {
    const std::string why = refusal({"--max-time=" + time});
    EXPECT_NE(why.find("--max-time"), std::string::npos) << time << ": " << why;
  }
}

TEST(TaskOptions, TheListOfParametersIsNoRunAndJsonIsForItAlone) {
  TaskOptions o;
  EXPECT_EQ(refusal({"--parameters", "--json"}, &o), "");
  EXPECT_TRUE(o.parameters && o.json);
  EXPECT_NE(refusal({"--json"}), "");
  EXPECT_EQ(refusal({"--strict", "--no-pictures"}, &o), "");
  EXPECT_TRUE(o.strict && o.no_pictures);
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

TEST(TaskOptions, WithoutWordsAreTheUsualOnes) {
  TaskOptions o;
  EXPECT_EQ(refusal({}, &o), "");
  EXPECT_EQ(o.seed, 1U);
  EXPECT_FALSE(o.seed_asked);
  EXPECT_EQ(o.clock, ClockKind::step);
  EXPECT_TRUE(o.run_dir.empty() && o.config_file.empty() && o.script.empty() && o.check.empty());
  EXPECT_TRUE(o.settings.empty() && o.hosts.empty());
  EXPECT_TRUE(o.separate);
  EXPECT_FALSE(o.separate_asked || o.attended || o.view || o.strict || o.parameters || o.json);
  EXPECT_EQ(o.session, "");
  EXPECT_EQ(o.url, "");
}

TEST(TaskOptions, EachTakesItsOwnWords) {
  TaskOptions o;
  EXPECT_EQ(refusal({"--seed",       "0",
                     "--run-dir",    "runs/first",
                     "--config",     "c.toml",
                     "--set",        "a=1",
                     "--set",        "b=2",
                     "--session",    "cell",
                     "--url",        "udpm://1.2.3.4:5?ttl=1",
                     "--host",       "far=ssh far",
                     "--host",       "near=sh",
                     "--unattended", "--processes",
                     "separate",     "--clock",
                     "step"},
                    &o),
            "");
  EXPECT_EQ(o.seed, 0U);
  EXPECT_TRUE(o.seed_asked);
  EXPECT_EQ(o.run_dir, "runs/first");
  EXPECT_EQ(o.config_file, "c.toml");
  EXPECT_EQ(o.settings, (std::vector<std::string>{"a=1", "b=2"}));
  EXPECT_EQ(o.session, "cell");
  EXPECT_EQ(o.url, "udpm://1.2.3.4:5?ttl=1");
  EXPECT_EQ(o.hosts, (std::vector<std::string>{"far=ssh far", "near=sh"}));
  EXPECT_FALSE(o.attended);
  EXPECT_TRUE(o.separate && o.separate_asked);
  EXPECT_EQ(o.clock, ClockKind::step);
  EXPECT_EQ(refusal({"--processes", "one"}, &o), "");
  EXPECT_FALSE(o.separate || o.separate_asked);
  EXPECT_NE(refusal({"--processes", "two"}), "");
  EXPECT_NE(refusal({"--clock", "sun"}), "");
}

TEST(TaskOptions, LimitsAreAllowedAndWhatIsBeyondIsNot) {
  TaskOptions o;
  EXPECT_EQ(refusal({"--speed", "10000"}, &o), "");
  EXPECT_EQ(o.speed, 10000);
  EXPECT_NE(
      refusal({"--speed", "10000.1"}).find("'10000.1' is neither max nor a number above 0 and up to 10000"),
      std::string::npos);
  EXPECT_EQ(refusal({"--max-time", "1000000"}, &o), "");
  EXPECT_EQ(o.max_time, 1e6);
  EXPECT_NE(
      refusal({"--max-time", "1000001"}).find("'1000001' is no number of seconds above 0 and up to 1e+06"),
      std::string::npos);
  EXPECT_NE(refusal({"--seed", "9223372036854775808"})
                .find("'9223372036854775808' is not a whole number from 0 to 9223372036854775807"),
            std::string::npos);
}

TEST(TaskCommandLine, AnOptionWithoutItsValueIsToldWithALineToType) {
  const auto line_for = [](const char* program, const char* option) {
    TaskOptions o;
    CommandLine line("A task.", program);
    add_task_options(line, o);
    std::string bread, degrees;  // the task's own
    line.option("--bread", bread, "");
    line.option("--degrees", degrees, "");
    std::vector<const char*> words{program, option};
    ::testing::internal::CaptureStderr();
    const int status = run_command_line(line, 2, const_cast<char**>(words.data()), [] { return 0; },
                                        {"./run bake --bread rye --degrees 230"});
    EXPECT_EQ(status, 2);
    const std::string err = ::testing::internal::GetCapturedStderr();
    const std::size_t from = err.find("type for example `");
    return from == std::string::npos ? err : err.substr(from, err.rfind('`') + 1 - from);
  };
  for (const auto& [program, option, words] :
       {std::tuple{"press", "--seed", "press --seed 2"},
        {"press", "--clock", "press --clock wall"},
        {"press", "--speed", "press --speed 1"},
        {"press", "--run-dir", "press --run-dir runs/first"},
        {"press", "--config", "press --config runs/first/config.toml"},
        {"press", "--set", "press --set task.force=8"},
        {"press", "--processes", "press --processes one"},
        {"press", "--script", "press --script orders.txt"},
        {"press", "--max-time", "press --script orders.txt --max-time 60"},
        {"press", "--json", "press --parameters --json"},
        {"press", "--session", "press --session cell"},
        {"press", "--host", "press --config cell.toml --host \"robot=ssh robot\""},
        {"press", "--url", "press --url udpm://239.255.76.67:7667?ttl=1"},
        {"bake", "--json", "bake --parameters --json"},
        {"bake", "--set", "press --set task.force=8"},
        {"bake", "--bread", "bake --bread rye --degrees 230"},
        {"bake", "--degrees", "bake --bread rye --degrees 230"}})
    EXPECT_EQ(line_for(program, option), std::string("type for example `./run ") + words + "`") << option;
}

TEST(TaskCommandLine, HelpTellsEveryOptionItsWordsAndTheExitStatus) {
  TaskOptions o;
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(status_of({"--help"}, o, [] { return 1; }), 0);
  std::istringstream in(::testing::internal::GetCapturedStdout());
  std::string help;
  for (std::string word; in >> word;) help += (help.empty() ? "" : " ") + word;
  for (const char* part :
       {"--seed N seed of everything random (default: that of the configuration, 1)",
        "step: lock-step, bit-identical (default); wall: 500 Hz of the monotonic clock",
        "--speed X|max simulated seconds per second in lock-step, or max (default)",
        "--run-dir DIR the run folder (default runs/TASK-TIME)",
        "--config FILE values over the built-in ones; the config.toml of a run: instead of them",
        "--set KEY=VALUE",
        "sets a value of the configuration; may be repeated",
        "separate processes over LCM (default), or all in one",
        "--attended",
        "a person at ui_cli gives start and triggers",
        "--unattended",
        "the scripted operator gives them (default)",
        "--script FILE",
        "if an order is missing and none comes within 10 s, a run in lock-step ends with script_ended",
        "--max-time S ends the run after so many simulated seconds with the fault time_limit",
        "time_limit (default: never)",
        "a figure that misses what is wanted makes the exit status 1",
        "instead of a run: list every parameter with its default, range and unit",
        "as JSON",
        "also show the task as a web page; prints its address",
        "--session NAME name for ui_cli --session (default: unique)",
        "--url udpm://HOST:PORT?ttl=N where the system talks (default: from the session's name)",
        "--host NAME=WORDS",
        "how programs start on a host of the configuration; may be repeated",
        "--check RUN instead of a run: recompute the coordinator's orders from a run folder's log",
        "Exit status: 0 done; 1 fault, stopped, or with --strict a figure missed;",
        "2 bad usage or input, nothing was started; 3 system error."})
    EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
}

TEST(TaskCommandLine, ATaskCanRelyOnStandardFilesAndOutlivesWritesThatFail) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(STDIN_FILENO);
    std::signal(SIGPIPE, SIG_DFL);
    std::signal(SIGXFSZ, SIG_DFL);
    TaskOptions o;
    const int status = status_of({}, o, [] {
      const bool open = ::fcntl(STDIN_FILENO, F_GETFD) >= 0;
      const bool survives = std::signal(SIGXFSZ, SIG_IGN) == SIG_IGN;
      return open && survives ? 0 : 1;
    });
    ::_exit(status);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(TaskCommandLine, WhatIsWrongIsOneErrorLine) {
  TaskOptions o;
  const auto told = [&](const std::vector<const char*>& words, const std::function<int()>& run) {
    ::testing::internal::CaptureStderr();
    std::ignore = status_of(words, o, run);
    return ::testing::internal::GetCapturedStderr();
  };
  const auto fails = []() -> int { throw FaultError(FaultCode::bad_configuration, "wrong", "mend it"); };
  const auto breaks = []() -> int { throw std::runtime_error("unforeseen"); };
  EXPECT_EQ(told({}, fails), "error: bad_configuration: wrong; mend it\n");
  EXPECT_TRUE(told({}, breaks).starts_with("error: internal_error: unforeseen"));
  EXPECT_TRUE(told({"--seed"}, fails).starts_with("error: bad_usage: "));
  EXPECT_EQ(told({}, [] { return 0; }), "");
}

}  // namespace
}  // namespace mrroc::mp
