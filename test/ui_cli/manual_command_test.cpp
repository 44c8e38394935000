// Instructions by hand from the terminal.
#include "ui_cli/manual_command.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/config.hpp"
#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/manual_answer_t.hpp"
#include "mrroc/manual_words_t.hpp"
#include "test/docs/json_table.hpp"
#include "ui_cli/homing_progress.hpp"
#include "ui_cli/manual_link.hpp"
#include "ui_cli/manual_page.hpp"
#include "ui_cli/manual_show.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;

/// MP of the task, which answers with the states it is given, one per message; the last one stays.
class Answering {
 public:
  Answering(link::MemoryHub& hub, std::vector<int> states, DriverState driver)
      : bus_(hub.open()),
        in_(*bus_, {link::Group::agents, "m.manual.words"}, 9),
        out_(*bus_, {link::Group::agents, "m.manual.answer"}, 9),
        reply_(*bus_, {link::Group::agents, "m.arm1.reply"}, 9),
        thread_([this, driver, states = std::move(states)](const std::stop_token& stop) {
          std::size_t k = 0;
          while (!stop.stop_requested()) {
            bus_->wait(2ms);
            while (const auto m = in_.take()) {
              heard = link::get_text(m->text);
              if (all.empty() || all.back() != heard) all.push_back(heard);
              manual_answer_t a{};
              a.id = m->id;
              a.state = states[std::min(k++, states.size() - 1)];
              link::put_text(a.text, a.state == 0   ? "arm1 is busy"
                                     : a.state == 3 ? "arm1: non-fatal joint_limit: beyond"
                                                    : "done");
              out_.publish(a, 0);
            }
            EffectorReply r;
            r.state = driver;
            r.position_known = driver != DriverState::not_synchronised && driver != DriverState::homing;
            r.joints[1] = -1.57;
            r.joints[5] = 0.25;
            reply_.publish(to_message(r), 1);
          }
        }) {}
  void end() {
    thread_.request_stop();
    thread_.join();
  }
  std::string heard;
  std::vector<std::string> all;  ///< each once

 private:
  std::unique_ptr<link::Bus> bus_;
  link::Queue<manual_words_t> in_;
  link::Outbox<manual_answer_t> out_;
  link::Outbox<effector_reply_t> reply_;
  std::jthread thread_;
};

std::string execute(std::vector<int> states, const std::vector<std::string>& arguments,
                    std::string* heard = nullptr, const std::filesystem::path& run_folder = {},
                    std::vector<std::string>* all = nullptr, DriverState driver = DriverState::holding,
                    std::chrono::milliseconds told = 10s) {
  link::MemoryHub hub;
  Answering task(hub, std::move(states), driver);
  const auto bus = hub.open();
  std::ostringstream out;
  std::string result;
  try {
    ui::execute_manual(*bus, {"m", 9, {}, {}, run_folder, 0}, ui::read_manual_words(arguments),
                       {.repeat = 2ms, .give_up = 10s, .told = told, .progress = told}, out);
    result = out.str();
  } catch (const FaultError& e) {
    result = e.error_line();
  }
  task.end();
  if (heard) *heard = task.heard;
  if (all) *all = task.all;
  return result;
}

