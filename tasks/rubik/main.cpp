// The task of the cube: two arms read a scrambled cube, find a solution and turn its faces until it is solved.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "base/command_line.hpp"
#include "base/representation.hpp"
#include "mp/check_run.hpp"
#include "mp/summary_text.hpp"
#include "mp/task_run.hpp"
#include "mp/tell.hpp"
#include "sim/arm_task.hpp"
#include "sim/camera/config.hpp"
#include "sim/cube_camera.hpp"
#include "sim/cube_cell.hpp"
#include "sim/plan_cell.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/figure_info.hpp"
#include "tasks/rubik/plots.hpp"
#include "tasks/rubik/results.hpp"
#include "tasks/rubik/rubik_run.hpp"
#include "tasks/rubik/solver/solver.hpp"
#include "tasks/rubik/solver/table_progress.hpp"
#include "vsp/cube_face/receptor.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

const std::vector<sim::CellArm> kArms{{rubik::kArmKeys[0], "irb6_postument"},
                                      {rubik::kArmKeys[1], "irb6_track"}};
const std::string kCamera = sim::cube_camera().key;
const std::vector<std::string> kKeys{rubik::kArmKeys[0], rubik::kArmKeys[1]};

struct Options {
  mp::TaskOptions task;
  std::optional<std::string> scramble, state;
  std::string eyes{"camera"};
};

/// Everything that is known before anything starts.
struct Setup {
  Config config;
  rubik::Parameters k;
  sim::WorldParameters world;
  std::optional<CameraSetup> camera;
};

template <class Numbers>
std::string setting(const std::string& arm, const char* key, const Numbers& numbers) {
  return fmt::format("robots.{}.{}=[{:.6f}]", arm, key,
                     fmt::join(numbers.data(), numbers.data() + numbers.size(), ", "));
}

std::string pose_setting(const std::string& key, const Pose& T) {
  const AngleAxisPose r = angle_axis_from_pose(T);
  return fmt::format("{}=[{:.9f}]", key, fmt::join(r.data(), r.data() + r.size(), ", "));
}

/// The camera and the places where faces are shown to it.
std::vector<std::string> camera_settings() {
  const CameraSetup camera = sim::cube_camera();
  const std::string prefix = fmt::format("cameras.{}.", camera.key);
  std::vector<std::string> settings{
      fmt::format("cameras.order=[\"{}\"]", camera.key), prefix + "mount=world",
      fmt::format("{}period={}", prefix, camera.period), fmt::format("{}fx={}", prefix, camera.model.fx),
      fmt::format("{}fy={}", prefix, camera.model.fy),   pose_setting(prefix + "pose", camera.place)};
  for (int reading = 0; reading < rubik::kReadings; ++reading)
    settings.push_back(pose_setting(fmt::format("cube_face.places.reading{}.pose", reading + 1),
                                    sim::viewing_place(reading).T_UG));
  return settings;
}

/// The grips of the cell begin with the cube in the hand whose fingers cover two layers.
void check_holder(const sim::WorldParameters& world) {
  if (!world.cube || world.cube->held_by != static_cast<int>(rubik::index(rubik::Hand::track)))
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("cube.held_by: {} holds the cube at the beginning; give that, or nothing",
                                 kKeys[rubik::index(rubik::Hand::track)]));
}

/// What the options say of the cube; nothing if they say nothing.
std::vector<std::string> cube_settings(const Options& o) {
  if (!o.scramble && !o.state) return {};
  if (o.state && o.state->empty())
    throw FaultError(FaultCode::bad_usage, "--state is empty", "give 54 facelets: U R F D L B, nine each");
  return {fmt::format("cube.scramble=\"{}\"", o.scramble.value_or("")),
          fmt::format("cube.state=\"{}\"", o.state.value_or("")), "cube.random_turns=0"};
}

/// @return whether a file or a setting says of the cube what it looks like
bool describes_cube(const Config& config) {
  return std::ranges::any_of(std::array{"cube.scramble", "cube.state", "cube.random_turns"},
                             [&](const char* key) { return config.has(key); });
}

