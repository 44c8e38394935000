// The state automaton: what the table says is what the driver does, for every pair of state and event.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "edp/automaton.hpp"
#include "test/edp/automaton_document.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr const char* kDocument = MRROC_SOURCE_DIR "/docs/automaton.md";

constexpr double kFast = 0.05;  // [m/s]

std::vector<DriverState> all_states() {
  std::vector<DriverState> states;
  for (const StateRow& row : kAutomaton) states.push_back(row.state);
  return states;
}

/// Leads a new rig into a state, with a session that owns the driver, at the boundary of a macrostep.
void lead_into(Rig& rig, DriverState state) {
  switch (state) {
    case DriverState::not_synchronised:
      rig.macrostep(rig.jog({1}));
      rig.silence(6);
      break;
    case DriverState::homing:
      rig.macrostep(rig.command(Instruction::synchro));
      break;
    case DriverState::jogging:
      rig.macrostep(rig.jog({1}));
      break;
    case DriverState::ready:
    case DriverState::executing:
    case DriverState::decelerating:
    case DriverState::holding:
    case DriverState::faulted:
      rig.synchronise();
      while (rig.driver.state() == DriverState::homing) rig.silence(1);
      break;
  }
  if (state == DriverState::executing || state == DriverState::decelerating || state == DriverState::holding)
    rig.macrostep(rig.velocity({u(kFast), u(), u(), u(), u(), u()}));
  if (state == DriverState::decelerating) rig.silence(1);
  if (state == DriverState::holding) rig.silence(6);
  if (state == DriverState::faulted) {
    rig.world.switches[2] = static_cast<std::uint8_t>(AxisSwitch::over_current);
    rig.macrostep();
    rig.world.switches[2] = 0;
  }
  ASSERT_EQ(rig.driver.state(), state);
}

DriverParameters homing_parameters() {
  DriverParameters p = Rig::parameters();
  p.synchronisation = Synchronisation::homing;
  return p;
}

EffectorCommand model(Rig& rig, void (*mark)(RobotModel&)) {
  EffectorCommand c = rig.command(Instruction::set);
  c.set = static_cast<std::uint8_t>(Part::robot_model);
  c.robot_model.tool = numbers_from_pose(Representation::frame, Pose{});
  mark(c.robot_model);
  return c;
}

/// @return a command that asks for the event and nothing else
EffectorCommand asking_for(Rig& rig, Event event) {
  EffectorCommand c;
  switch (event) {
    case Event::get:
      c = rig.command(Instruction::get);
      c.get = static_cast<std::uint8_t>(Part::arm);
      return c;
    case Event::arm:
      return rig.velocity({});
    case Event::jog:
      return rig.jog({1});
    case Event::tool:
      return model(rig, [](RobotModel& m) { m.set_tool = true; });
    case Event::kinematic_model:
      return model(rig, [](RobotModel& m) { m.set_kinematic_model = true; });
    case Event::servo_algorithm:
      return model(rig, [](RobotModel& m) { m.set_servo_algorithm = 1; });
    case Event::force_tool:
      return model(rig, [](RobotModel& m) { m.set_force_tool = true; });
    case Event::outputs:
      c = rig.command(Instruction::set);
      c.set = static_cast<std::uint8_t>(Part::io);
      return c;
    case Event::synchro:
      return rig.command(Instruction::synchro);
    case Event::reset:
    case Event::reset_unknown:
    default:
      return rig.command(Instruction::reset);
  }
}

TEST(Automaton, EveryCommandInEveryStateGetsTheAnswerOfTheTable) {
  for (const DriverState state : all_states())
    for (std::size_t e = 0; e < static_cast<std::size_t>(kFirstOwnEvent); ++e) {
      const auto event = static_cast<Event>(e);
      Rig rig(homing_parameters());
      lead_into(rig, state);
      const bool is_reset = event == Event::reset || event == Event::reset_unknown;
      if (is_reset && rig.driver.synchronised() != (event == Event::reset)) continue;
      const Transition& expected = transition(state, event);
      rig.driver.take(asking_for(rig, event));
      rig.step();
      const bool is_motion = event == Event::arm || event == Event::jog;
      // Without a motion of its own the macrostep is silence to the arm; a reset frees the driver from its owner.
      const bool accepted_motion = expected.refusal == FaultCode::none && is_motion;
      const DriverState after = is_reset ? transition(expected.next, Event::abandoned).next : expected.next;
      EXPECT_EQ(rig.driver.state(), accepted_motion ? after : transition(after, Event::silence).next)
          << to_string(state) << ", " << to_string(event);
      const EffectorReply reply = rig.macrostep();
      EXPECT_EQ(reply.verdict, expected.refusal == FaultCode::none ? Verdict::executed : Verdict::refused)
          << to_string(state) << ", " << to_string(event) << ", " << to_string(reply.fault.code);
      EXPECT_EQ(reply.fault.code, expected.refusal) << to_string(state) << ", " << to_string(event);
      if (is_reset && state == DriverState::faulted) {
        EXPECT_EQ(reply.state, expected.next);
      }
    }
}