TEST(ManualCommand, OfATaskThatTakesNoInstructionsItIsToldAtOnceWhatItHas) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("no_arms.{}", ::getpid());
  const auto error_of = [&](const std::string& config, const std::vector<std::string>& arguments) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "config.toml") << config;
    link::MemoryHub hub;
    const auto bus = hub.open();
    std::ostringstream out;
    try {
      ui::execute_manual(*bus, {"m", 9, {}, "rex_drive", folder, 0}, ui::read_manual_words(arguments),
                         {.repeat = 2ms, .give_up = 100ms}, out);
    } catch (const FaultError& e) {
      return std::string(e.error_line());
    }
    return out.str();
  };
  const std::string platform = "[robots]\norder = []\n[platforms]\norder = [\"rex\"]\n";
  const std::string arm = "[robots]\norder = [\"arm1\"]\n";
  for (const std::vector<std::string>& words : {std::vector<std::string>{"home", "all"},
                                                {"show", "rex"},
                                                {"save", "rex", "x.txt"},
                                                {"load", "x.txt"}})
    EXPECT_TRUE(
        error_of(platform, words).starts_with("error: illegal_in_state: the task rex_drive has no arms"))
        << words.front() << ": " << error_of(platform, words);
  EXPECT_TRUE(error_of(arm, {"home", "all"})
                  .starts_with("error: illegal_in_state: the task rex_drive moves its arms"));
  EXPECT_TRUE(error_of(arm, {"show", "arm1"}).starts_with("error: peer_silent")) << "it can be looked at";
  std::filesystem::remove_all(folder);
}

TEST(ManualCommand, WaitsUntilItIsDoneAndKeepsNegativeNumbers) {
  std::string heard;
  EXPECT_EQ(execute({1, 1, 1, 2}, {"jog", "arm1", "motors", "-1", "0", "-0.5", "0", "0", "0"}, &heard),
            "done\n");
  EXPECT_EQ(heard, "jog arm1 motors -1 0 -0.5 0 0 0");
  EXPECT_EQ(execute({1}, {"--no-wait", "home", "all"}), "done\n") << "the text of the first answer";
  const auto json = nlohmann::json::parse(execute({2}, {"bias", "arm1", "--json"}));
  EXPECT_EQ(json.at("done"), true);
  EXPECT_TRUE(documented("manual INSTRUCTION", json));
}

TEST(ManualCommand, SaysWhileItWaitsThatItWaits) {
  const std::vector<int> states(50, 1);  // taken, for as many sendings
  const auto when = [&](const std::vector<std::string>& arguments) {
    auto all = states;
    all.push_back(2);
    return execute(all, arguments, nullptr, {}, nullptr, DriverState::holding, 0ms);
  };
  const std::string text = when({"home", "arm1"});
  EXPECT_EQ(text.find("taken, and not done yet"), 0U) << text;
  EXPECT_NE(text.find("\ndone\n"), std::string::npos) << text;
  EXPECT_EQ(when({"home", "arm1", "--json"}).find("not done yet"), std::string::npos);
  EXPECT_EQ(when({"--no-wait", "home", "arm1"}).find("not done yet"), std::string::npos);
}

TEST(ManualCommand, TellsHowFarHomingIsAgainAndAgain) {
  std::string pattern = ::testing::TempDir() + "/homing.XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "config.toml") << "[robots]\norder = ['arm1']\n[robots.arm1]\naxes = 7\n";
  std::vector<int> states(50, 1);
  states.push_back(2);
  const auto homed = [&](DriverState driver) {
    return execute(states, {"home", "all"}, nullptr, folder, nullptr, driver, 0ms);
  };
  EXPECT_NE(homed(DriverState::homing).find("\narm1 axis 1 of 7\n"), std::string::npos);
  EXPECT_EQ(homed(DriverState::holding).find("axis"), std::string::npos) << "it is not homing";
  std::filesystem::remove_all(folder);
}

