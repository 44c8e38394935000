#include "ui_cli/new/new_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/closest_match.hpp"
#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "ui_cli/new/tree.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAbout =
    "Writes the files of a new robot, platform, task or sensor into a clone of the framework: they build, "
    "run and "
    "pass\n"
    "their tests as they are, and say where to put what is yours.";
constexpr const char* kWritten =
    "\nWhat is written:\n"
    "  robot NAME   robots/NAME (kinematics, transmission, motors, URDF, driver), a task of that name that "
    "moves it\n"
    "  platform NAME  robots/NAME (tracker, estimator, numbers, URDF, driver) of a mobile platform\n"
    "  task NAME    tasks/NAME (behaviours, program, ECP, mains, configuration), with --coordinated the same "
    "of a\n"
    "               coordinator\n"
    "  sensor NAME  vsp/NAME (kernel, parameters, process)\n"
    "and below test/ the tests of each, but of a coordinator's task none. NAME: lower-case letters, digits, "
    "underscores.\n"
    "\nExamples:\n";
const ExplainedLines kLines{{"ui_cli new task circle", ""},
                            {"ui_cli new task pair --coordinated", ""},
                            {"ui_cli new robot gantry --dry-run", ""},
                            {"ui_cli new platform cart", ""},
                            {"ui_cli new sensor feeler", "and then"},
                            {"ui_cli new task feel --sensor feeler", ""}};
constexpr const char* kExitStatus =
    "\nExit status: 0 done, 2 bad usage (the name is not one or is taken; no clone is there), 3 cannot "
    "write. Then\n"
    "nothing has been written. docs/howto-robot.md, howto-task.md and howto-sensor.md go on from here.";

struct Options {
  std::string part, name;
  fs::path into, outside;
  std::string robot, sensor;
  bool hardware{}, coordinated{}, dry_run{}, json{};
};

NewPart part_named(const std::string& word) {
  WordSet known;
  for (const NewPart part : {NewPart::robot, NewPart::platform, NewPart::task, NewPart::sensor}) {
    if (word == to_string(part)) return part;
    known.emplace(to_string(part));
  }
  throw FaultError(FaultCode::bad_usage,
                   fmt::format("there is no new '{}'{}", word, did_you_mean(word, known)),
                   "give robot, platform, task or sensor, and a name");
}

/// @return whether the folder of some robot has its description
bool has_robot(const fs::path& tree, const std::string& name) {
  return std::ranges::any_of(fs::directory_iterator(tree / "robots"), [&](const fs::directory_entry& folder) {
    return fs::is_regular_file(folder.path() / (name + ".urdf"));
  });
}

[[noreturn]] void refuse_missing(NewPart part, const std::string& name) {
  throw FaultError(FaultCode::bad_usage, fmt::format("there is no {} '{}'", to_string(part), name),
                   fmt::format("write it first: `ui_cli new {} {}`", to_string(part), name));
}

Scaffold scaffold_of(const Options& o) {
  Scaffold scaffold{.part = part_named(o.part),
                    .name = o.name,
                    .sensor = o.sensor,
                    .hardware = o.hardware,
                    .coordinated = o.coordinated,
                    .outside = !o.outside.empty()};
  check_new_name(scaffold.name);
  if (!o.robot.empty()) scaffold.robot = o.robot;
  if (scaffold.part != NewPart::task &&
      (!o.robot.empty() || !o.sensor.empty() || scaffold.coordinated || scaffold.outside))
    throw FaultError(FaultCode::bad_usage, "--robot, --sensor, --coordinated and --outside belong to a task");
  if (scaffold.coordinated && (!o.robot.empty() || !o.sensor.empty()))
    throw FaultError(FaultCode::bad_usage, "--coordinated goes with neither --robot nor --sensor",
                     "its arms and sensors are lines of main.cpp");
  if (scaffold.hardware && scaffold.part != NewPart::robot)
    throw FaultError(FaultCode::bad_usage, "--hardware belongs to a robot");
  if (scaffold.outside && (!o.into.empty() || !o.robot.empty() || !o.sensor.empty()))
    throw FaultError(FaultCode::bad_usage, "--outside goes with none of --into, --robot, --sensor");
  return scaffold;
}

