// The state automaton of platforms: what the table says is what the driver does, for every pair of state and event.
#include "edp/platform/automaton.hpp"

#include <gtest/gtest.h>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr std::array kReached{DriverState::not_synchronised, DriverState::homing,       DriverState::ready,
                              DriverState::executing,        DriverState::decelerating, DriverState::holding,
                              DriverState::faulted};

/// Leads a new rig into a state, at the boundary of a macrostep. Its session owns the driver where it can.
void lead_into(PlatformRig& rig, DriverState state) {
  if (state == DriverState::not_synchronised) return;
  rig.macrostep(rig.command(Instruction::synchro));
  if (state == DriverState::homing) return;
  ASSERT_TRUE(rig.reach(DriverState::ready));
  if (state == DriverState::ready) return;
  Way way = rig.way();
  rig.macrostep(rig.set(way.next(0.5, 0, 50)));
  rig.macrostep(rig.set(way.next(0.5, 0, 200)));
  rig.wait(50);
  if (state == DriverState::decelerating || state == DriverState::holding)
    for (int k = 0; k < PlatformRig::parameters().silence; ++k) rig.quiet();
  if (state == DriverState::holding) {
    ASSERT_TRUE(rig.reach(DriverState::holding));
    rig.wait(1);  // its fault has been told
  }
  if (state == DriverState::faulted) {
    rig.driver.trip({.code = FaultCode::emergency_stop});
    rig.wait(1);
  }
  ASSERT_EQ(rig.driver.state(), state);
}

TEST(PlatformAutomaton, EveryCommandInEveryStateGetsTheAnswerOfTheTable) {
  for (const DriverState state : kReached)
    for (const PlatformEvent event :
         {PlatformEvent::synchro, PlatformEvent::reset, PlatformEvent::reset_unknown}) {
      PlatformRig rig;
      lead_into(rig, state);
      const bool is_reset = event != PlatformEvent::synchro;
      if (is_reset && rig.driver.synchronised() != (event == PlatformEvent::reset)) continue;
      const Transition& expected = transition(state, event);
      rig.driver.take(rig.command(is_reset ? Instruction::reset : Instruction::synchro));
      rig.step();
      // A reset frees the driver from its owner.
      const DriverState after =
          is_reset ? transition(expected.next, PlatformEvent::abandoned).next : expected.next;
      EXPECT_EQ(rig.driver.state(), after) << to_string(state) << ", " << to_string(event);
      const PlatformReply reply = rig.quiet();
      EXPECT_EQ(reply.verdict, expected.refusal == FaultCode::none ? Verdict::executed : Verdict::refused)
          << to_string(state) << ", " << to_string(event);
      EXPECT_EQ(reply.fault.code, expected.refusal) << to_string(state) << ", " << to_string(event);
    }
}

TEST(PlatformAutomaton, AFragmentInEveryStateGetsTheAnswerOfTheTable) {
  for (const DriverState state : kReached) {
    PlatformRig rig;
    lead_into(rig, state);
    const std::int64_t accepted = rig.driver.synchronised() ? rig.driver.reply().accepted : 0;
    Fragment fragment = rig.way().next(0.1, 0, 50);
    if (state == DriverState::executing) {
      fragment.number = 99;  // legal in the state, refused for its number
    } else {
      fragment.number = accepted + 1;
    }
    const Transition& expected = transition(state, PlatformEvent::fragment);
    const PlatformReply reply = rig.macrostep(rig.set(fragment));
    const FaultCode code = state == DriverState::executing ? FaultCode::bad_fragment : expected.refusal;
    EXPECT_EQ(reply.fault.code, code) << to_string(state) << ": " << reply.fault.text.view();
    EXPECT_EQ(reply.verdict, code == FaultCode::none ? Verdict::executed : Verdict::refused)
        << to_string(state);
    EXPECT_EQ(reply.state, expected.next) << to_string(state);
  }
}

