// MP and supervisor: an operator leads a master arm, and feels what the slave meets.
#include <memory>
#include <vector>

#include "ecp/transparent.hpp"
#include "launch/evaluation.hpp"
#include "launch/task.hpp"
#include "mp/coordinated_run.hpp"
#include "mp/leading_operator.hpp"
#include "tasks/haptic/cell/haptic_cell.hpp"

namespace {

using namespace mrroc;

/// What the parts of a run share.
struct Run {
  haptic::Parameters k;
  haptic::Scene scene;
  std::vector<mp::WayPoint> way;
};

void prepare(Run& run, const launch::Setup& s) {
  run.k = haptic::read_parameters(s.config);
  run.scene = haptic::read_scene(s.config);
  run.way = haptic::hand_way(run.scene, run.k.law, haptic::read_operator(s.config));
  haptic::check_reach(s.config, run.scene, run.k.law, run.way);
}

mp::FarewellPlan farewell(const Run& run, bool gives_orders) {
  return {.point = Eigen::Vector2d(0, -30),
          .height = run.scene.height,
          .leave = static_cast<int>(run.k.fade / run.k.law.macrostep),
          .gives_orders = gives_orders};
}

std::unique_ptr<mp::CoordinatorRun> coordinator(const Run& run, mp::TaskRun& task, const launch::Setup& s) {
  mp::CoordinatedParameters links{
      .arms = {"arm1", "arm2"}, .n_s = haptic::kPacing.n_s, .gives_start = s.options.scripted()};
  links.by_trigger = {haptic::kCoupled, haptic::kUncoupled};
  links.make_operator = [&run](mp::TaskRun& t, bool gives_orders) {
    return std::make_unique<mp::LeadingOperator>(t.process(), t.command_server(), t.board(),
                                                 farewell(run, gives_orders));
  };
  return std::make_unique<mp::CoordinatedRun<haptic::Coordinator>>(
      task, links, haptic::Memory{.k = run.k},
      [](auto& x, auto& port) { return haptic::run_program(x, port); });
}

}  // namespace

int main(int argc, char** argv) {
  Run run;
  launch::Evaluation evaluation;
  evaluation.behaviours = launch::words_of(haptic::kBehaviours);
  launch::Task task{.name = "haptic",
                    .about =
                        "An operator's hand leads a master arm; a slave follows in its own cell,\n"
                        "and the hand feels what it meets, also through a channel with delay and losses.",
                    .config = haptic::config(),
                    .arms = {{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}},
                    .ecp = ecp::run_transparent,
                    .ecp_program = "ecp_transparent"};
  task.unattended = ", unattended: the simulated operator gives start and triggers";
  task.prepare = [&](const launch::Setup& s) { prepare(run, s); };
  task.strokes = mp::kHandFile;
  task.files = [&](const std::filesystem::path& folder) {
    mp::write_hand_way(folder / mp::kHandFile, run.way, run.scene.T_0P);
  };
  task.coordinator = [&](mp::TaskRun& t, const launch::Setup& s) { return coordinator(run, t, s); };
  task.results = [&](launch::Results& r) { launch::evaluate(evaluation, r); };
  return launch::run_task(task, argc, argv);
}