fs::path place_of(const Options& o, const Scaffold& scaffold) {
  if (scaffold.outside) return o.outside;
  fs::path tree = find_tree(o.into);
  check_free(tree, scaffold.name);
  if (!o.robot.empty() && !has_robot(tree, o.robot)) refuse_missing(NewPart::robot, o.robot);
  if (!o.sensor.empty() && !fs::is_regular_file(tree / fmt::format("vsp/{0}/{0}.toml", o.sensor)))
    refuse_missing(NewPart::sensor, o.sensor);
  return tree;
}

std::string json_of(const Scaffold& scaffold, const fs::path& place, const ScaffoldPlan& plan, bool written) {
  nlohmann::ordered_json j{{"part", to_string(scaffold.part)},
                           {"name", scaffold.name},
                           {"folder", place.string()},
                           {"written", written},
                           {"files", nlohmann::ordered_json::array()},
                           {"changed", nlohmann::ordered_json::array()},
                           {"next", plan.next}};
  for (const NewFile& file : plan.files) j["files"].push_back(file.path.string());
  for (const NewEntry& entry : plan.entries) j["changed"].push_back(entry.list.string());
  return j.dump(2) + "\n";
}

std::string text_of(const fs::path& place, const ScaffoldPlan& plan, bool written) {
  std::string text = fmt::format("{} {}:\n", written ? "written to" : "would be written to", place.string());
  for (const NewFile& file : plan.files) text += fmt::format("  {}\n", file.path.string());
  for (const NewEntry& entry : plan.entries)
    text += fmt::format("  {}: one line more\n", entry.list.string());
  if (!written) return text;
  text += fmt::format("\nNow, in {}:\n", place.string());
  for (const std::string& step : plan.next) text += fmt::format("  {}\n", step);
  return text;
}

void execute(const Options& o, std::ostream& out) {
  const Scaffold scaffold = scaffold_of(o);
  const fs::path place = place_of(o, scaffold);
  const ScaffoldPlan plan = plan_scaffold(scaffold);
  check_plan(place, plan);
  if (!o.dry_run) write_plan(place, plan);
  out << (o.json ? json_of(scaffold, place, plan, !o.dry_run) : text_of(place, plan, !o.dry_run));
}

}  // namespace

std::vector<std::string> new_words() {
  return {"robot",   "platform", "task",       "sensor",        "--into",    "--outside",
          "--robot", "--sensor", "--hardware", "--coordinated", "--dry-run", "--json"};
}

int run_new(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Options o;
  CommandLine line(kAbout, "ui_cli new");
  line.option("part", o.part, "robot, platform, task or sensor").required();
  line.option("name", o.name, "its name").required();
  line.option("--into", o.into, "root of the clone; usual: the one in which you are").type_name("DIR");
  line.option("--robot", o.robot, "of a task: its arm; usual: irb6_postument").type_name("NAME");
  line.option("--sensor", o.sensor, "of a task: its virtual sensor, as made by `ui_cli new sensor`")
      .type_name("NAME");
  line.flag("--hardware", o.hardware,
            "of a robot: a seam to its drives, with a loop-back and a test by the wall clock");
  line.flag("--coordinated", o.coordinated,
            "of a task: two arms, and a coordinator with behaviours of its own; 6 files");
  line.option("--outside", o.outside,
              "of a task: a project of its own in DIR, against the installed framework")
      .type_name("DIR");
  line.flag("--dry-run", o.dry_run, "only list what would be written");
  line.flag("--json", o.json, "print JSON");
  line.footer(kWritten + explained(kLines) + kExitStatus);
  if (const auto status = line.parse_words(
          arguments, out, err,
          {"ui_cli new task spiral", "ui_cli new task spiral --sensor whisker",
           "ui_cli new task spiral --robot gantry", "ui_cli new task spiral --outside ../spiral",
           "ui_cli new robot gantry --into ../mrroc", "ui_cli new robot gantry --hardware"}))
    return *status;
  execute(o, out);
  return 0;
}

}  // namespace mrroc::ui