TEST(HomingProgress, CountsTheMotorsThatHaveMovedOneAfterTheOther) {
  ui::HomingProgress progress(
      {{.name = "arm1", .axes = 6, .presets = {}}, {.name = "arm2", .axes = 7, .presets = {}}});
  EffectorReply r;
  progress.see("arm1", r);
  EXPECT_EQ(progress.text(), "") << "nobody is homing";
  r.state = DriverState::homing;
  r.motors = {10, 20, 30, 40, 50, 60, 0, 0};
  progress.see("arm1", r);
  progress.see("nobody", r);
  EXPECT_EQ(progress.text(), "arm1 axis 1 of 6");
  r.motors[5] += 30;
  r.motors[0] += 0.1;  // holds its axis
  progress.see("arm1", r);
  EXPECT_EQ(progress.text(), "arm1 axis 1 of 6");
  r.motors[5] -= 30;  // back where it began
  r.motors[0] -= 5;
  progress.see("arm1", r);
  progress.see("arm2", r);
  EXPECT_EQ(progress.text(), "arm1 axis 2 of 6, arm2 axis 1 of 7");
  r.state = DriverState::ready;
  progress.see("arm1", r);
  EXPECT_EQ(progress.text(), "arm2 axis 1 of 7");
}

TEST(ManualCommand, ARefusalAndAFailureAreErrorsWithTheirReason) {
  EXPECT_NE(execute({0}, {"bias", "arm1"}).find("refused: arm1 is busy"), std::string::npos);
  EXPECT_EQ(execute({1, 3}, {"bias", "arm1"})
                .find("error: joint_limit: bias arm1 failed: arm1: non-fatal joint_limit: beyond"),
            0U)
      << "with the driver's own code";
  const std::string unknown = execute({4}, {"fly", "arm1"});
  EXPECT_EQ(unknown.find("error: bad_usage: fly arm1: "), 0U);
  EXPECT_NE(unknown.find("show, save, teach and load are words of this terminal"), std::string::npos)
      << unknown;
  EXPECT_EQ(execute({0}, {"bias", "arm1"}).find("error: illegal_in_state"), 0U);
}

TEST(ManualCommand, ShowsAnArm) {
  const auto json = nlohmann::json::parse(execute({2}, {"show", "arm1", "--json"}));
  EXPECT_EQ(json.at("state"), "holding");
  EXPECT_TRUE(documented("manual show ARM", json));
  EXPECT_EQ(json.at("joints").at(1), -1.57);
  EXPECT_NE(execute({2}, {"show", "arm1"}).find("joints"), std::string::npos);
}

TEST(ManualCommand, ShowsTheFaultAndWhatTheDriverWorksWith) {
  EffectorReply r;
  r.state = DriverState::faulted;
  r.fault = {.code = FaultCode::over_current, .axis = 2, .value = 9, .limit = 8, .text = "current [A]"};
  r.robot_model.tool_representation = Representation::xyz_angle_axis;
  r.robot_model.tool = {0, 0, 0.25, 0, 0, 0.5};
  r.robot_model.weight = 7;
  r.robot_model.mass_centre = {0, 0, 0.125};
  r.robot_model.kinematic_model = 1;
  r.robot_model.set_servo_algorithm = 0b111111;
  r.robot_model.servo_algorithm[2] = 1;
  const auto told = [&](bool json) {
    std::ostringstream out;
    ui::show_arm(r, "arm1", json, out);
    return out.str();
  };
  const auto json = nlohmann::json::parse(told(true));
  EXPECT_EQ(json.at("fault").at("code"), "over_current");
  const std::vector<double> tool = json.at("tool");
  ASSERT_EQ(tool.size(), 6U);
  for (std::size_t k = 0; k < tool.size(); ++k)
    EXPECT_NEAR(tool[k], (std::array<double, 6>{0, 0, 0.25, 0, 0, 0.5})[k], 1e-12) << k;
  EXPECT_EQ(json.at("weight"), 7);
  EXPECT_EQ(json.at("mass_centre").at(2), 0.125);
  EXPECT_EQ(json.at("kinematic_model"), 1);
  ASSERT_EQ(json.at("servo").size(), 6U);
  EXPECT_EQ(json.at("servo").at(2).at("algorithm"), 1);
  for (const char* what : {"over_current", "0.2500", "7.0000  N", "1  of the kinematics", "0 0, 0 0, 1 0"})
    EXPECT_NE(told(false).find(what), std::string::npos) << what << "\n" << told(false);
  r = {};
  EXPECT_EQ(nlohmann::json::parse(told(true))["fault"], nullptr);
  EXPECT_EQ(nlohmann::json::parse(told(true))["tool"], nullptr) << "the driver has not told it";
}