Setup prepare(Options& o) {
  Setup s;
  const std::vector<std::string> cube = cube_settings(o);
  o.task.settings.insert(o.task.settings.begin(), cube.begin(), cube.end());
  std::vector<std::string> settings;
  if (o.eyes == "camera") settings = camera_settings();
  sim::CubeCellParameters retreated;
  retreated.distance = rubik::kRetreatDistance;
  const sim::WorldParameters cell = sim::cube_cell(retreated);
  const sim::CubePlanCell limits(cell);
  for (const rubik::Hand hand : rubik::kHands) {
    const std::string& arm = kKeys[rubik::index(hand)];
    settings.push_back(setting(arm, "start_joints", cell.arms[rubik::index(hand)].start));
    settings.push_back(setting(arm, "motion.velocity", limits.limits(hand).motors.velocity));
    settings.push_back(setting(arm, "motion.acceleration", limits.limits(hand).motors.acceleration));
  }
  s.config = sim::load_task_config(o.task, rubik::config(), "rubik", settings);
  o.task.seed = sim::seed_of(s.config);
  if (!describes_cube(s.config)) s.config.set("cube.random_turns=20");
  s.world = sim::read_cell(s.config, kArms, o.task.seed);
  check_holder(s.world);
  s.k = rubik::read_parameters(s.config);
  for (std::size_t arm = 0; arm < kKeys.size(); ++arm)
    rubik::read_motion_limits(s.config, kKeys[arm], static_cast<int>(s.world.arms[arm].start.size()));
  if (s.config.has("cameras." + kCamera + ".pose")) {  // also that of a run which is checked
    sim::read_camera_world(s.config, kKeys);
    s.camera = read_camera(s.config, kCamera);
    vsp::make_cube_face_sensor(s.config, kCamera);
  }
  sim::check_task_options(o.task);
  return s;
}

std::vector<mp::Part> parts_of(const Setup& s) {
  const Config& config = s.config;
  auto parts = sim::cell_parts(config, kArms);
  if (s.camera)
    parts.push_back(
        sim::make_part(config, "vsp-" + s.camera->key, "vsp_cube_face", nullptr, vsp::run_cube_face));
  for (const sim::CellArm& arm : kArms)
    parts.push_back(sim::make_part(config, "ecp-" + arm.key, "ecp_rubik", &arm, rubik::run_ecp));
  return parts;
}

AxisVector axes(const std::vector<double>& q) {
  return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
}

/// Plans in the cell as it is when faces are shown at one place.
struct Planning {
  Planning(const sim::WorldParameters& world, const std::optional<rubik::Viewing>& viewing)
      : cell(world, viewing), planner(cell) {}
  sim::CubePlanCell cell;
  rubik::Planner planner;
};

/// What the coordinator thinks with.
struct Head {
  explicit Head(const Setup& s)
      : world(s.world),
        planning(s.world, s.camera ? std::optional(sim::viewing_place()) : std::nullopt),
        solver(s.config.choice("task.tables", rubik::TableSet::standard,
                               {{"small", rubik::TableSet::small},
                                {"default", rubik::TableSet::standard},
                                {"large", rubik::TableSet::large}}),
               rubik::table_folder(), kThreads, progress.watch()) {}

  /// A shortest solution of up to 14 turns, else a short one: the same in every run, so that nodes are counted, not time.
  [[nodiscard]] rubik::Solution solve(const rubik::Cube& cube) const {
    return solver.solve(cube,
                        {.shortest = {.nodes = kShortestNodes}, .two_phase = {.nodes = kTwoPhaseNodes}});
  }

  [[nodiscard]] rubik::Planned plan_reading(const rubik::PlanStart& start, int reading) {
    if (reading == 0) return planning.planner.make_reading_plan(start);
    return Planning(world, sim::viewing_place(reading)).planner.make_reading_plan(start);
  }

  static constexpr int kThreads = 2;
  static constexpr std::uint64_t kShortestNodes =
      1'000'000;  // five times what 40 cubes of 14 turns needed at most
  static constexpr std::uint64_t kTwoPhaseNodes = 3'000'000;
  rubik::TableProgress progress{stderr};
  sim::WorldParameters world;
  Planning planning;
  rubik::CubeSolver solver;
};

