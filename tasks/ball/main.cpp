// Two arms carry a ball or a box between their palms around a circle.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ecp/transparent.hpp"
#include "launch/evaluation.hpp"
#include "launch/task.hpp"
#include "tasks/ball/ball_run.hpp"
#include "tasks/ball/cell/ball_cell.hpp"
#include "tasks/ball/config.hpp"
#include "tasks/ball/figures.hpp"
#include "tasks/ball/plots.hpp"
#include "tasks/ball/pushing_operator.hpp"

namespace {

using namespace mrroc;

/// What the command line says, and what the parts of a run share.
struct Ball {
  std::string object;
  bool hand{};
  ball::Parameters k;
  std::optional<ball::HandPush> push;
  Vector3 force_P{Vector3::Zero()};
};

void add_options(CommandLine& line, Ball& b) {
  line.option("--object", b.object, "what is carried: ball or box").one_of({"ball", "box"});
  line.flag("--hand", b.hand, "a simulated hand pushes an arm on its way, and both yield");
}

std::vector<std::string> settings(const Ball& b) {
  std::vector<std::string> s;
  if (!b.object.empty()) s.push_back("free_body.shape=" + b.object);
  if (b.hand) s.emplace_back("hand.arm=arm1");
  return s;
}

void prepare(Ball& b, const Config& config) {
  b.k = ball::read_setup(config);
  b.push = ball::read_hand_push(config);
  if (b.push) b.force_P = ball::force_in_sheet(config, *b.push);
}

std::unique_ptr<mp::CoordinatorRun> make_coordinator(const Ball& b, mp::TaskRun& run, bool gives_start) {
  mp::CoordinatedParameters links{.arms = {"arm1", "arm2"}, .gives_start = gives_start};
  if (b.push)
    links.make_operator = [&b](mp::TaskRun& task, bool starts) {
      return std::make_unique<ball::PushingOperator>(task.process(), task.command_server(), starts, *b.push,
                                                     b.force_P);
    };
  return std::make_unique<ball::BallRun>(run, links, b.k);
}

void make_results(const Ball& b, launch::Results& r) {
  const auto& rows = r.coordinator_as<ball::BallRun>().record().rows();
  ball::write_body_table(r.folder / "body.csv", rows);
  launch::Evaluation evaluation;
  evaluation.behaviours = launch::words_of(ball::kBehaviours);
  evaluation.figures = [&](const auto&, const Config&) {
    return ball::figures(rows, b.k, b.push.has_value());
  };
  evaluation.pictures = [&](const auto&, const Config&) {
    const auto has = [&](int m) { return std::ranges::find(rows, m, &ball::BodyRow::m) != rows.end(); };
    std::vector<launch::Picture> pictures;
    if (has(ball::kLift)) pictures.push_back({.name = "path", .script = ball::path_script(rows)});
    if (has(ball::kSqueeze))
      pictures.push_back({.name = "force", .chart = ball::force_chart(rows, b.k), .arms = {0}});
    return pictures;
  };
  launch::evaluate(evaluation, r);
}

}  // namespace

int main(int argc, char** argv) {
  Ball b;
  return launch::run_task(
      {.name = "ball",
       .about = "Two arms carry a ball or a box between their palms, with an inner force, around a circle.",
       .config = ball::config(),
       .arms = {{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}},
       .ecp = ecp::run_transparent,
       .ecp_program = "ecp_transparent",
       .options = [&](CommandLine& line) { add_options(line, b); },
       .examples = {"./run ball --object box", "./run ball --hand"},
       .instead_of_config = {"--object", "--hand"},
       .found = [&](mp::TaskOptions&) { return settings(b); },
       .complete = [](Config& config, const mp::TaskOptions&) { ball::complete_start(config); },
       .prepare = [&](const launch::Setup& s) { prepare(b, s.config); },
       .coordinator = [&](mp::TaskRun& run,
                          const launch::Setup& s) { return make_coordinator(b, run, s.options.scripted()); },
       .results = [&](launch::Results& r) { make_results(b, r); }},
      argc, argv);
}