TEST(ManualCommand, AFileThatCannotBeLoadedIsToldWithWhatItShouldHold) {
  const std::filesystem::path folder = ::testing::TempDir();
  const auto load = [&](const std::string& name, std::vector<int> states = {2}) {
    return execute(std::move(states), {"load", (folder / name).string()});
  };
  for (const char* name : {"nowhere.txt", "."}) {
    EXPECT_EQ(load(name).find("error: bad_script: cannot read "), 0U) << load(name);
    EXPECT_NE(load(name).find("an instruction per line"), std::string::npos) << load(name);
  }
  std::ofstream(folder / "nothing.txt") << "# only a comment\n";
  EXPECT_NE(load("nothing.txt").find("holds no instruction"), std::string::npos) << load("nothing.txt");
  std::ofstream(folder / "bad.txt") << "# first\n\ndance arm1\n";
  EXPECT_NE(load("bad.txt", {4}).find("bad.txt:3: dance arm1: "), std::string::npos) << load("bad.txt", {4});
  std::ofstream(folder / "long.txt") << "bias " << std::string(240, 'a') << "\n";
  EXPECT_NE(load("long.txt").find("long.txt:1: an instruction has at most 239 characters, and this one 245"),
            std::string::npos)
      << load("long.txt");
}

TEST(ManualCommand, ShowsTheAxesThatTheArmHas) {
  EffectorReply reply;
  reply.motors = {1, 2, 3, 4, 5, 6, 0, 0};
  reply.joints = reply.motors;
  for (const auto& [told, axes] : {std::pair{63, 6U}, {255, 8U}, {0, 8U}}) {  // 0: the driver has not told
    reply.robot_model.set_servo_algorithm = static_cast<std::uint8_t>(told);
    std::ostringstream out;
    ui::show_arm(reply, "arm1", true, out);
    const auto json = nlohmann::json::parse(out.str());
    EXPECT_EQ(json.at("motors").size(), axes) << told;
    EXPECT_TRUE(json.at("joints").is_null() || json.at("joints").size() == axes) << told;
  }
}

TEST(ManualCommand, ShowsNoPositionBeforeHoming) {
  const auto show = [](const std::vector<std::string>& words) {
    return execute({2}, words, nullptr, {}, nullptr, DriverState::not_synchronised);
  };
  const auto json = nlohmann::json::parse(show({"show", "arm1", "--json"}));
  for (const char* what : {"joints", "T_0E", "euler"}) EXPECT_TRUE(json.at(what).is_null()) << what;
  EXPECT_TRUE(json.at("motors").is_array());
  const std::string text = show({"show", "arm1"});
  EXPECT_NE(text.find("joints              -  rad, m\n"), std::string::npos) << text;
}

