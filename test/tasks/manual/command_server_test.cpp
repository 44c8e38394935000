// Instructions from terminals: refused with a reason, obeyed once, answered until they are done, recorded.
#include "tasks/manual/command_server.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/link/text.hpp"
#include "tasks/manual/coordinator.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::manual {
namespace {

namespace fs = std::filesystem;

const std::vector<ArmInfo> kArms{{"arm1", 6, {{"front", {}}}}, {"arm2", 7, {{"front", {}}}, true}};

/// The command server, a terminal, and arms that say what the test wants.
struct CommandServerFixture {
  explicit CommandServerFixture(InstructionScript script = {}, const fs::path& record = {})
      : process(bus, {.session = "s", .session_id = 1, .name = "mp", .roster = {"mp"}}),
        command_server(process, kArms, std::move(script), record),
        words(bus, process.route(CommandServer::kWords), 1),
        answers(bus, process.route(CommandServer::kAnswer), 1) {
    for (Report& r : reports) r.driver_state = DriverState::holding;
  }
  /// The terminal says something, and a macrostep passes.
  Hands say(std::int64_t id, const std::string& text) {
    manual_words_t m{};
    m.id = id;
    link::put_text(m.text, text);
    words.publish(m, 0);
    return step();
  }
  Hands step() {
    process.poll();
    Hands hands = command_server.take(++i, given, reports, paused);
    for (std::size_t arm = 0; arm < given.size(); ++arm)
      if (hands.orders[arm]) ++given[arm];
    process.poll();
    return hands;
  }
  /// @return state and text of the last answer
  std::pair<int, std::string> answer() {
    std::pair<int, std::string> last{-1, ""};
    while (const auto a = answers.take()) {
      EXPECT_GE(a->header.stamp, 0) << "a macrostep, or none";
      last = {a->state, link::get_text(a->text)};
    }
    return last;
  }
  void done(std::size_t arm, const Fault& fault = {}) {
    reports[arm].event = static_cast<int>(given[arm]);
    reports[arm].fault = fault;
  }

