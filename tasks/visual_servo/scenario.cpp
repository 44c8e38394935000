#include "tasks/visual_servo/scenario.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/command_line.hpp"

namespace mrroc::visual_servo {

const std::vector<Scenario>& scenarios() {
  static const std::vector<Scenario> all{
      {"rest", "the object lies still (VS fig. 28)", {}},
      {"hand", "somebody moves it about", {"object.motion=hand", "object.start=4", "task.duration=16"}},
      {"line",
       "it moves along a straight line at 0.1 m/s",
       {"object.motion=line", "object.start=6", "object.speed=0.1", "object.length=0.35",
        "object.heading=1.5707963", "object.pose=[0.92, -0.17, 0.93, 0, 0, 0]", "task.duration=12"}},
      {"circle",
       "it moves around a circle at 0.06 m/s",
       {"object.motion=circle", "object.start=6", "object.speed=0.06", "object.radius=0.1",
        "object.heading=1.5707963", "task.duration=14"}},
      {"occluded",
       "something is held over it for a second while the arm comes",
       {"object.hidden_from=4", "object.hidden_for=1"}},
      {"absent", "it is not there at first", {"object.absent_until=5", "task.duration=11"}},
      {"wrong_board",
       "another board lies there: the arm never moves, and the task is given up",
       {"task.timeout=3"}},
  };
  return all;
}

void add_scenario_options(CommandLine& line, ScenarioOptions& o) {
  std::vector<std::string> names;
  std::string about = "What the object does:";
  for (const auto& s : scenarios()) {
    names.emplace_back(s.name);
    about += fmt::format("\n{}: {}", s.name, s.about);
  }
  line.option("--scenario", o.scenario, about).one_of(names).show_default();
  line.option("--object", o.object, "What is looked for").one_of({"chessboard", "apriltag"}).show_default();
  line.option("--aggregation", o.aggregation, "How the errors of two cameras become one (default: mean)")
      .one_of({"mean", "switching", "weights"});
  line.option("--cameras", o.cameras,
              "Which cameras there are (default: both). Alone, sac stops when the arm hides the object "
              "from it, and eih must "
              "have the object in view from the beginning (object.pose)")
      .one_of({"both", "sac", "eih"});
}

std::vector<std::string> settings_of(const ScenarioOptions& o) {
  const auto found = std::ranges::find(scenarios(), o.scenario, &Scenario::name);
  if (found == scenarios().end())
    throw FaultError(FaultCode::bad_usage, "there is no scenario '" + o.scenario + "'");
  std::vector<std::string> settings{"task.object=" + o.object, "object.kind=" + o.object};
  settings.insert(settings.end(), found->settings.begin(), found->settings.end());
  if (o.scenario == "wrong_board")
    settings.emplace_back(o.object == "apriltag" ? "object.tag=7" : "object.kind=wrong_board");
  if (!o.aggregation.empty()) settings.push_back("task.aggregation=" + o.aggregation);
  if (o.cameras == "sac" || o.cameras == "eih") settings.push_back("cameras.order=[\"" + o.cameras + "\"]");
  return settings;
}

}  // namespace mrroc::visual_servo