TEST(ManualLink, HearsItsOwnSessionOnlyAndLearnsItsNumberWhereItIsNotKnown) {
  link::MemoryHub hub;
  const auto bus = hub.open(), task_bus = hub.open();
  ui::ManualLink link(*bus, {"m", 9, {}, {}, {}, 0}, {"arm1"}),
      unnamed(*bus, {"m", 0, {}, {}, {}, 0}, {"arm1"});
  link::Queue<manual_words_t> words(*task_bus, {link::Group::agents, "m.manual.words"}, 9);
  const auto now = ui::Clock::now();
  link.begin("bias arm1", now);
  EXPECT_FALSE(link.poll(now));
  while (task_bus->wait(0ms)) {
  }
  const auto sent = words.take();
  ASSERT_TRUE(sent);
  const auto say = [&](std::int64_t session, double joint) {
    link::Outbox<manual_answer_t> out(*task_bus, {link::Group::agents, "m.manual.answer"}, session);
    link::Outbox<effector_reply_t> reply(*task_bus, {link::Group::agents, "m.arm1.reply"}, session);
    manual_answer_t a{};
    a.id = sent->id;
    a.state = static_cast<int>(InstructionState::done);
    out.publish(a, 0);
    EffectorReply r;
    r.joints[0] = joint;
    reply.publish(to_message(r), 1);
    while (bus->wait(0ms)) {
    }
  };
  say(8, 0.5);
  EXPECT_FALSE(link.poll(now)) << "another session's answer";
  EXPECT_FALSE(link.reading("arm1")) << "another session's arm";
  EXPECT_EQ(unnamed.reading("arm1")->joints[0], 0.5);
  say(9, 0.25);
  EXPECT_TRUE(link.poll(now));
  EXPECT_EQ(link.reading("arm1")->joints[0], 0.25);
  EXPECT_EQ(unnamed.reading("arm1")->joints[0], 0.5) << "it stays with the session that it has met";
}