  link::test::DirectBus bus;
  link::Process process;
  CommandServer command_server;
  link::Outbox<manual_words_t> words;
  link::Queue<manual_answer_t> answers;
  std::vector<std::int64_t> given{0, 0};
  std::vector<Report> reports = std::vector<Report>(2);
  std::int64_t i{};
  bool paused{};
};

TEST(ManualCommandServer, AnInstructionIsTakenOnceAndAnsweredUntilItIsDone) {
  CommandServerFixture fixture;
  EXPECT_TRUE(fixture.say(7, "bias arm1").orders[0]);
  EXPECT_EQ(fixture.answer().first, 1);
  EXPECT_FALSE(fixture.say(7, "bias arm1").orders[0]) << "the same message again";
  EXPECT_EQ(fixture.answer().first, 1);
  fixture.done(0);
  fixture.step();
  EXPECT_EQ(fixture.answer(), (std::pair{2, std::string("done")}));
  fixture.say(7, "bias arm1");
  EXPECT_EQ(fixture.answer().first, 2) << "an answer that was lost comes again";
}

TEST(ManualCommandServer, ABusyArmTakesNothingButAStop) {
  CommandServerFixture fixture;
  fixture.say(1, "home all");
  EXPECT_FALSE(fixture.say(2, "bias arm2").orders[1]);
  const auto [state, text] = fixture.answer();
  EXPECT_EQ(state, 0);
  EXPECT_NE(text.find("arm2 is busy"), std::string::npos);
  fixture.done(0);
  EXPECT_TRUE(fixture.say(3, "bias arm1").orders[0]) << "the other arm is free";
  EXPECT_TRUE(fixture.say(4, "stop arm2").orders[1]);
  fixture.reports[1].event = 2;
  fixture.step();
  fixture.answer();
  fixture.say(1, "home all");
  EXPECT_EQ(fixture.answer().first, 3);
}

TEST(ManualCommandServer, WhatAStopReplacesInTheSameMacrostepIsCalledOffAndNotDone) {
  CommandServerFixture fixture;
  const auto ask = [&](std::int64_t id, const std::string& text) {
    manual_words_t m{};
    m.id = id;
    link::put_text(m.text, text);
    fixture.words.publish(m, 0);
  };
  ask(1, "home all");
  ask(2, "stop arm2");
  ask(3, "stop arm2");
  const Hands hands = fixture.step();
  EXPECT_EQ(hands.orders[0]->kind, Kind::home);
  EXPECT_EQ(hands.orders[1]->kind, Kind::stop);
  fixture.done(1);
  fixture.step();
  fixture.answer();
  ask(1, "home all");
  fixture.step();
  EXPECT_EQ(fixture.answer().first, 1) << "arm1 goes on";
  fixture.done(0);
  fixture.step();
  fixture.answer();
  ask(1, "home all");
  fixture.step();
  EXPECT_EQ(fixture.answer(), (std::pair{3, std::string("arm2: called off")}));
  for (const std::int64_t stop : {2, 3}) {
    ask(stop, "stop arm2");
    fixture.step();
    EXPECT_EQ(fixture.answer().first, 2) << stop;
  }
}

TEST(ManualCommandServer, APauseRefusesWhatWouldBeginAtItsEndButNoStopAndNoEnd) {
  CommandServerFixture fixture;
  fixture.say(1, "home arm1");
  fixture.answer();
  fixture.paused = true;
  EXPECT_FALSE(fixture.say(2, "jog arm2 motors 1 0 0 0 0 0 0").orders[1]);
  auto [state, text] = fixture.answer();
  EXPECT_EQ(state, 0);
  EXPECT_NE(text.find("paused; resume first"), std::string::npos) << text;
  EXPECT_TRUE(fixture.say(3, "stop arm1").orders[0]);
  EXPECT_EQ(fixture.answer().first, 2) << "the arm stands already";
  EXPECT_TRUE(fixture.say(4, "end").end);
  CommandServerFixture scripted({{1, "bias arm1"}});
  scripted.paused = true;
  EXPECT_TRUE(scripted.step().orders[0]) << "a script's instruction is kept for the end of the pause";
}

TEST(ManualCommandServer, AFailureIsToldWithItsReason) {
  CommandServerFixture fixture;
  fixture.say(1, "model arm1 9");
  fixture.done(0, Fault{.code = FaultCode::unknown_model});
  fixture.step();
  const auto [state, text] = fixture.answer();
  EXPECT_EQ(state, 3);
  EXPECT_NE(text.find("arm1"), std::string::npos);
}

TEST(ManualCommandServer, ArmsThatAreNotHomedAreToldHowAndAllReasonsFit) {
  CommandServerFixture fixture;
  const auto fail = [&](std::int64_t id, FaultCode code) {
    fixture.say(id, "preset all front");
    for (const std::size_t arm : {0U, 1U}) fixture.done(arm, Fault{.code = code});
    fixture.step();
    return fixture.answer().second;
  };
  const std::string lost = fail(1, FaultCode::not_synchronised);
  for (const char* what : {"`ui_cli manual home arm1`", "`ui_cli manual home arm2` finds it"})
    EXPECT_NE(lost.find(what), std::string::npos) << lost;
  EXPECT_EQ(lost.find("SYNCHRO"), std::string::npos);
  const std::string far = fail(2, FaultCode::unreachable_pose);
  const auto says = [&](const std::string& arm) {
    return far.find(arm + ": unreachable_pose: " + what_happened(Fault{.code = FaultCode::unreachable_pose}));
  };
  EXPECT_NE(says("arm1"), std::string::npos) << far;
  EXPECT_NE(says("arm2"), std::string::npos) << far;
}

TEST(ManualCommandServer, AFaultedArmWaitsForItsReset) {
  CommandServerFixture fixture;
  fixture.reports[0].driver_state = DriverState::faulted;
  EXPECT_FALSE(fixture.say(1, "bias arm1").orders[0]);
  EXPECT_NE(fixture.answer().second.find("reset arm1"), std::string::npos);
  EXPECT_TRUE(fixture.say(2, "reset arm1").orders[0]);
  fixture.done(0);
  fixture.step();
  fixture.answer();
  EXPECT_TRUE(fixture.say(3, "stop arm1").orders[0]);
  fixture.done(0, Fault{.code = FaultCode::over_current});
  fixture.step();
  EXPECT_EQ(fixture.answer().first, 2) << "an arm that stands has obeyed a stop";
}

TEST(ManualCommandServer, WordsThatAreNotUnderstoodAreAnsweredWithTheRightOnesInOneLine) {
  CommandServerFixture fixture;
  fixture.say(1, "dance arm1");
  EXPECT_NE(fixture.answer().second.find("the verbs are home, move, jog"), std::string::npos);
  fixture.say(2, "gripper arm1 0.06");
  EXPECT_NE(fixture.answer().second.find("arm1 has no gripper"), std::string::npos);
  fixture.say(3, std::string(200, 'x') + " arm1");
  const std::string text = fixture.answer().second;
  EXPECT_TRUE(text.ends_with("reset, stop, end")) << text;
}

TEST(ManualCommandServer, NonsenseIsRefusedAndTheEndIsTaken) {
  CommandServerFixture fixture;
  fixture.say(1, "dance arm1");
  EXPECT_EQ(fixture.answer().first, 4);
  fixture.say(3, "jog arm1 cartesian 0 0 0");
  const auto [state, text] = fixture.answer();
  EXPECT_EQ(state, 4);
  EXPECT_NE(text.find("it is written `jog ARM"), std::string::npos) << text;
  EXPECT_TRUE(fixture.say(2, "end").end);
  EXPECT_EQ(fixture.answer().first, 2);
}

TEST(ManualCommandServer, WhatWasTakenIsWrittenDownAndReplaysTheSame) {
  std::string pattern = (fs::temp_directory_path() / "manual_command_server.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  {
    CommandServerFixture fixture({}, folder / "words");
    fixture.say(1, "bias arm1");
    fixture.say(2, "dance arm1");
    fixture.say(3, "gripper arm2 0.07");
  }
  const auto script = load_script(folder / "words", kArms);
  ASSERT_EQ(script.size(), 2U);
  CommandServerFixture again(script);
  EXPECT_TRUE(again.step().orders[0]);
  EXPECT_FALSE(again.step().orders[1]);
  EXPECT_EQ(again.step().orders[1]->value[0], 0.07);
  std::ofstream(folder / "bad") << "3 dance arm1\n";
  EXPECT_THROW(static_cast<void>(load_script(folder / "bad", kArms)), FaultError);
  fs::remove_all(folder);
}

TEST(ManualOperation, EndsAPauseWithItselfBecauseAnArmThatStandsHearsNoEnd) {
  Coordinator::X x;
  x.c.given = {ManualOrder{.number = 3}, ManualOrder{.number = 5}};
  x.T.agent.resize(2);
  x.T.hands.orders.resize(2);
  x.T.h.paused = true;
  EXPECT_EQ(kManualOperation.f_cT(x).order[0].m, static_cast<int>(SoloOrder::pause));
  const Coordinator::Said last = farewell(x);
  ASSERT_EQ(last.order.size(), 2U);
  for (const Order& order : last.order) {
    EXPECT_EQ(order.m, static_cast<int>(SoloOrder::work));
    EXPECT_TRUE(order.finished);
  }
  EXPECT_EQ(last.manual.at(1).number, 5) << "no arm begins anything";
}

TEST(ManualOperation, TellsTheOperatorWhatItWaitsFor) { EXPECT_FALSE(kManualOperation.until.empty()); }

}  // namespace
}  // namespace mrroc::manual
