// MP and supervisor: an operator leads a master arm, and feels what the slave meets.
#include <fmt/core.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ecp/transparent.hpp"
#include "launch/evaluation.hpp"
#include "launch/task.hpp"
#include "mp/coordinated_run.hpp"
#include "mp/leading_operator.hpp"
#include "tasks/haptic/cell/haptic_cell.hpp"
#include "tasks/haptic/figures.hpp"
#include "tasks/haptic/plots.hpp"
#include "tasks/haptic/record.hpp"

namespace {

using namespace mrroc;

/// What the parts of a run share.
struct Run {
  haptic::Parameters k;
  haptic::Scene scene;
  std::vector<mp::WayPoint> way;
  haptic::HapticRecord record;
};

/// What the command line says of the channel.
struct ChannelOptions {
  std::optional<double> delay, jitter, loss;
};

void add_options(CommandLine& line, ChannelOptions& o) {
  line.option("--delay", o.delay, "delay of the channel between the arms, each way")
      .range(0.0, 200.0)
      .type_name("MS");
  line.option("--jitter", o.jitter, "more than that, at most").range(0.0, 100.0).type_name("MS");
  line.option("--loss", o.loss, "share of packets that are lost").range(0.0, 50.0).type_name("PERCENT");
}

std::vector<std::string> channel_settings(const ChannelOptions& o) {
  std::vector<std::string> settings;
  if (o.delay) settings.push_back(fmt::format("task.delay={}", 1e-3 * *o.delay));
  if (o.jitter) settings.push_back(fmt::format("task.jitter={}", 1e-3 * *o.jitter));
  if (o.loss) settings.push_back(fmt::format("task.loss={}", 1e-2 * *o.loss));
  return settings;
}

void prepare(Run& run, const launch::Setup& s) {
  run.k = haptic::read_parameters(s.config);
  run.scene = haptic::read_scene(s.config);
  run.way = haptic::hand_way(run.scene, run.k.law, haptic::read_operator(s.config, run.k.law));
  haptic::check_reach(s.config, run.scene, run.k.law, run.way);
  const haptic::Surroundings around = haptic::read_surroundings(s.config);
  haptic::check_stability(around, run.k.law);
  run.k.law.grows_gently = haptic::grows_gently(around, run.k.law);
}

mp::FarewellPlan farewell(const Run& run, bool gives_orders) {
  return {.point = Eigen::Vector2d(0, -30),
          .height = run.scene.height,
          .leave = static_cast<int>(run.k.fade / run.k.law.macrostep),
          .gives_orders = gives_orders};
}

std::unique_ptr<mp::CoordinatorRun> coordinator(Run& run, mp::TaskRun& task, const launch::Setup& s) {
  mp::CoordinatedParameters links{
      .arms = {"arm1", "arm2"}, .n_s = haptic::kPacing.n_s, .gives_start = s.options.scripted()};
  links.by_trigger = {haptic::kCoupled, haptic::kUncoupled};
  links.make_operator = [&run](mp::TaskRun& t, bool gives_orders) {
    return std::make_unique<mp::LeadingOperator>(t.process(), t.command_server(), t.board(),
                                                 farewell(run, gives_orders));
  };
  return std::make_unique<mp::CoordinatedRun<haptic::Coordinator>>(
      task, links, haptic::Memory{.k = run.k},
      [](auto& x, auto& port) { return haptic::run_program(x, port); },
      [&run](const Motion<haptic::Coordinator>& motion, const haptic::Coordinator::X& x) {
        haptic::note(run.record, motion.m, x);
      });
}

void results(const Run& run, launch::Results& r) {
  haptic::write_record(r.folder / haptic::kRecordFile, run.record);
  launch::Evaluation evaluation;
  evaluation.behaviours = launch::words_of(haptic::kBehaviours);
  evaluation.figures = [&](const std::vector<mp::ArmTrace>&, const Config&) {
    return haptic::figures(run.record, run.k.law);
  };
  evaluation.pictures = [&](const std::vector<mp::ArmTrace>&, const Config&) {
    if (run.record.empty()) return std::vector<launch::Picture>{};  // the arms were never coupled
    const haptic::Law& law = run.k.law;
    return std::vector<launch::Picture>{{.name = "motion", .chart = haptic::motion_chart(law), .arms = {0}},
                                        {.name = "force", .chart = haptic::force_chart(law), .arms = {0}},
                                        {.name = "energy", .chart = haptic::energy_chart(), .arms = {0}}};
  };
  launch::evaluate(evaluation, r);
}

}  // namespace

int main(int argc, char** argv) {
  Run run;
  ChannelOptions options;
  launch::Task task{.name = "haptic",
                    .about =
                        "An operator's hand leads a master arm; a slave follows in its own cell,\n"
                        "and the hand feels what it meets, also through a channel with delay and losses.",
                    .config = haptic::config(),
                    .arms = {{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}},
                    .ecp = ecp::run_transparent,
                    .ecp_program = "ecp_transparent"};
  task.options = [&](CommandLine& line) { add_options(line, options); };
  task.examples = {"./run haptic --delay 100", "./run haptic --delay 50 --jitter 20 --loss 10"};
  task.instead_of_config = {"--delay", "--jitter", "--loss"};
  task.typed = {{"task.delay", "--delay"}, {"task.jitter", "--jitter"}, {"task.loss", "--loss"}};
  task.found = [&](mp::TaskOptions&) { return channel_settings(options); };
  task.unattended = ", unattended: the simulated operator gives start and triggers";
  task.prepare = [&](const launch::Setup& s) { prepare(run, s); };
  task.strokes = mp::kHandFile;
  task.files = [&](const std::filesystem::path& folder) {
    mp::write_hand_way(folder / mp::kHandFile, run.way, run.scene.T_0P);
  };
  task.coordinator = [&](mp::TaskRun& t, const launch::Setup& s) { return coordinator(run, t, s); };
  task.results = [&](launch::Results& r) { results(run, r); };
  return launch::run_task(task, argc, argv);
}
