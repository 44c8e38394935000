// Messages of nodes to the supervisor, and its record of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "mrroc/console_t.hpp"
#include "test/mp/supervisor_fixture.hpp"

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;
using test::Phase;
using test::Process;
using test::ProcessState;

class SupervisorHears : public test::SupervisorFixture {};

TEST_F(SupervisorHears, ANodeIsSeenAsItToldOfItselfLast) {
  begin({sleeper("one"), sleeper("two")});
  says("two", ProcessState::running, [](process_status_t& m) {
    m.m = 4;
    link::put_text(m.behaviour, "hold");
    link::put_text(m.ended_because, "approach: contact");
  });
  const auto nodes = supervisor->node_statuses();
  ASSERT_EQ(nodes.size(), 3U);
  EXPECT_EQ(nodes[0].name, "mp");
  EXPECT_EQ(nodes[1].name, "one");
  EXPECT_EQ(nodes[1].state, ProcessState::starting);
  EXPECT_EQ(nodes[1].m, 0);
  EXPECT_EQ(nodes[1].behaviour, "");
  EXPECT_EQ(nodes[2].name, "two");
  EXPECT_EQ(nodes[2].state, ProcessState::running);
  EXPECT_EQ(nodes[2].m, 4);
  EXPECT_EQ(nodes[2].behaviour, "hold");
  EXPECT_EQ(nodes[2].ended_because, "approach: contact");
}

TEST_F(SupervisorHears, TheAgeOfANodeIsCountedFromItsStartAndFromItsLastWord) {
  begin({sleeper("one")});
  const auto age_is_since = [&](Process::Clock::time_point then) {
    const double least = supervisor->node_statuses()[1].age;
    return least >= 0 && least <= std::chrono::duration<double>(Process::Clock::now() - then).count();
  };
  std::this_thread::sleep_for(30ms);
  auto then = Process::Clock::now();
  supervisor->start_processes({});
  EXPECT_TRUE(age_is_since(then));
  std::this_thread::sleep_for(30ms);
  then = Process::Clock::now();
  says("one", ProcessState::ready);
  EXPECT_TRUE(age_is_since(then));
  std::this_thread::sleep_for(30ms);
  EXPECT_GE(supervisor->node_statuses()[1].age, 0.03);
  says("one", ProcessState::dead);  // nobody can say that
  EXPECT_GE(supervisor->node_statuses()[1].age, 0.03) << "not a word";
}

TEST_F(SupervisorHears, AStateThatNoNodeCanTellIsNotHeard) {
  begin({sleeper("one")});
  says("one", ProcessState::ready);
  for (const int state : {-1, static_cast<int>(ProcessState::dead), 6, 1000}) {
    says("one", ProcessState::ready, [&](process_status_t& m) {
      m.state = state;
      m.m = 9;
    });
    EXPECT_EQ(state_of(1), ProcessState::ready) << state;
    EXPECT_EQ(supervisor->node_statuses()[1].m, 0) << state;
  }
  for (const ProcessState state : {ProcessState::starting, ProcessState::ready, ProcessState::running,
                                   ProcessState::done, ProcessState::faulted}) {
    says("one", state);
    EXPECT_EQ(state_of(1), state);
  }
  says("one", ProcessState::running);
  EXPECT_EQ(state_of(1), ProcessState::faulted) << "that was on its way before the fault";
}

TEST_F(SupervisorHears, LatenessIsToldOnceASecondAndTheRestOfItAtTheEnd) {
  begin({sleeper("one"), sleeper("two")});
  const auto late = [&](const std::string& name, ProcessState state, std::int64_t skipped) {
    says(name, state, [&](process_status_t& m) { m.skipped = skipped; });
  };
  const auto then = Process::Clock::now();
  late("one", ProcessState::running, 3);
  EXPECT_EQ(supervisor->last_message(), "one: late: 3 skipped, 3 in all");
  EXPECT_EQ(supervisor->last_code(), FaultCode::none);
  late("one", ProcessState::running, 5);
  const int soon = logged("late: ");
  if (Process::Clock::now() - then < 1s) {
    EXPECT_EQ(soon, 1);
  }
  std::this_thread::sleep_for(1010ms);
  late("one", ProcessState::running, 6);
  EXPECT_EQ(supervisor->last_message(),
            soon == 1 ? "one: late: 3 skipped, 6 in all" : "one: late: 1 skipped, 6 in all");
  late("two", ProcessState::running, 10);
  EXPECT_EQ(supervisor->last_message(), "two: late: 10 skipped, 10 in all");
  late("one", ProcessState::done, 8);
  EXPECT_EQ(supervisor->last_message(), "one: late: 2 skipped, 8 in all") << "no second has to go by";
  const int all = logged("late: ");
  late("one", ProcessState::done, 8);
  EXPECT_EQ(logged("late: "), all) << "nothing new";
  EXPECT_EQ(supervisor->skipped(), 18) << "of all nodes";
}

