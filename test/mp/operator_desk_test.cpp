// The operator's orders: refused with a reason, obeyed once, recorded and replayed.
#include "mp/operator_desk.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <random>
#include <tuple>

#include "base/fault.hpp"
#include "base/link/text.hpp"
#include "mrroc/console_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using enum OperatorOrder;

class Desk : public ::testing::Test {
 protected:
  Desk() {
    std::string pattern = (fs::temp_directory_path() / "desk_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Desk() override { fs::remove_all(folder_); }
  fs::path write(const std::string& text) const {
    const fs::path file = folder_ / "script";
    std::ofstream(file) << text;
    return file;
  }
  fs::path folder_;
};

/// A desk and a terminal at it.
struct Office {
  explicit Office(
      std::vector<ScriptedOrder> script = {}, const fs::path& record = {},
      link::Membership m =
          [] {
            link::Membership me;
            me.session = "s";
            me.name = "mp";
            me.roster = {"mp"};
            return me;
          }())
      : process(bus, m),
        desk(process, std::move(script), record),
        orders(bus, process.route("operator"), m.session_id),
        answers(bus, process.route("answer"), m.session_id),
        lines(bus, process.route("mp.console"), m.session_id) {}

  /// Gives an order from the terminal. @return the answer
  operator_answer_t order(std::int64_t number_of_order, int number) {
    operator_order_t m{};
    m.id = number_of_order;
    m.order = number;
    orders.publish(m, 0);
    desk.poll();
    const auto a = answers.take();
    EXPECT_TRUE(a);
    EXPECT_EQ(a->id, number_of_order);
    return a.value_or(operator_answer_t{});
  }
  bool accepts(OperatorOrder o) {
    const auto a = order(++id, static_cast<int>(o));
    EXPECT_FALSE(link::get_text(a.text).empty());
    return a.accepted;
  }

  link::test::DirectBus bus;
  link::Process process;
  OperatorDesk desk;
  link::Outbox<operator_order_t> orders;
  link::Queue<operator_answer_t> answers;
  link::Queue<console_t> lines;
  std::int64_t id{1000};
};

TEST_F(Desk, AcceptsInEachStateWhatMakesSense) {
  struct Row {
    TaskState state;
    bool waits;
    std::vector<OperatorOrder> accepted;
  };
  const std::vector<Row> table{{TaskState::starting, false, {stop, emergency_stop}},
                               {TaskState::waiting_for_start, false, {start, stop, emergency_stop}},
                               {TaskState::running, false, {pause, stop, emergency_stop}},
                               {TaskState::running, true, {pause, trigger, stop, emergency_stop}},
                               {TaskState::paused, false, {resume, stop, emergency_stop}},
                               {TaskState::paused, true, {resume, stop, emergency_stop}},
                               {TaskState::stopping, true, {emergency_stop}},
                               {TaskState::ending, true, {}},
                               {TaskState::ended, true, {}}};
  for (const Row& row : table)
    for (const OperatorOrder o : kOperatorOrders) {
      Office office;
      office.desk.set_state(row.state, row.waits);
      const bool expected = std::ranges::find(row.accepted, o) != row.accepted.end();
      EXPECT_EQ(office.accepts(o), expected) << to_string(o) << " while " << to_string(row.state);
    }
}

TEST_F(Desk, ARefusalSaysWhyAndChangesNothing) {
  Office office;
  office.desk.set_state(TaskState::running, false);
  const auto a = office.order(7, static_cast<int>(trigger));
  EXPECT_FALSE(a.accepted);
  EXPECT_EQ(link::get_text(a.text), "the task does not wait for a trigger");
  const OperatorImage image = office.desk.take(5);
  EXPECT_EQ(image.trigger, 0);
  EXPECT_FALSE(image.paused);
}

TEST_F(Desk, AnOrderThatDoesNotExistIsRefused) {
  Office office;
  office.desk.set_state(TaskState::running, true);
  for (const int number : {-1, 6, 1000, INT32_MIN, INT32_MAX})
    EXPECT_FALSE(office.order(100 + number % 50, number).accepted) << number;
}

TEST_F(Desk, AnEmergencyStopWaitsForNoMacrostepAndReachesTheDriversAgainAndAgain) {
  const fs::path record = folder_ / "record";
  Office office({}, record);
  link::Queue<operator_order_t> driver(office.bus, office.process.route("operator"),
                                       office.process.membership().session_id);
  office.desk.set_state(TaskState::running, false);
  office.desk.take(41);
  office.desk.repeat_emergency();
  EXPECT_FALSE(driver.take()) << "nobody has pressed it";
  EXPECT_TRUE(office.accepts(emergency_stop));
  EXPECT_TRUE(office.desk.emergency()) << "at once";
  EXPECT_TRUE(driver.take()) << "the terminal's own message";
  office.desk.repeat_emergency();
  const auto repeated = driver.take();
  ASSERT_TRUE(repeated);
  EXPECT_EQ(repeated->order, static_cast<int>(emergency_stop));
  office.desk.poll();
  EXPECT_FALSE(office.answers.take()) << "MP does not answer itself";
  EXPECT_FALSE(office.accepts(emergency_stop));
  const auto script = load_script(record);
  ASSERT_EQ(script.size(), 1U);
  EXPECT_EQ(script[0].i, 42);
  Office again(script);
  again.desk.set_state(TaskState::running, false);
  again.desk.take(41);
  EXPECT_FALSE(again.desk.emergency());
  again.desk.take(42);
  EXPECT_TRUE(again.desk.emergency()) << "the script replays it";
}

TEST_F(Desk, ARepeatedOrderIsAnsweredAgainAndObeyedOnce) {
  Office office;
  office.desk.set_state(TaskState::running, true);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(office.order(7, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(office.desk.take(10).trigger, 1);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(office.order(7, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(office.desk.take(11).trigger, 1);
  EXPECT_TRUE(office.order(8, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(office.desk.take(12).trigger, 2);
}

TEST_F(Desk, TheSameOrderTwiceInAMacrostepIsOneOrder) {
  Office office;
  office.desk.set_state(TaskState::running, true);
  EXPECT_TRUE(office.accepts(trigger));
  EXPECT_FALSE(office.accepts(trigger));
  office.desk.give(trigger);
  EXPECT_EQ(office.desk.take(10).trigger, 1);
}

TEST_F(Desk, ASecondTriggerDoesNotEndTheNextBehaviour) {
  Office office;
  office.desk.set_behaviour(2);
  office.desk.set_state(TaskState::running, true);
  EXPECT_TRUE(office.accepts(trigger));
  EXPECT_EQ(office.desk.take(10).trigger, 1);
  office.desk.set_behaviour(3);  // its entry has noted trigger 1
  const auto a = office.order(77, static_cast<int>(trigger));
  EXPECT_FALSE(a.accepted);
  EXPECT_EQ(link::get_text(a.text), "behaviour 3 does not wait for a trigger");
  EXPECT_FALSE(office.desk.give(trigger));
  EXPECT_EQ(office.desk.take(11).trigger, 1);
  office.desk.set_state(TaskState::running, true);
  EXPECT_TRUE(office.accepts(trigger));
  EXPECT_EQ(office.desk.take(12).trigger, 2);
}

TEST_F(Desk, ATriggerForABehaviourThatHasEndedIsDropped) {
  Office office;
  office.desk.set_behaviour(2);
  office.desk.set_state(TaskState::running, true);
  EXPECT_TRUE(office.accepts(trigger));
  EXPECT_TRUE(office.accepts(pause));
  office.desk.set_behaviour(2);  // still
  office.desk.set_behaviour(3);  // ended by something else
  const OperatorImage image = office.desk.take(11);
  EXPECT_EQ(image.trigger, 0);
  EXPECT_TRUE(image.paused) << "what is not for a behaviour stays";
  const auto line = office.lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(link::get_text(line->text),
            "operator: the trigger came when behaviour 2 had ended, it is not obeyed");
}

TEST_F(Desk, AStopIsKnownBeforeItIsTaken) {
  Office office;
  office.desk.set_state(TaskState::running, false);
  EXPECT_FALSE(office.desk.stop_accepted());
  EXPECT_TRUE(office.accepts(stop));
  EXPECT_TRUE(office.desk.stop_accepted());
  EXPECT_FALSE(office.desk.stop_ordered());
  office.desk.take(1);
  EXPECT_TRUE(office.desk.stop_accepted());
}

TEST_F(Desk, AStopIsTakenBetweenMacrostepsAndRecordedAsTheScriptThatGivesTheSame) {
  Office office({}, folder_ / "record");
  office.desk.set_state(TaskState::running, false);
  EXPECT_FALSE(office.desk.take_stop(7)) << "nobody has ordered it";
  EXPECT_TRUE(office.accepts(pause));
  EXPECT_TRUE(office.accepts(stop));
  EXPECT_TRUE(office.desk.take_stop(7));
  EXPECT_TRUE(office.desk.stop_ordered());
  EXPECT_FALSE(office.desk.take_stop(8)) << "once";
  EXPECT_TRUE(office.desk.take(9).paused) << "other orders wait for their macrostep";
  const auto script = load_script(folder_ / "record");
  ASSERT_EQ(script.size(), 2U);
  EXPECT_EQ(script[0].i, 7);
  EXPECT_EQ(script[0].order, stop);
}

TEST_F(Desk, OrdersOfAnotherSessionAreNotHeard) {
  Office office;
  office.desk.set_state(TaskState::running, true);
  link::Outbox<operator_order_t> stranger(office.bus, office.process.route("operator"), 999);
  operator_order_t m{};
  m.order = static_cast<int>(stop);
  stranger.publish(m, 0);
  office.desk.poll();
  office.desk.take(1);
  EXPECT_FALSE(office.desk.stop_ordered());
  EXPECT_FALSE(office.answers.take());
}

TEST_F(Desk, OrdersTakeEffectInTheMacrostepInWhichTheyAreTaken) {
  Office office;
  office.desk.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(office.accepts(start));
  EXPECT_TRUE(office.desk.take(3).started);
  office.desk.set_state(TaskState::running, false);
  EXPECT_TRUE(office.accepts(pause));
  EXPECT_TRUE(office.desk.take(4).paused);
  office.desk.set_state(TaskState::paused, false);
  EXPECT_TRUE(office.accepts(resume));
  EXPECT_FALSE(office.desk.take(5).paused);
  EXPECT_TRUE(office.accepts(stop));
  EXPECT_FALSE(office.desk.stop_ordered());
  office.desk.take(6);
  EXPECT_TRUE(office.desk.stop_ordered());
}

/// Plays a task whose state follows the operator's image.
std::vector<std::tuple<std::int64_t, bool, bool, bool>> play(
    Office& office, int macrosteps, const std::function<void(std::int64_t)>& meanwhile) {
  std::vector<std::tuple<std::int64_t, bool, bool, bool>> images;
  OperatorImage image;
  for (std::int64_t i = 1; i <= macrosteps; ++i) {
    meanwhile(i);
    image = office.desk.take(i);
    images.emplace_back(image.trigger, image.started, image.paused, office.desk.stop_ordered());
    office.desk.set_state(!image.started ? TaskState::waiting_for_start
                          : image.paused ? TaskState::paused
                                         : TaskState::running,
                          (i / 20) % 2 == 0);
  }
  return images;
}

TEST_F(Desk, TheRecordOfARunReplaysIt) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    Office first({}, folder_ / "record");
    const auto images = play(first, 400, [&](std::int64_t) {
      if (random() % 3 == 0) first.accepts(static_cast<OperatorOrder>(random() % 4));
      if (random() % 9 == 0) first.desk.give(static_cast<OperatorOrder>(random() % 4));
    });
    EXPECT_GE(std::get<0>(images.back()), 3);
    Office second(load_script(folder_ / "record"), folder_ / "second");
    EXPECT_EQ(play(second, 400, [](std::int64_t) {}), images);
    std::ifstream a(folder_ / "record"), b(folder_ / "second");
    const std::string text_a{std::istreambuf_iterator<char>(a), {}},
        text_b{std::istreambuf_iterator<char>(b), {}};
    EXPECT_EQ(text_a, text_b);
  }
}

TEST_F(Desk, AScriptedOrderThatIsNotAllowedIsRefusedAloud) {
  Office office({{2, start}, {3, start}});
  office.desk.set_state(TaskState::waiting_for_start, false);
  office.desk.take(1);
  EXPECT_FALSE(office.lines.take());
  office.desk.take(2);
  EXPECT_TRUE(office.lines.take());
  office.desk.take(3);
  const auto line = office.lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->code, static_cast<int>(FaultCode::bad_script));
  EXPECT_EQ(link::get_text(line->text),
            "script: start in macrostep 3 is refused, the task has been started already");
}

TEST_F(Desk, ScriptIsReadWithCommentsAndInTheOrderOfMacrosteps) {
  const auto script =
      load_script(write("# a comment\n\n 30 trigger # the second\n10 start\r\n30 pause\n20   trigger\n"));
  ASSERT_EQ(script.size(), 4U);
  EXPECT_EQ(script[0].i, 10);
  EXPECT_EQ(script[0].order, start);
  EXPECT_EQ(script[1].i, 20);
  EXPECT_EQ(script[2].order, trigger);
  EXPECT_EQ(script[3].order, pause);
}

TEST_F(Desk, AScriptThatCannotBeUsedIsRefusedWithItsLine) {
  for (const char* line : {"start", "10", "10 begin", "10 Start", "0 start", "-5 start", "10 start now",
                           "1.5 start", "99999999999999999999 start", "0x10 start", "10start"}) {
    try {
      load_script(write(std::string("5 start\n") + line + "\n"));
      ADD_FAILURE() << line;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_script) << line;
      EXPECT_NE(std::string(e.what()).find("script:2:"), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(load_script(folder_ / "missing"), FaultError);
  EXPECT_THROW(load_script(folder_), FaultError);
}

TEST_F(Desk, KnowsWhenOnlyAPersonCanGoOn) {
  Office office;
  EXPECT_FALSE(office.desk.waits_for_a_person()) << "the task is starting by itself";
  office.desk.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(office.desk.waits_for_a_person());
  EXPECT_TRUE(office.desk.give(start));
  EXPECT_FALSE(office.desk.waits_for_a_person()) << "the order waits for its macrostep";
  std::ignore = office.desk.take(5);
  EXPECT_FALSE(office.desk.waits_for_a_person()) << "it has been started, whatever the arms still have to do";
  office.desk.set_state(TaskState::running, false);
  EXPECT_FALSE(office.desk.waits_for_a_person());
  Office stopped;
  stopped.desk.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(stopped.desk.give(stop));
  EXPECT_FALSE(stopped.desk.waits_for_a_person());
  Office scripted({{100, start}});
  scripted.desk.set_state(TaskState::waiting_for_start, false);
  EXPECT_FALSE(scripted.desk.waits_for_a_person()) << "the script gives the start in macrostep 100";
}

}  // namespace
}  // namespace mrroc::mp
