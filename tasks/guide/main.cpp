// The operator leads a tool that moves only on a virtual fixture.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "launch/arm_task.hpp"
#include "mp/leading_operator.hpp"
#include "tasks/guide/cell/guide_cell.hpp"
#include "tasks/guide/figures.hpp"
#include "tasks/guide/hand_way.hpp"
#include "tasks/guide/plots.hpp"

namespace {

using namespace mrroc;

/// What the command line says of the fixture.
struct FixtureOptions {
  std::string fixture;
  std::optional<double> size;
  int stroke{};
};

void add_options(CommandLine& line, FixtureOptions& o) {
  line.option("--fixture", o.fixture,
              "what the tool may move on: line, plane, circle or a curve of an SVG file")
      .type_name("WHAT|FILE.svg");
  line.option("--size", o.size, "larger side of the drawing of a file (default 120)").type_name("MM");
  line.option("--stroke", o.stroke, "which stroke of a file is the fixture (default: its only one)")
      .range(1, 10'000)
      .type_name("N");
}

/// What the parts of a run share.
struct Run {
  std::shared_ptr<const guide::Setup> setup;
  std::vector<guide::WayPoint> way;
  Pose T_0P;
};

void prepare(Run& run, const launch::Setup& s) {
  run.setup = guide::read_setup(s.config, "arm1");
  guide::check_reach(s.config, *run.setup);
  run.T_0P = guide::sheet_of(s.config);
  run.way = guide::hand_way(*run.setup,
                            guide::read_operator(s.config, run.setup->law, guide::hand_compliance(s.config)));
}

/// What is wrong with a curve is wrong with the file that draws it.
void naming_file(const std::string& fixture, const std::function<void()>& read) {
  try {
    read();
  } catch (const FaultError& e) {
    const std::string text = e.what(), key = "task.curve";
    if (!fixture.ends_with(".svg") || !text.starts_with(key)) throw;
    throw FaultError(FaultCode::bad_drawing, fixture + text.substr(key.size()), std::string(e.remedy()));
  }
}

mp::FarewellPlan farewell(const Run& run, bool gives_orders) {
  const Vector3 away(0, -0.03, 0.02);  // towards the arm and up, in the sheet [m]
  const Vector3 p = run.T_0P.inverse() * run.way.back().p + away;
  return {.point = 1e3 * p.head<2>(),
          .height = p.z(),
          .leave = static_cast<int>(run.setup->leave / guide::kPacing.macrostep_s()),
          .gives_orders = gives_orders};
}

std::vector<launch::Picture> pictures(const std::vector<mp::ArmTrace>& arms, const Config& config) {
  const auto k = guide::read_setup(config, "arm1");
  if (guide::led_rows(arms[0], *k).empty()) return {};  // the tool never came to the fixture
  return {{.name = "fixture", .script = guide::fixture_script(*k)},
          {.name = "force", .chart = guide::force_chart(arms[0], *k), .arms = {0, 0}}};
}

std::vector<mp::BehaviourWords> behaviours() {
  auto words = launch::words_of(guide::kGuide);
  for (const int m : {guide::kGuided, guide::kAway}) words[static_cast<std::size_t>(m) - 1].by_trigger = true;
  return words;
}

}  // namespace

int main(int argc, char** argv) {
  FixtureOptions options;
  Run run;
  launch::ArmTask arm_task{.name = "guide",
                           .about =
                               "An operator leads a tool that moves only on a virtual fixture, a line, "
                               "plane, circle or drawn curve:\n"
                               "freely along it, stiffly across it, with a wall at its ends.",
                           .config = guide::config(),
                           .behaviours = behaviours(),
                           .ecp = guide::run_ecp,
                           .figures = guide::figures,
                           .pictures = pictures,
                           .make_operator =
                               [&](mp::TaskRun& task, bool gives_orders) {
                                 return std::make_unique<mp::LeadingOperator>(
                                     task.process(), task.command_server(), task.board(),
                                     farewell(run, gives_orders));
                               },
                           .n_s = guide::kPacing.n_s};
  launch::Task task = launch::task_of(arm_task);
  task.options = [&](CommandLine& line) { add_options(line, options); };
  task.examples = {"./run guide --fixture circle", "./run guide --fixture my.svg --size 100"};
  task.instead_of_config = {"--fixture", "--size", "--stroke"};
  task.found = [&](mp::TaskOptions&) {
    return guide::fixture_settings(options.fixture, options.size, options.stroke);
  };
  task.unattended = ", unattended: the simulated operator gives start and triggers";
  task.prepare = [&, of_arm = task.prepare](const launch::Setup& s) {
    naming_file(options.fixture, [&] {
      of_arm(s);
      prepare(run, s);
    });
  };
  task.strokes = mp::kHandFile;
  task.files = [&](const std::filesystem::path& folder) {
    mp::write_hand_way(folder / mp::kHandFile, run.way, run.T_0P);
  };
  return launch::run_task(task, argc, argv);
}
