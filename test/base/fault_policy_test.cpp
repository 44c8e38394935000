// Each response of a row's policy to a refused or failed command, over a scripted port in lock-step.
#include "base/fault_policy.hpp"

#include <gtest/gtest.h>

#include "base/agent_images.hpp"
#include "base/platform_command.hpp"
#include "base/script_port.hpp"

namespace mrroc {
namespace {

/// Remembers how often a behaviour began and which faults its memory function saw.
struct Memory {
  int begun{};
  int faults{};
};
/// An arm's agent.
struct Agent {
  struct X {
    Memory c;
    EffectorReply e;
    None V;
    Order T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  struct Y {
    Memory c;
    EffectorCommand e;
    None V;
    Report T;
  };
};
using X = Agent::X;

Memory begin(const X& x) { return {x.c.begun + 1, x.c.faults}; }
Memory look(const X& x) { return {x.c.begun, x.c.faults + (mishap_of(x.e) != Mishap::none ? 1 : 0)}; }
EffectorCommand push(const X&) { return {.instruction = Instruction::set_get}; }
None nothing(const X&) { return {}; }
Report tell(const X& x) {
  Report r;
  r.verdict = x.e.verdict;
  r.fault = x.e.fault;
  return r;
}
bool at_20(const X& x) { return x.i >= 20; }

Motion<Agent> row(const FaultPolicy& policy) {
  return {5, "push", begin, look, push, nothing, tell, at_20, "macrostep 20", policy};
}

EffectorReply told(DriverState state, Verdict verdict, FaultCode code) {
  EffectorReply e;
  e.state = state;
  e.verdict = verdict;
  e.fault.code = code;
  return e;
}
const EffectorReply kDone = told(DriverState::executing, Verdict::executed, FaultCode::none);
const EffectorReply kRefused = told(DriverState::holding, Verdict::refused, FaultCode::too_fast);
const EffectorReply kFailed = told(DriverState::decelerating, Verdict::failed, FaultCode::excessive_torque);
const EffectorReply kStops = told(DriverState::decelerating, Verdict::none, FaultCode::excessive_torque);
const EffectorReply kHolds = told(DriverState::holding, Verdict::none, FaultCode::none);
const EffectorReply kTripped = told(DriverState::faulted, Verdict::failed, FaultCode::over_current);

/// The behaviour begins in macrostep 0; `given` are the replies of macrosteps 1, 2, ..., then all goes well.
struct Play {
  Play(const FaultPolicy& policy, std::vector<EffectorReply> given) {
    given.resize(40, kDone);
    std::vector<X> images(given.size());
    for (std::size_t k = 0; k < images.size(); ++k) images[k].e = given[k];
    ScriptPort<Agent> port(images);
    outcome = move(row(policy), x, port);
    decisions = port.decisions();
  }
  /// Whether the command of that macrostep moves the arm.
  [[nodiscard]] bool pushes(std::size_t i) const {
    return decisions.at(i).y.e.instruction == Instruction::set_get;
  }
  /// What the coordinator is told in that macrostep.
  [[nodiscard]] const Report& report(std::size_t i) const { return decisions.at(i).y.T; }