TEST(PlatformAutomaton, ARefusalNamesTheStateAndAfterAFaultTheFaultWithItsAxis) {
  for (const DriverState state : kReached)
    for (const PlatformEvent event : {PlatformEvent::synchro, PlatformEvent::fragment}) {
      const FaultCode refusal = transition(state, event).refusal;
      if (refusal == FaultCode::none) continue;
      PlatformRig rig;
      lead_into(rig, state);
      const PlatformReply reply =
          rig.macrostep(event == PlatformEvent::synchro ? rig.command(Instruction::synchro)
                                                        : rig.set(rig.way().next(0.1, 0, 50)));
      EXPECT_EQ(reply.fault.code, refusal) << to_string(state) << ", " << to_string(event);
      EXPECT_EQ(reply.fault.text.view(), refusal == FaultCode::reset_required
                                             ? to_string(FaultCode::emergency_stop)
                                             : to_string(state))
          << to_string(state) << ", " << to_string(event);
      EXPECT_EQ(reply.fault.axis, -1) << to_string(state) << ", " << to_string(event);
    }
  PlatformRig rig;
  lead_into(rig, DriverState::ready);
  rig.driver.trip({.code = FaultCode::encoder_fault, .axis = 2});
  rig.wait(1);
  const PlatformReply reply = rig.macrostep(rig.command(Instruction::synchro));
  EXPECT_EQ(reply.fault.code, FaultCode::reset_required);
  EXPECT_EQ(reply.fault.text.view(), to_string(FaultCode::encoder_fault));
  EXPECT_EQ(reply.fault.axis, 2);
}

TEST(PlatformAutomaton, GetIsRefusedInEveryStateAndQueryAnswered) {
  for (const DriverState state : kReached)
    for (const Instruction instruction : {Instruction::get, Instruction::set_get, Instruction::query}) {
      PlatformRig rig;
      lead_into(rig, state);
      PlatformCommand c = rig.command(instruction);
      c.queried = c.number - 1;
      const bool known = instruction == Instruction::query && c.queried != 0;
      const PlatformReply reply = rig.macrostep(c);
      EXPECT_EQ(reply.verdict, known ? Verdict::executed : Verdict::refused) << to_string(state);
      if (instruction != Instruction::query) {
        EXPECT_EQ(reply.fault.code, FaultCode::unknown_enum);
      }
      EXPECT_EQ(rig.driver.state(), state) << "nothing has changed";
    }
}

TEST(PlatformAutomaton, AMalfunctionLeadsToFaultedFromEveryStateAndBrakes) {
  for (const DriverState state : kReached) {
    PlatformRig rig;
    lead_into(rig, state);
    rig.driver.trip({.code = FaultCode::hardware_silent});
    EXPECT_EQ(rig.driver.state(), transition(state, PlatformEvent::trip).next);
    EXPECT_EQ(rig.driver.state(), DriverState::faulted);
    rig.step();
    EXPECT_FALSE(rig.last.enabled);
  }
}

TEST(PlatformAutomaton, SilenceAndALostOwnerLeadWhereTheTableSays) {
  for (const DriverState state : kReached)
    for (const PlatformEvent event : {PlatformEvent::silence, PlatformEvent::abandoned}) {
      PlatformRig rig;
      lead_into(rig, state);
      if (event == PlatformEvent::abandoned) rig.driver.drop_owner();
      if (event == PlatformEvent::silence)
        for (int k = 1; k < PlatformRig::parameters().silence; ++k) rig.quiet();
      if (rig.driver.state() != state) continue;  // it has come to rest meanwhile
      rig.quiet();
      EXPECT_EQ(rig.driver.state(), transition(state, event).next)
          << to_string(state) << ", " << to_string(event);
    }
}

TEST(PlatformAutomaton, AStoppedPlatformHolds) {
  PlatformRig rig;
  lead_into(rig, DriverState::decelerating);
  EXPECT_TRUE(rig.reach(transition(DriverState::decelerating, PlatformEvent::stood).next, 25));
}

TEST(PlatformAutomaton, AWayThatEndsHolds) {
  PlatformRig rig;
  lead_into(rig, DriverState::ready);
  rig.macrostep(rig.set(rig.way().next(0, 0.1, 5)));
  EXPECT_EQ(rig.driver.state(), DriverState::executing);
  rig.wait(5);
  EXPECT_EQ(rig.driver.state(), transition(DriverState::executing, PlatformEvent::arrived).next);
}

TEST(PlatformAutomaton, AFaultBeforeSynchronisationLeadsBackToNotSynchronised) {
  PlatformRig rig;
  lead_into(rig, DriverState::homing);
  rig.driver.trip({.code = FaultCode::emergency_stop});
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state,
            transition(DriverState::faulted, PlatformEvent::reset_unknown).next);
}

TEST(PlatformAutomaton, EveryStateButJoggingCanBeReachedAndLeft) {
  for (const DriverState state : kReached) {
    bool reached = state == DriverState::not_synchronised;
    bool left = false;
    for (const PlatformStateRow& row : kPlatformAutomaton)
      for (const Transition& t : row.on) {
        if (t.refusal != FaultCode::none || t.next == row.state) continue;
        reached = reached || t.next == state;
        left = left || row.state == state;
      }
    EXPECT_TRUE(reached && left) << to_string(state);
  }
}

}  // namespace
}  // namespace mrroc::edp::test
