#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {

struct CalibrateCell {
  using Agent = calibrate_cell::Arm;
  static constexpr bool kHasNoDefaults = true;  // nobody can guess the orientations and the balls
  static constexpr const char* kFolder = "tasks/calibrate_cell";
  static auto behaviours() { return calibrate_cell::kBehaviours; }
  /// What the cell tells of the robot, one ball, one picture.
  static calibrate_cell::Memory memory(Config config) {
    for (const char* key :
         {"robots.arm1.tool.pose=[0, 0, 0.25, 0, 0, 0]", "robots.arm1.tool.weight=10",
          "robots.arm1.tool.mass_centre=[0, 0, 0]", "robots.arm1.start_joints=[0, -1.5, 0, 0, 4.7, 0]",
          "artefact.balls=[0, 0, 0]", "task.arm1.balls=[0.5, 0, 0.8]",
          "task.arm1.stand=[0, -1.5, 0, 0, 4.7, 0]", "task.arm1.views=[0, -1.5, 0, 0.1, 4.7, 0]"})
      config.set(key);
    calibrate_cell::Memory c = calibrate_cell::read_memory(config, "arm1");
    c.views.resize(1);  // turns that random orders name: 0 to 3
    c.touch_turn = 3;
    return c;
  }
  /// Once nothing is there to be touched, then there is: a world that does anything moves the tip by metres.
  static Outcome run(Agent::X& x, auto& port) {
    Outcome o = Outcome::terminated;
    for (const double beyond : {0., 10.}) {
      if (o != Outcome::terminated) break;
      x.c = memory(Config::parse(calibrate_cell::config(), "calibrate_cell.toml"));
      x.c.plan.beyond = beyond;
      if (beyond == 0) x.c.views.clear();
      o = calibrate_cell::run_program(x, port);
    }
    return o;
  }
  static bool same(const calibrate_cell::Memory& a, const calibrate_cell::Memory& b) {
    const ecp::Weighing &v = a.weighing, &w = b.weighing;
    return v.sum.v == w.sum.v && v.readings == w.readings && v.found.w == w.found.w && a.plan == b.plan &&
           a.views == b.views && a.turn == b.turn && a.view == b.view && a.waits_for == b.waits_for &&
           a.touch_turn == b.touch_turn && a.ready == b.ready && a.T_ready.p == b.T_ready.p &&
           a.T_ready.R == b.T_ready.R && a.done == b.done && a.path.macrosteps() == b.path.macrosteps() &&
           a.from == b.from && a.contact == b.contact && a.sum == b.sum && a.readings == b.readings;
  }
  static void configure(const Config& config) { std::ignore = memory(config.copy()); }
};
INSTANTIATE_TYPED_TEST_SUITE_P(CalibrateCell, TaskContract, CalibrateCell);

}  // namespace mrroc::contract