TEST(ManualCommand, ShowsAllArms) {
  std::string pattern = (std::filesystem::temp_directory_path() / "manual_command.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "config.toml") << "[robots]\norder = ['arm1']\n[robots.arm1]\naxes = 6\n";
  const auto json = nlohmann::json::parse(execute({2}, {"show", "all", "--json"}, nullptr, folder));
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json.at(0).at("arm"), "arm1");
  EXPECT_NE(execute({2}, {"show", "all"}, nullptr, folder).find("joints"), std::string::npos);
  EXPECT_EQ(execute({2}, {"show", "arm3"}, nullptr, folder)
                .find("error: bad_usage: there is no arm 'arm3'; there are arm1 and all"),
            0U);
  EXPECT_NE(execute({2}, {"show", "all"}, nullptr, folder / "elsewhere").find("name one"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(ManualCommand, SavesPositionsAndGoesToThemAgain) {
  std::string pattern = (std::filesystem::temp_directory_path() / "manual_command.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "config.toml") << "[robots]\norder = ['arm1']\n[robots.arm1]\naxes = 6\n";
  const std::string file = (folder / "positions").string();
  std::ofstream(file) << "# two places\nbias arm1   # first\n\n";
  const std::string there = "move arm1 joints 0.000000 -1.570000 0.000000 0.000000 0.000000 0.250000";
  EXPECT_EQ(execute({2}, {"save", "arm1", file}, nullptr, folder), there + "\n");
  std::vector<std::string> all;
  EXPECT_EQ(execute({1, 2}, {"load", file}, nullptr, folder, &all), "bias arm1: done\n" + there + ": done\n");
  EXPECT_EQ(all, (std::vector<std::string>{"bias arm1", there}));
  EXPECT_NE(execute({2, 3}, {"load", file}, nullptr, folder).find("failed: arm1: non-fatal joint_limit"),
            std::string::npos);
  const auto loaded = nlohmann::json::parse(execute({2}, {"load", file, "--json"}));
  EXPECT_EQ(loaded.at("done"), 2);
  EXPECT_TRUE(documented("manual load FILE", loaded));
  EXPECT_TRUE(
      documented("manual save ARM FILE",
                 nlohmann::json::parse(execute({2}, {"save", "arm1", file, "--json"}, nullptr, folder))));
  EXPECT_EQ(execute({2}, {"save", "arm1", file}).find("error: bad_usage"), 0U) << "its axes are not known";
  const std::string nowhere = execute({2}, {"save", "arm1", "/no/such/file"}, nullptr, folder);
  EXPECT_EQ(nowhere.find("error: cannot_write"), 0U);
  EXPECT_EQ(nowhere.find("--run-dir"), std::string::npos) << nowhere;
  EXPECT_EQ(execute({2}, {"load", "/no/such/file"}).find("error: bad_script"), 0U);
  std::ofstream(file) << std::string(300, 'x');
  EXPECT_EQ(execute({2}, {"load", file}).find("error: bad_script"), 0U);
  std::filesystem::remove_all(folder);
}

TEST(ManualCommand, TeachesPositionsAsMotionsAndLosesNone) {
  std::string pattern = (std::filesystem::temp_directory_path() / "manual_command.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "config.toml") << "[robots]\norder = ['arm1']\n[robots.arm1]\naxes = 6\n";
  const std::string file = (folder / "taught.toml").string();
  const auto teach = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"teach", "arm1", file});
    return execute({2}, words, nullptr, folder);
  };
  EXPECT_EQ(teach({"joints"}), "position 1 of arm1 in " + file + "\n");
  EXPECT_EQ(teach({"joints"}), "position 2 of arm1 in " + file + "\n");
  Config edited = Config::load(file);
  edited.set("arm1.taught.generator=cubic");
  std::ofstream(file) << edited.dump();
  const auto told = nlohmann::json::parse(teach({"joints", "--json"}));
  EXPECT_EQ(told.at("positions"), 3);
  EXPECT_TRUE(documented("manual teach ARM FILE", told));
  const Config taught = Config::load(file);
  EXPECT_EQ(taught.list("arm1.start", Config::kRequired), (std::vector<double>{0, -1.57, 0, 0, 0, 0.25}));
  EXPECT_EQ(taught.list("arm1.taught.positions", Config::kRequired).size(), 12U);
  EXPECT_EQ(taught.texts("arm1.order", Config::kRequired), std::vector<std::string>{"taught"});
  EXPECT_EQ(taught.text("arm1.taught.generator", Config::kRequired), "cubic") << "what was added stays";
  EXPECT_NE(teach({"euler"}).find("are joints, and not xyz_euler_zyz"), std::string::npos);
  EXPECT_NE(teach({"sideways"}).find("'sideways' is no space"), std::string::npos);
  EXPECT_EQ(execute({2}, {"teach", "arm1", "/no/such/file"}, nullptr, folder).find("error: cannot_write"),
            0U);
  EXPECT_EQ(execute({2}, {"teach", "arm1", file}, nullptr, folder, nullptr, DriverState::homing)
                .find("error: illegal_in_state: arm1 does not know its position"),
            0U);
  std::ofstream(file) << "[[[";
  EXPECT_EQ(teach({}).find("error: bad_configuration"), 0U) << "a damaged file is left as it is";
  std::filesystem::remove_all(folder);
}

TEST(ManualCommand, SavesNothingDuringHoming) {
  std::string pattern = (std::filesystem::temp_directory_path() / "manual_command.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  std::ofstream(folder / "config.toml") << "[robots]\norder = ['arm1']\n[robots.arm1]\naxes = 6\n";
  const std::string file = (folder / "positions").string();
  const std::string error =
      execute({2}, {"save", "arm1", file}, nullptr, folder, nullptr, DriverState::homing);
  EXPECT_EQ(error.find("error: illegal_in_state: arm1 does not know its position, it is homing"), 0U)
      << error;
  EXPECT_FALSE(std::filesystem::exists(file));
  std::filesystem::remove_all(folder);
}

TEST(ManualCommand, BadWordsAreRefusedBeforeAnythingIsSent) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                {"show"},
                                                {"save", "arm1"},
                                                {"load", "a", "b"},
                                                {"home", "--fast"},
                                                {"home", "--session"},
                                                {std::string(300, 'x')}})
    EXPECT_THROW(static_cast<void>(ui::read_manual_words(words)), FaultError);
  const auto request =
      ui::read_manual_words({"home", "arm1", "--session", "x", "--url", "udpm://239.1.1.1:7?ttl=0"});
  EXPECT_EQ(request.session, "x");
  EXPECT_EQ(request.words, "home arm1");
}

}  // namespace
}  // namespace mrroc::test
