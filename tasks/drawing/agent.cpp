// The transparent agents a_1 and a_2 (MS 34-36).
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using X = Arm::X;

None nothing(const X&) { return {}; }

EffectorCommand copy_order(const X& x) {  // (36)
  EffectorCommand command;
  command.instruction = Instruction::set_get;
  command.set = static_cast<std::uint8_t>(Part::arm);
  command.get = static_cast<std::uint8_t>(Part::arm);
  command.arm = x.T.arm;
  return command;
}

Report copy_images(const X& x) {  // (34), (35)
  Report r;
  r.m = x.T.m;
  r.ready = true;
  r.sensor = x.V.state;
  r.driver_state = x.e.state;
  r.verdict = x.e.verdict;
  r.fault = x.e.fault;
  r.T_0E = x.e.T_0E;
  r.F_a = x.e.F_a;
  r.gripper = x.e.gripper;
  r.blocked = x.e.blocked;
  return r;
}

bool finished(const X& x) { return x.T.finished; }

}  // namespace

const Motion<Arm> kTransparent{
    1, "copy the coordinator's orders", nothing, nothing, copy_order, nothing, copy_images, finished};

}  // namespace mrroc::drawing
