// Any trajectory: arms execute the motions of a file, each with a generator of ecp/generators.
#include <fmt/core.h>
#include <algorithm>

#include <tuple>

#include "launch/arm_task.hpp"
#include "tasks/move/cell/arm_body.hpp"
#include "tasks/move/config.hpp"
#include "tasks/move/plots.hpp"
#include "tasks/move/recorded_motion.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

const std::vector<launch::CellArm> kArms{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};

/// Values of the task's options.
struct Options {
  fs::path file;
  bool dry_run{};
};

any_motion::Plan plan_of(const Config& config) {
  return any_motion::read_plan(config, any_motion::make_arm_body);
}

/// The arms with their axes, of the task's own configuration: recordings are read before there is that of the run.
std::vector<any_motion::ArmKey> known_arms() {
  const Config config = Config::parse(any_motion::config(), "move.toml");
  std::vector<any_motion::ArmKey> keys;
  for (const launch::CellArm& arm : kArms)
    keys.push_back({arm.key, any_motion::make_arm_body(config, arm.key)->axes()});
  return keys;
}

/// The motions, with what their recordings hold.
struct Motions {
  Config file;
  any_motion::Recordings recordings;
};

Motions motions(const Options& o) {
  if (o.file.empty()) return {Config::parse(any_motion::example(), "example.toml (built in)"), {}};
  Motions m{Config::load(o.file), {}};
  m.recordings =
      any_motion::insert_recordings(m.file, known_arms(), o.file.parent_path(), any_motion::make_arm_body);
  return m;
}

/// The file is looked at as such, too: its errors name its lines.
void prepare(const Options& o, const launch::Setup& s, any_motion::Plan& plan) {
  if (!o.file.empty()) {
    std::vector<any_motion::ArmKey> keys;
    for (const launch::CellArm& arm : kArms)
      keys.push_back({arm.key, any_motion::make_arm_body(s.config, arm.key)->axes()});
    const any_motion::MotionFile file = any_motion::read_motions(motions(o).file, keys);
    if (std::ranges::all_of(file.arms, [](const any_motion::ArmMotions& arm) { return arm.motions.empty(); }))
      throw FaultError(FaultCode::bad_trajectory, fmt::format("{}: there is no motion", o.file.string()),
                       "write a table of an arm, its motions, and their names in its `order`");
  }
  try {
    plan = plan_of(s.config);
    any_motion::rehearse(s.config, plan);
  } catch (const ConfigError&) {
    throw;
  } catch (const FaultError& e) {  // of a motion, which is bad input here
    throw FaultError(FaultCode::bad_trajectory, fmt::format("{}: {}", to_string(e.fault().code), e.what()),
                     std::string(e.remedy()));
  }
}

std::vector<launch::Picture> pictures(const std::vector<mp::ArmTrace>& arms, const any_motion::Plan& plan) {
  std::vector<launch::Picture> all;
  for (std::size_t arm = 0; arm < arms.size(); ++arm)
    if (!any_motion::stretches_of(arms[arm], any_motion::row(any_motion::Row::move).m).empty())
      all.push_back({.name = plan.arms[arm].arm,
                     .chart = any_motion::motion_chart(arms[arm], plan.arms[arm]),
                     .arms = {arm, arm, arm}});
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  any_motion::Plan plan;
  any_motion::Recordings recordings;
  launch::Task task = launch::task_of(
      {.name = "move",
       .about =
           "One arm or two execute the motions of a file: positions in motors, joints or poses, joined by\n"
           "trapezoids, splines, NURBS, straight lines or as they were recorded. Without a file: an example.",
       .config = any_motion::config(),
       .behaviours = launch::words_of(any_motion::kMove),
       .ecp = any_motion::run_move_ecp,
       .figures = [](const std::vector<mp::ArmTrace>& arms,
                     const Config& config) { return any_motion::figures(arms, plan_of(config)); },
       .pictures = [](const std::vector<mp::ArmTrace>& arms,
                      const Config& config) { return pictures(arms, plan_of(config)); },
       .coordinate = any_motion::coordinate,
       .arms = kArms});
  task.options = [&](CommandLine& line) {
    line.option("--file", o.file, "the motions, TOML: tasks/move/README.md").type_name("PATH");
    line.flag("--dry-run", o.dry_run,
              "instead of a run: check the motions against all limits, and list them");
  };
  task.examples = {"./run move --file tasks/move/two_arms.toml", "./run move --file my.toml --dry-run"};
  task.instead_of_config = {"--file"};
  task.found = [&](mp::TaskOptions& options) {
    if (!options.check.empty()) return std::vector<std::string>{};
    Motions m = motions(o);
    recordings = std::move(m.recordings);
    return any_motion::settings_of(m.file, launch::keys_of(kArms));
  };
  const auto read_all = task.prepare;
  task.prepare = [&, read_all](const launch::Setup& s) {
    prepare(o, s, plan);
    read_all(s);
  };
  task.files = [&](const fs::path& folder) {
    for (const auto& [motion, path] : recordings) ecp::save(folder / (motion + ".taught"), path);
  };
  task.words = [&](const launch::Setup&) {
    return o.file.empty() ? std::string("an example") : o.file.string();
  };
  task.instead = [&](const launch::Setup&) {
    return o.dry_run ? any_motion::describe_plan(plan) + "within all limits\n" : std::string();
  };
  return launch::run_task(task, argc, argv);
}
