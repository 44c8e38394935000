#include "test/rig/cube_turn.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "base/representation.hpp"
#include "base/statistics.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/program.hpp"
#include "test/rig/cube_limits.hpp"
#include "test/rig/driven_arms.hpp"

namespace mrroc::rig {
namespace {

using std::numbers::pi;

constexpr int kClosing = 20;     // macrosteps in which the holder presses before it rests
constexpr int kResting = 60;     // most macrosteps until both rest
constexpr double kSteady = 0.5;  // [s] from which the force of the approach has died away

/// Of the components of a vector.
class Spread {
 public:
  void add(const Vector3& x) {
    for (std::size_t k = 0; k < of_.size(); ++k) of_[k].add(x[static_cast<Eigen::Index>(k)]);
  }
  /// @return largest standard deviation of the components
  [[nodiscard]] double largest() const {
    return std::max({of_[0].deviation(), of_[1].deviation(), of_[2].deviation()});
  }

 private:
  std::array<Statistics, 3> of_;
};

/// Follows one turn and makes its figures.
class Observer {
 public:
  Observer(DrivenCell& cell, const TurnPlan& plan) : cell_(cell), plan_(plan) {
    cell_.watch([this] { figures_.squeeze = std::max(figures_.squeeze, cell_.world().cube()->squeeze); });
  }
  ~Observer() { cell_.watch({}); }

  void macrostep(int m) {
    if (m != m_) enter(m);
    const Wrench& F_worker = cell_.reply(rubik::kPostument).F_a;
    const double F_z = F_worker[Axis::z];
    if (m == 1 || m == 2) figures_.approach_peak = std::max(figures_.approach_peak, F_z);
    if (m == 2 && ++settling_ > rubik::kSettling / 2) {
      settled_ += F_z;
      figures_.approach_settled = settled_ / ++settled_count_;
    }
    if (m == 5) turning();
  }

  /// @param state  of the cube before
  TurnFigures finish(const cube::Cube& state) {
    const sim::CubeTruth& cube = *cell_.world().cube();
    figures_.turned = cube.state == state * cube::turn(move_of(plan_));
    figures_.dropped = cube.on_floor;
    figures_.lateral_std = all_.largest();
    figures_.steady_std = steady_.largest();
    figures_.turn_s = turn_s_;
    figures_.cycle_s = now() - begun_;
    return figures_;
  }

 private:
  [[nodiscard]] double now() const { return static_cast<double>(cell_.world().steps()) * sim::kStep; }
  [[nodiscard]] Pose in_holder() const {
    return cell_.world().effector(rubik::kTrack).inverse() * cell_.world().cube()->T_UC;
  }

  void enter(int m) {
    if (m_ == 5) turn_s_ += now() - turn_begun_;
    m_ = m;
    if (m == 1) begun_ = now();
    if (m != 5) return;
    turn_begun_ = now();
    held_ = in_holder();
    T_UE_ = cell_.world().effector(rubik::kTrack);
    T_UF_ = cell_.world().effector(rubik::kPostument);
  }

  void turning() {
    const Wrench& F = cell_.reply(rubik::kTrack).F_a;
    all_.add(F.linear());
    if (now() - turn_begun_ >= kSteady) steady_.add(F.linear());
    figures_.lateral_peak = std::max(figures_.lateral_peak, F.linear().cwiseAbs().maxCoeff());
    figures_.torque_peak = std::max(figures_.torque_peak, std::abs(F[Axis::az]));
    figures_.slip = std::max(figures_.slip, (in_holder().p - held_.p).norm());

    const Matrix3 R = T_UE_.R.transpose() * cell_.world().effector(rubik::kTrack).R;
    const double tool = std::abs(std::atan2(R(1, 0), R(0, 0)));
    // From 45 degrees on the face's angle counts from the seat to which it goes.
    const double left =
        std::ranges::max(cell_.world().cube()->angle, {}, [](double a) { return std::abs(a); });
    if (tool > pi / 4 + 0.1 && std::abs(left) > sim::kDetent)
      figures_.angle_error = std::max(figures_.angle_error, std::abs(tool - (pi / 2 - std::abs(left))));
  }

