// Instructions from terminals: refused with a reason, obeyed once, answered until they are done, recorded.
#include "tasks/manual/desk.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/link/text.hpp"
#include "tasks/manual/coordinator.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::manual {
namespace {

namespace fs = std::filesystem;

const std::vector<ArmInfo> kArms{{"arm1", 6, {{"front", {}}}}, {"arm2", 7, {{"front", {}}}, true}};

/// The desk, a terminal, and arms that say what the test wants.
struct Office {
  explicit Office(std::vector<ScriptedWords> script = {}, const fs::path& record = {})
      : process(bus, {.session = "s", .session_id = 1, .name = "mp", .roster = {"mp"}}),
        desk(process, kArms, std::move(script), record),
        words(bus, process.route(Desk::kWords), 1),
        answers(bus, process.route(Desk::kAnswer), 1) {
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
    Hands hands = desk.take(++i, given, reports, paused);
    for (std::size_t arm = 0; arm < given.size(); ++arm)
      if (hands.orders[arm]) ++given[arm];
    process.poll();
    return hands;
  }
  /// @return state and text of the last answer
  std::pair<int, std::string> answer() {
    std::pair<int, std::string> last{-1, ""};
    while (const auto a = answers.take()) last = {a->state, link::get_text(a->text)};
    return last;
  }
  void done(std::size_t arm, const Fault& fault = {}) {
    reports[arm].event = static_cast<int>(given[arm]);
    reports[arm].fault = fault;
  }