TEST_F(SupervisorHears, EachBehaviourThatANodeBeginsCountsOnce) {
  begin({sleeper("one"), sleeper("two")});
  const auto begins = [&](const std::string& node, int number, const char* name) {
    const auto before = supervisor->behaviours_begun();
    says(node, ProcessState::running, [&](process_status_t& m) {
      m.m = number;
      link::put_text(m.behaviour, name);
    });
    return supervisor->behaviours_begun() - before;
  };
  EXPECT_EQ(begins("one", 1, "approach"), 1);
  EXPECT_EQ(begins("one", 1, "approach"), 0);
  EXPECT_EQ(begins("one", 2, "approach"), 1) << "another number";
  EXPECT_EQ(begins("one", 2, "hold"), 1) << "another name";
  EXPECT_EQ(begins("two", 2, "hold"), 1) << "another node";
  EXPECT_EQ(begins("one", 2, "hold"), 0);
}

TEST_F(SupervisorHears, EveryFaultIsToldOnceAndTheFirstOneIsTheReason) {
  begin({sleeper("one"), sleeper("two"), sleeper("three")});
  const auto fails = [&](const std::string& node, FaultCode code) {
    says(node, ProcessState::faulted, [&](process_status_t& m) {
      m.fault.code = static_cast<int>(code);
      link::put_text(m.fault.process, node);
      link::put_text(m.fault.text, "seen by " + node);
    });
  };
  fails("one", FaultCode::over_current);
  for (int k = 0; k < 3; ++k) {
    fails("two", FaultCode::over_current);
    fails("three", FaultCode::joint_limit);
    fails("one", FaultCode::over_current);
  }
  for (const char* node : {"seen by one", "seen by two", "seen by three"}) EXPECT_EQ(logged(node), 1) << node;
  ASSERT_TRUE(supervisor->fault());
  EXPECT_EQ(supervisor->fault()->code, FaultCode::over_current);
  EXPECT_EQ(supervisor->fault()->process.view(), "one");
  EXPECT_EQ(supervisor->last_code(), FaultCode::joint_limit);
}

TEST_F(SupervisorHears, AFaultOfANodeStopsAtOnceAlsoWhereAMacrostepForItHasBeenAgreed) {
  for (const bool agreed : {false, true}) {
    begin({{"one", {}, {}, {}}});
    run();
    if (agreed) {
      supervisor->stop({.code = FaultCode::operator_stop}, 1000);
      ASSERT_EQ(mp->stop_as_of(), 1000);
    }
    says("one", ProcessState::faulted,
         [](process_status_t& m) { m.fault.code = static_cast<int>(FaultCode::over_current); });
    EXPECT_EQ(mp->phase(), Phase::stopping);
    EXPECT_EQ(mp->stop_as_of(), 0) << agreed;
  }
}

TEST_F(SupervisorHears, StepsToRestAreThoseOfTheRobotAtRestThatTookLongest) {
  begin({sleeper("one"), sleeper("two")});
  EXPECT_EQ(supervisor->stop_steps(), std::nullopt);
  const auto rests = [&](const std::string& name, int at_rest, int steps) {
    says(name, ProcessState::running, [&](process_status_t& m) {
      m.effector = 1;
      m.at_rest = static_cast<std::int8_t>(at_rest);
      m.stop_steps = steps;
    });
  };
  rests("one", 0, 90);
  EXPECT_EQ(supervisor->stop_steps(), std::nullopt);
  rests("one", 1, 54);
  EXPECT_EQ(supervisor->stop_steps(), 54);
  rests("two", 1, 7);
  EXPECT_EQ(supervisor->stop_steps(), 54);
  rests("two", 1, 70);
  EXPECT_EQ(supervisor->stop_steps(), 70);
}

TEST_F(SupervisorHears, ALineHasItsTimeItsProcessItsKindAndItsCode) {
  begin({sleeper("one")});
  link::Outbox<console_t> console(*bus, mp->route("one.console"), 1);
  const auto line = [&](std::int32_t code, const char* text) {
    console_t m{};
    m.code = code;
    link::put_text(m.text, text);
    console.publish(m, 0);
    mp->poll();
  };
  line(0, "hello");
  EXPECT_EQ(supervisor->last_message(), "one: hello");
  EXPECT_EQ(supervisor->last_code(), FaultCode::none);
  line(static_cast<int>(FaultCode::over_current), "too much");
  EXPECT_EQ(supervisor->last_code(), FaultCode::over_current);
  line(1'000'000, "of a code that there is not");
  EXPECT_EQ(supervisor->last_code(), FaultCode::none);
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  EXPECT_TRUE(supervisor->last_message().starts_with("mp: ")) << supervisor->last_message();
  const std::string text = text_of("messages.log");
  for (const char* wanted : {R"(^ +\d\d?\.\d{3}  one         info       -                     hello$)",
                             R"(^ +\d\d?\.\d{3}  one         \w+ +over_current          too much$)",
                             R"(^ +\d\d?\.\d{3}  mp          \w+(-\w+)? +operator_stop         .+$)"})
    EXPECT_TRUE(std::regex_search(text, std::regex(wanted, std::regex::ECMAScript | std::regex::multiline)))
        << wanted << "\n"
        << text;
}