  DrivenCell& cell_;
  const TurnPlan& plan_;
  TurnFigures figures_;
  Spread all_, steady_;
  double begun_{}, turn_begun_{}, turn_s_{};
  int m_{}, settled_count_{};
  std::int64_t settling_{};
  double settled_{};
  Pose held_, T_UE_, T_UF_;
};

bool resting(const DrivenCell& cell) {
  return cell.reply(rubik::kPostument).state == DriverState::holding &&
         cell.reply(rubik::kTrack).state == DriverState::holding;
}

/// The holder presses, and both come to rest.
void close_holder(DrivenCell& cell) {
  EffectorCommand grip = ecp::move_arm(rubik::kStill, rubik::kPacing);
  grip.arm.gripper = rubik::kClosest;
  for (int k = 0; k < kClosing; ++k) {
    cell.send(rubik::kTrack, grip);
    cell.wait();
  }
  for (int k = 0; k < kResting && !(k > 3 && resting(cell)); ++k) cell.wait();
}

rubik::Load load_of(const rubik::LoadedTool& tool) { return {tool.weight, tool.mass_centre}; }

/// @return the task's parameters with what hangs on the sensors: the worker has the cube never, the holder always
rubik::Parameters parameters(const TurnPlan& plan, const DrivenCell& cell, const sim::CubeParameters& cube) {
  rubik::Parameters k = plan.task;
  const irb6::ArmParameters& worker = cell.robot(rubik::kPostument).parameters();
  k.load[rubik::kPostument].fill(
      {worker.tool_weight, Eigen::Map<const Vector3>(worker.tool_mass_centre.data())});
  k.load[rubik::kTrack].fill(load_of(rubik::tool_with_cube(rubik::kTrack, cube)));
  return k;
}

/// One cycle, from where the worker stands now.
rubik::Step cycle(const TurnPlan& plan, const irb6::Arm& worker, const sim::WorldParameters& world) {
  rubik::Step step;
  const std::vector<double>& start = world.arms[rubik::kPostument].start;
  const AxisVector here =
      Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  step.before = {{.hand = cube::Hand::postument, .points = {{here, worker.motors_from_joints(here)}}}};
  step.comes = cube::Hand::postument;
  step.leaves = cube::Hand::track;
  step.before_grasp.hand = cube::Hand::track;
  step.after_grasp.hand = cube::Hand::postument;
  step.turn = move_of(plan);
  step.angle = plan.quarters * pi / 2;
  return step;
}

}  // namespace

cube::Move move_of(const TurnPlan& plan) {
  // The worker keeps the face, the holder turns the rest about z, which comes out of the face: the other way round.
  return {plan.cell.face, plan.quarters > 0 ? 1 : 3};
}

TurnFigures turn_face(const TurnPlan& plan, std::uint64_t seed,
                      const std::function<void(DrivenCell&, int m)>& watch) {
  const sim::WorldParameters world = rubik::cube_cell(plan.cell);
  DrivenCell cell(world, seed, cube_limits());
  close_holder(cell);

  Observer observer(cell, plan);
  const rubik::CubePlanCell limits(rubik::usual_cell());
  DrivenArms arms(cell,
                  {limits.limits(cube::Hand::postument).motors, limits.limits(cube::Hand::track).motors},
                  cell.world().steps() + static_cast<std::int64_t>(plan.timeout / sim::kStep), [&](int m) {
                    observer.macrostep(m);
                    if (watch) watch(cell, m);
                  });
  rubik::Coordinator::X x;
  x.c.k = parameters(plan, cell, *world.cube);
  rubik::ExecutionLog execution_log;
  rubik::Program<DrivenArms> program(x, arms, execution_log);
  const bool done = program.execute(cycle(plan, cell.robot(rubik::kPostument), world)) == Outcome::terminated;
  TurnFigures figures = observer.finish(world.cube->state);
  figures.done = done;
  figures.grips = execution_log.back().grips;
  figures.attempts = execution_log.back().attempts;
  figures.failure = program.failure();
  figures.fault = arms.fault();
  return figures;
}

TurnPlan random_turn(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double most) {
    return most * (2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1);
  };
  TurnPlan plan;
  plan.cell.faces.seed = random();
  plan.cell.state = cube::random_cube(random);
  plan.cell.face = static_cast<cube::Face>(random() % 6);
  plan.quarters = random() % 2 ? 1 : -1;
  const double direction = uniform(pi);
  const double off = std::abs(uniform(0.001));
  plan.cell.grasp_error = {off * std::cos(direction), off * std::sin(direction), 0};
  plan.cell.turn_error = uniform(pi / 180);
  return plan;
}

}  // namespace mrroc::rig
