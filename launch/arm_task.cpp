#include "launch/arm_task.hpp"

namespace mrroc::launch {
namespace {

mp::SoloParameters solo_parameters(const ArmTask& task, const Setup& s) {
  mp::SoloParameters k{.arms = keys_of(task.arms), .behaviours = task.behaviours};
  k.dt = s.config.number("time.dt", k.dt, {0.002, 0.002}, "s");
  k.n_s = s.config.integer("time.n_s", task.n_s, {task.n_s, task.n_s}, "steps");
  k.coordinate = task.coordinate;
  k.make_operator = task.make_operator;
  k.gives_start = s.options.scripted();
  return k;
}

/// Everybody reads the configuration once.
void read_all(const ArmTask& task, const Setup& s) {
  solo_parameters(task, s);
  if (task.read) task.read(s.config);
  if (task.figures) task.figures(std::vector<mp::ArmTrace>(task.arms.size()), s.config);
}

}  // namespace

Task task_of(const ArmTask& task) {
  return {.name = task.name,
          .about = task.about,
          .config = task.config,
          .arms = task.arms,
          .ecp = task.ecp,
          .receptors = task.receptors,
          .prepare = [task](const Setup& s) { read_all(task, s); },
          .coordinator =
              [task](mp::TaskRun& run, const Setup& s) {
                return std::make_unique<mp::SoloRun>(run, solo_parameters(task, s));
              },
          .results =
              [task](Results& r) {
                evaluate({task.behaviours, task.figures, task.pictures, task.result}, r);
              }};
}

int run_arm_task(const ArmTask& task, int argc, char** argv) { return run_task(task_of(task), argc, argv); }

}  // namespace mrroc::launch