TEST_F(SupervisorHears, TheReasonOfAStopIsWrittenDownWithItsProcessAndWhatHelps) {
  begin({sleeper("one")});
  const Fault fault{.code = FaultCode::over_current, .process = "one"};
  supervisor->stop(fault, 0);
  const std::string remedy(fault_entry(FaultCode::over_current).remedy);
  EXPECT_EQ(supervisor->last_message(), "one: " + what_happened(fault) + "; " + remedy);
  begin({sleeper("one")});
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  EXPECT_TRUE(supervisor->last_message().starts_with("mp: ")) << supervisor->last_message();
  supervisor->stop(fault, 0);
  EXPECT_EQ(logged("over_current"), 0) << "the first reason alone";
}

/// Tells that a node is done and has sent so much on these channels.
void sent(process_status_t& m, const std::vector<std::pair<const char*, std::array<std::int64_t, 2>>>& all) {
  m.n_hashes = static_cast<int>(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    link::put_text(m.hash[k].channel, all[k].first);
    m.hash[k].hash = all[k].second[0];
    m.hash[k].count = all[k].second[1];
  }
}

TEST_F(SupervisorHears, TheFingerprintDependsOnEveryChannelItsCountAndItsTrafficAndNotOnTheirOrder) {
  using All = std::vector<std::pair<const char*, std::array<std::int64_t, 2>>>;
  const auto print_of = [&](const All& one, const All& two) {
    begin({sleeper("one"), sleeper("two")});
    mp_is_done();
    says("one", ProcessState::done, [&](process_status_t& m) { sent(m, one); });
    EXPECT_EQ(supervisor->log_hash(), 0U) << "two has not told its own";
    EXPECT_EQ(supervisor->without_fingerprint(), "two");
    says("two", ProcessState::done, [&](process_status_t& m) { sent(m, two); });
    EXPECT_EQ(supervisor->without_fingerprint(), "") << "MP need not send anything";
    return supervisor->log_hash();
  };
  const All other{{".c", {7, 8}}};
  const std::uint64_t first = print_of({{".a", {1, 2}}, {".b", {3, 4}}}, other);
  EXPECT_NE(first, 0U);
  EXPECT_EQ(print_of({{".b", {3, 4}}, {".a", {1, 2}}}, other), first);
  EXPECT_EQ(print_of(other, {{".b", {3, 4}}, {".a", {1, 2}}}), first);
  for (const All& changed :
       {All{{".a", {1, 2}}}, All{{".aa", {1, 2}}, {".b", {3, 4}}}, All{{".a", {0, 2}}, {".b", {3, 4}}},
        All{{".a", {1, 0}}, {".b", {3, 4}}}, All{{".a", {1, 2}}, {".b", {0, 4}}},
        All{{".a", {1, 2}}, {".b", {3, 0}}}, All{{".a", {3, 4}}, {".b", {1, 2}}}})
    EXPECT_NE(print_of(changed, other), first) << changed.front().first;
}

TEST_F(SupervisorHears, AsManyFingerprintsAsAStatusHasRoomForCountAndNoMore) {
  const auto print_of = [&](int told, std::int64_t last) {
    begin({sleeper("one")});
    mp_is_done();
    says("one", ProcessState::done, [&](process_status_t& m) {
      m.n_hashes = told;
      for (std::size_t k = 0; k < std::size(m.hash); ++k) {
        link::put_text(m.hash[k].channel, "." + std::to_string(k));
        m.hash[k].hash = k + 1 == std::size(m.hash) ? last : 5;
      }
    });
    return supervisor->log_hash();
  };
  constexpr int kRoom = static_cast<int>(std::size(process_status_t{}.hash));
  EXPECT_NE(print_of(kRoom, 1), print_of(kRoom, 2)) << "the last one counts";
  EXPECT_EQ(print_of(kRoom + 1, 1), print_of(kRoom, 1));
  EXPECT_NE(print_of(kRoom - 1, 1), print_of(kRoom, 1));
  EXPECT_EQ(print_of(kRoom - 1, 1), print_of(kRoom - 1, 2));
  EXPECT_EQ(print_of(-5, 1), print_of(0, 1));
}

}  // namespace
}  // namespace mrroc::mp