rubik::Brain make_brain(const Setup& s, Head& head) {
  rubik::Brain brain;
  brain.camera = s.camera;
  if (!s.camera) brain.known = s.world.cube->state;
  const auto hand = static_cast<rubik::Hand>(s.world.cube->held_by);
  brain.start.grasp = rubik::grasp_from(hand, s.world.cube->T_EC.R);
  brain.start.joints = {axes(s.world.arms[0].start), axes(s.world.arms[1].start)};
  brain.solve = [&head](const rubik::Cube& cube) { return head.solve(cube); };
  brain.plan = [&head](const rubik::PlanStart& start, const rubik::Moves& moves, const rubik::Jams& jams) {
    rubik::PlanOptions options;
    options.jams = jams;
    return head.planning.planner.make_plan(start, moves, options);
  };
  brain.plan_reading = [&head](const rubik::PlanStart& start, int reading) {
    return head.plan_reading(start, reading);
  };
  return brain;
}

/// Files, figures and pictures of a run that has ended.
void finish(const fs::path& folder, const rubik::RubikRun& rubik, mp::Summary& summary) {
  summary.figures.merge(rubik::write_results(folder, rubik.record(), rubik.truth()));
  mp::write_summary(folder, summary);
  std::vector<sim::Picture> pictures;
  for (const auto& [name, script] : rubik::plots(rubik.record())) pictures.push_back({name, script});
  sim::draw(folder, pictures);
}

/// Runs the coordinator on the log of a run.
int check(const Options& o, const Setup& s, Head& head) {
  return mp::check_coordinator("rubik", o.task, kKeys, [&](mp::TaskRun& run) {
    rubik::Brain brain = make_brain(s, head);
    brain.aside = false;
    rubik::RubikRun rubik(run, s.k, std::move(brain), false, [](const std::string&) {});
    if (run.process().assemble()) rubik.execute();
  });
}

int run(Options& o) {
  Setup s = prepare(o);
  Head head(s);
  if (!o.task.check.empty()) return check(o, s, head);
  const fs::path folder = mp::name_run_folder(o.task.run_dir, "rubik");
  sim::complete_config(s.config, o.task, folder, "", s.camera.has_value());
  mp::make_run_folder(folder);
  mp::write_text(folder / "config.toml", s.config.dump());
  mp::TaskRun run("rubik", o.task, folder, kKeys, parts_of(s));
  const bool gives_start = !o.task.attended && o.task.script.empty();
  const auto tell = [&o](const std::string& line) { mp::tell(line, o.task.session); };
  tell(fmt::format("rubik, session {}, seed {}{}", run.session(), o.task.seed, mp::who_orders(o.task)));
  rubik::RubikRun rubik(run, s.k, make_brain(s, head), gives_start, tell);
  run.start();
  std::optional<Fault> fault;
  if (run.process().assemble() && rubik.execute() == Outcome::faulted) fault = rubik.fault();
  mp::Summary summary = run.end(fault);
  rubik.truth().collect();
  try {
    run.finish([&] { finish(folder, rubik, summary); });
  } catch (const FaultError& e) {  // what has been done is told all the same
    if (!summary.fault) summary.fault = e.fault();
  }
  return mp::print_ending(
      summary,
      {.folder = folder, .figures = mp::figure_table(summary.figures, rubik::kFigures, {}, !summary.fault)},
      o.task);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CommandLine line(
      "Two simulated IRb-6 arms solve a Rubik's cube: one holds it, the other one turns its faces.", "rubik");
  const Option scramble =
      line.option("--scramble", o.scramble,
                  "Turns that scramble the cube, such as \"R U' F2\"; \"\": none (default: 20 by the seed)");
  line.option("--state", o.state, "The cube as 54 facelets, U R F D L B").excludes(scramble);
  const Option eyes =
      line.option("--eyes", o.eyes, "How the state becomes known: camera, or none: it is told")
          .one_of({"camera", "none"})
          .show_default();
  mp::add_task_options(line, o.task);
  eyes.excludes(line.named("--config"));  // it says which cameras there are
  return mp::run_command_line(line, argc, argv, [&] { return run(o); });
}