  link::test::DirectBus bus;
  link::Process process;
  Desk desk;
  link::Outbox<manual_words_t> words;
  link::Queue<manual_answer_t> answers;
  std::vector<std::int64_t> given{0, 0};
  std::vector<Report> reports = std::vector<Report>(2);
  std::int64_t i{};
  bool paused{};
};

TEST(ManualDesk, AnInstructionIsTakenOnceAndAnsweredUntilItIsDone) {
  Office office;
  EXPECT_TRUE(office.say(7, "bias arm1").orders[0]);
  EXPECT_EQ(office.answer().first, 1);
  EXPECT_FALSE(office.say(7, "bias arm1").orders[0]) << "the same message again";
  EXPECT_EQ(office.answer().first, 1);
  office.done(0);
  office.step();
  EXPECT_EQ(office.answer(), (std::pair{2, std::string("done")}));
  office.say(7, "bias arm1");
  EXPECT_EQ(office.answer().first, 2) << "an answer that was lost comes again";
}

TEST(ManualDesk, ABusyArmTakesNothingButAStop) {
  Office office;
  office.say(1, "home all");
  EXPECT_FALSE(office.say(2, "bias arm2").orders[1]);
  const auto [state, text] = office.answer();
  EXPECT_EQ(state, 0);
  EXPECT_NE(text.find("arm2 is busy"), std::string::npos);
  office.done(0);
  EXPECT_TRUE(office.say(3, "bias arm1").orders[0]) << "the other arm is free";
  EXPECT_TRUE(office.say(4, "stop arm2").orders[1]);
  office.reports[1].event = 2;
  office.step();
  office.answer();
  office.say(1, "home all");
  EXPECT_EQ(office.answer().first, 3);
}

TEST(ManualDesk, WhatAStopReplacesInTheSameMacrostepIsCalledOffAndNotDone) {
  Office office;
  const auto ask = [&](std::int64_t id, const std::string& text) {
    manual_words_t m{};
    m.id = id;
    link::put_text(m.text, text);
    office.words.publish(m, 0);
  };
  ask(1, "home all");
  ask(2, "stop arm2");
  ask(3, "stop arm2");
  const Hands hands = office.step();
  EXPECT_EQ(hands.orders[0]->kind, Kind::home);
  EXPECT_EQ(hands.orders[1]->kind, Kind::stop);
  office.done(1);
  office.step();
  office.answer();
  ask(1, "home all");
  office.step();
  EXPECT_EQ(office.answer().first, 1) << "arm1 goes on";
  office.done(0);
  office.step();
  office.answer();
  ask(1, "home all");
  office.step();
  EXPECT_EQ(office.answer(), (std::pair{3, std::string("arm2: called off")}));
  for (const std::int64_t stop : {2, 3}) {
    ask(stop, "stop arm2");
    office.step();
    EXPECT_EQ(office.answer().first, 2) << stop;
  }
}

TEST(ManualDesk, APauseRefusesWhatWouldBeginAtItsEndButNoStopAndNoEnd) {
  Office office;
  office.say(1, "home arm1");
  office.answer();
  office.paused = true;
  EXPECT_FALSE(office.say(2, "jog arm2 motors 1 0 0 0 0 0 0").orders[1]);
  auto [state, text] = office.answer();
  EXPECT_EQ(state, 0);
  EXPECT_NE(text.find("paused; resume first"), std::string::npos) << text;
  EXPECT_TRUE(office.say(3, "stop arm1").orders[0]);
  EXPECT_EQ(office.answer().first, 2) << "the arm stands already";
  EXPECT_TRUE(office.say(4, "end").end);
  Office scripted({{1, "bias arm1"}});
  scripted.paused = true;
  EXPECT_TRUE(scripted.step().orders[0]) << "a script's instruction is kept for the end of the pause";
}

TEST(ManualDesk, AFailureIsToldWithItsReason) {
  Office office;
  office.say(1, "model arm1 9");
  office.done(0, Fault{.code = FaultCode::unknown_model});
  office.step();
  const auto [state, text] = office.answer();
  EXPECT_EQ(state, 3);
  EXPECT_NE(text.find("arm1"), std::string::npos);
}

TEST(ManualDesk, ArmsThatAreNotHomedAreToldHowAndAllReasonsFit) {
  Office office;
  const auto fail = [&](std::int64_t id, FaultCode code) {
    office.say(id, "preset all front");
    for (const std::size_t arm : {0U, 1U}) office.done(arm, Fault{.code = code});
    office.step();
    return office.answer().second;
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

TEST(ManualDesk, AFaultedArmWaitsForItsReset) {
  Office office;
  office.reports[0].driver_state = DriverState::faulted;
  EXPECT_FALSE(office.say(1, "bias arm1").orders[0]);
  EXPECT_NE(office.answer().second.find("reset arm1"), std::string::npos);
  EXPECT_TRUE(office.say(2, "reset arm1").orders[0]);
  office.done(0);
  office.step();
  office.answer();
  EXPECT_TRUE(office.say(3, "stop arm1").orders[0]);
  office.done(0, Fault{.code = FaultCode::over_current});
  office.step();
  EXPECT_EQ(office.answer().first, 2) << "an arm that stands has obeyed a stop";
}

TEST(ManualDesk, WordsThatAreNotUnderstoodAreAnsweredWithTheRightOnesInOneLine) {
  Office office;
  office.say(1, "dance arm1");
  EXPECT_NE(office.answer().second.find("the verbs are home, move, jog"), std::string::npos);
  office.say(2, "gripper arm1 0.06");
  EXPECT_NE(office.answer().second.find("arm1 has no gripper"), std::string::npos);
  office.say(3, std::string(200, 'x') + " arm1");
  const std::string text = office.answer().second;
  EXPECT_TRUE(text.ends_with("reset, stop, end")) << text;
}

TEST(ManualDesk, NonsenseIsRefusedAndTheEndIsTaken) {
  Office office;
  office.say(1, "dance arm1");
  EXPECT_EQ(office.answer().first, 4);
  office.say(3, "jog arm1 cartesian 0 0 0");
  const auto [state, text] = office.answer();
  EXPECT_EQ(state, 4);
  EXPECT_NE(text.find("it is written `jog ARM"), std::string::npos) << text;
  EXPECT_TRUE(office.say(2, "end").end);
  EXPECT_EQ(office.answer().first, 2);
}

TEST(ManualDesk, WhatWasTakenIsWrittenDownAndReplaysTheSame) {
  std::string pattern = (fs::temp_directory_path() / "manual_desk.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  {
    Office office({}, folder / "words");
    office.say(1, "bias arm1");
    office.say(2, "dance arm1");
    office.say(3, "gripper arm2 0.07");
  }
  const auto script = load_words(folder / "words", kArms);
  ASSERT_EQ(script.size(), 2U);
  Office again(script);
  EXPECT_TRUE(again.step().orders[0]);
  EXPECT_FALSE(again.step().orders[1]);
  EXPECT_EQ(again.step().orders[1]->value[0], 0.07);
  std::ofstream(folder / "bad") << "3 dance arm1\n";
  EXPECT_THROW(static_cast<void>(load_words(folder / "bad", kArms)), FaultError);
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