  X x;
  Outcome outcome{};
  std::vector<ScriptPort<Agent>::Decision> decisions;
};

TEST(FaultPolicy, ByDefaultTheCoordinatorIsToldAndTheBehaviourDoesNotCare) {
  EXPECT_EQ(FaultPolicy(), respond(Response::end));
  for (const EffectorReply& e : {kRefused, kFailed, kTripped}) {
    const Play play({}, {kDone, kDone, e});
    EXPECT_EQ(play.decisions.size(), 20U);
    EXPECT_EQ(play.x.c.begun, 1);
    EXPECT_NE(play.report(3).verdict, Verdict::none);
    EXPECT_EQ(play.report(3).fault.code, e.fault.code);
    EXPECT_TRUE(play.pushes(3));
  }
}

TEST(FaultPolicy, GoOnCommandsOnAndTellsTheFaultWithoutAVerdict) {
  for (const EffectorReply& e : {kRefused, kFailed}) {
    const Play play(respond(Response::go_on), {kDone, kDone, e});
    EXPECT_EQ(play.decisions.size(), 20U);
    EXPECT_EQ(play.x.c.begun, 1);
    EXPECT_EQ(play.x.c.faults, 1) << "its functions see what has happened";
    EXPECT_EQ(play.report(3).verdict, Verdict::none) << "the task does not end";
    EXPECT_EQ(play.report(3).fault.code, e.fault.code) << "whoever looks at the report learns of it";
    for (std::size_t i = 0; i < 20; ++i) EXPECT_TRUE(play.pushes(i)) << i;
  }
}

TEST(FaultPolicy, RepeatLetsTheEffectorComeToRestAndBeginsAnew) {
  const Play play(respond(Response::repeat), {kDone, kDone, kFailed, kStops, kStops, kStops, kHolds});
  EXPECT_EQ(play.x.c.begun, 2);
  EXPECT_EQ(play.x.i_0, 7) << "when the effector holds";
  EXPECT_GE(play.x.c.faults, 1);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(play.pushes(i), i < 3 || i >= 7) << i;
    EXPECT_NE(play.report(i).verdict, Verdict::failed) << i;
  }
}

TEST(FaultPolicy, NextBehaviourLetsTheEffectorComeToRestAndEnds) {
  const Play play(respond(Response::next_behaviour), {kDone, kDone, kFailed, kStops, kStops, kStops, kHolds});
  EXPECT_EQ(play.outcome, Outcome::terminated);
  EXPECT_EQ(play.x.i, 7);
  EXPECT_EQ(play.x.c.begun, 1);
  EXPECT_EQ(play.decisions.size(), 7U);
  for (std::size_t i = 3; i < 7; ++i) EXPECT_FALSE(play.pushes(i)) << i;
}

TEST(FaultPolicy, ACommandThatIsStillOnItsWayIsAnsweredBeforeTheNextBehaviourBegins) {
  const Play play(respond(Response::next_behaviour), {kDone, kRefused, kRefused, kHolds});
  EXPECT_EQ(play.x.i, 4) << "the command of macrostep 1 is answered in 3";
}

TEST(FaultPolicy, RefusalFailureAndMalfunctionHaveResponsesOfTheirOwn) {
  const FaultPolicy policy{.on_refused = Response::go_on, .on_failed = Response::next_behaviour};
  EXPECT_EQ(Play(policy, {kDone, kDone, kRefused}).decisions.size(), 20U);
  EXPECT_LT(Play(policy, {kDone, kDone, kFailed, kHolds, kHolds}).decisions.size(), 10U);
  EXPECT_EQ(Play(policy, {kDone, kDone, kTripped}).report(3).verdict, Verdict::failed);
  EXPECT_EQ(Play({.on_tripped = Response::go_on}, {kDone, kDone, kTripped}).report(3).verdict, Verdict::none);
}

TEST(FaultPolicy, AnswersToTheBehaviourBeforeNeitherRepeatNorEndIt) {
  for (const Response response : {Response::repeat, Response::next_behaviour}) {
    const Play play(respond(response), {kRefused});
    EXPECT_EQ(play.decisions.size(), 20U);
    EXPECT_EQ(play.x.c.begun, 1);
    EXPECT_EQ(play.report(1).verdict, Verdict::none);
  }
}

TEST(FaultPolicy, AReplyOfAnyKindOfEffectorTellsItsMishapAndWhetherItMoves) {
  PlatformReply told;
  EXPECT_EQ(mishap_of(told), Mishap::none);
  told.fault.code = FaultCode::out_of_limits;
  EXPECT_EQ(mishap_of(told), Mishap::none) << "without a verdict";
  told.verdict = Verdict::refused;
  EXPECT_EQ(mishap_of(told), Mishap::refused);
  told.verdict = Verdict::failed;
  EXPECT_EQ(mishap_of(told), Mishap::failed);
  told.state = DriverState::faulted;
  EXPECT_EQ(mishap_of(told), Mishap::tripped);
  told.fault.code = FaultCode::lost_command;
  EXPECT_EQ(mishap_of(told), Mishap::none);
  EXPECT_EQ(mishap_of(None{}), Mishap::none) << "an agent without an effector";
  EXPECT_FALSE(moves(told));
  for (const DriverState state : {DriverState::homing, DriverState::executing, DriverState::decelerating}) {
    told.state = state;
    EXPECT_TRUE(moves(told));
  }
}

TEST(FaultPolicy, ALostCommandIsNoMishap) {
  const EffectorReply lost = told(DriverState::executing, Verdict::refused, FaultCode::lost_command);
  EXPECT_EQ(Play(respond(Response::next_behaviour), {kDone, kDone, lost}).decisions.size(), 20U);
}

}  // namespace
}  // namespace mrroc