TEST(Automaton, AFaultBeforeSynchronisationLeadsBackToNotSynchronised) {
  Rig rig(homing_parameters());
  lead_into(rig, DriverState::jogging);
  rig.driver.trip({.code = FaultCode::emergency_stop});
  EXPECT_EQ(rig.driver.state(), DriverState::faulted);
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state,
            transition(DriverState::faulted, Event::reset_unknown).next);
  EXPECT_FALSE(rig.last.enabled);
}

TEST(Automaton, AMalfunctionLeadsToFaultedFromEveryState) {
  for (const DriverState state : all_states()) {
    Rig rig(homing_parameters());
    lead_into(rig, state);
    rig.driver.trip({.code = FaultCode::emergency_stop});
    EXPECT_EQ(rig.driver.state(), transition(state, Event::trip).next);
    EXPECT_EQ(rig.driver.state(), DriverState::faulted);
    rig.step();
    EXPECT_FALSE(rig.last.enabled);
  }
}

TEST(Automaton, SilenceInEveryStateLeadsWhereTheTableSays) {
  for (const DriverState state : all_states()) {
    Rig rig(homing_parameters());
    lead_into(rig, state);
    rig.step();
    EXPECT_EQ(rig.driver.state(), transition(state, Event::silence).next) << to_string(state);
  }
}

TEST(Automaton, OwnerWhoIsGoneEndsHomingAndNothingElse) {
  for (const DriverState state : all_states()) {
    Rig rig(homing_parameters());
    lead_into(rig, state);
    rig.driver.drop_owner();
    rig.step();
    const DriverState next = transition(state, Event::abandoned).next;
    EXPECT_EQ(rig.driver.state(), transition(next, Event::silence).next) << to_string(state);
  }
}

TEST(Automaton, MotionsComeToRestInTheStateOfTheTable) {
  for (const DriverState state : {DriverState::decelerating, DriverState::jogging}) {
    Rig rig(homing_parameters());
    lead_into(rig, state);
    rig.silence(8);
    EXPECT_EQ(rig.driver.state(), transition(state, Event::stood).next) << to_string(state);
  }
}

TEST(Automaton, MacrostepThatFailsLeadsWhereTheTableSays) {
  Rig rig(homing_parameters());
  lead_into(rig, DriverState::executing);
  rig.world.sensor_offset[Axis::x] = 60;  // pushes the arm to 1.2 m/s
  const AxisCommand soft = c(0, 1, 0.02);
  const EffectorReply reply = rig.macrostep(rig.velocity({soft, soft, u(), u(), u(), u()}));
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.state, transition(DriverState::executing, Event::failed).next);
}

TEST(Automaton, JogThatFailsLeadsWhereTheTableSays) {
  Rig rig(homing_parameters());
  lead_into(rig, DriverState::jogging);
  EffectorCommand hurried =
      rig.jog({1000});  // within the speed of the motor, too far for the macrostep's acceleration
  const EffectorReply reply = rig.macrostep(hurried);
  EXPECT_NE(reply.verdict, Verdict::executed);
  EXPECT_EQ(rig.driver.state(), transition(DriverState::jogging, Event::failed).next);
}

TEST(Automaton, HomingThatIsDoneLeadsToReady) {
  Rig rig(homing_parameters());
  lead_into(rig, DriverState::homing);
  for (int k = 0; k < 5000 && rig.driver.state() == DriverState::homing; ++k) rig.silence(1);
  EXPECT_EQ(rig.driver.state(), transition(DriverState::homing, Event::homed).next);
  EXPECT_TRUE(rig.driver.synchronised());
}

TEST(Automaton, EveryStateCanBeReachedAndLeft) {
  std::array<bool, kDriverStates> reached{}, left{};
  for (const StateRow& row : kAutomaton)
    for (const Transition& t : row.on)
      if (t.refusal == FaultCode::none && t.next != row.state) {
        reached[static_cast<std::size_t>(t.next)] = true;
        left[static_cast<std::size_t>(row.state)] = true;
      }
  for (const DriverState state : all_states()) {
    EXPECT_TRUE(reached[static_cast<std::size_t>(state)]) << to_string(state);
    EXPECT_TRUE(left[static_cast<std::size_t>(state)]) << to_string(state);
  }
}

TEST(AutomatonDocument, IsMadeFromTheTable) {
  if (std::getenv("MRROC_UPDATE_DOCS") != nullptr) std::ofstream(kDocument) << automaton_document();
  std::stringstream text;
  text << std::ifstream(kDocument).rdbuf();
  EXPECT_TRUE(text.str() == automaton_document())
      << "run: MRROC_UPDATE_DOCS=1 ./run test -R AutomatonDocument";
}

}  // namespace
}  // namespace mrroc::edp::test
