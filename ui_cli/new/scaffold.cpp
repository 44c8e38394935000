#include "ui_cli/new/scaffold.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "base/fault.hpp"
#include "ui_cli/new/template_files.hpp"

namespace mrroc::ui {
namespace {

constexpr std::size_t kShortestName = 3;
constexpr std::size_t kLongestName = 40;

// Words of C++, namespaces of the framework, commands of ./run and targets of the build; check_free() finds more.
constexpr const char* kTaken = R"(
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t class co_await co_return co_yield
compl concept const const_cast consteval constexpr constinit continue decltype default delete do double dynamic_cast
else enum explicit export extern false float for friend goto if inline int long mutable namespace new noexcept not
not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires return short signed
sizeof static static_assert static_cast struct switch template this thread_local throw true try typedef typeid
typename union unsigned using virtual void volatile wchar_t while xor xor_eq
std main mrroc base edp ecp vsp ui_cli robots tasks sim launch test tests bench docs link view contract camera gripper irb6
irb6_postument irb6_track simulator programs all clean build help package install sensor robot platform platforms task shell)";

bool is_taken(const std::string& name) {
  std::istringstream words(kTaken);
  return std::find(std::istream_iterator<std::string>(words), {}, name) !=
         std::istream_iterator<std::string>();
}

using Words = std::vector<std::pair<std::string, std::string>>;

/// @return the text with every word replaced, what has replaced one is not looked at again
std::string replaced(std::string_view text, const Words& words) {
  std::string result;
  while (!text.empty()) {
    const auto word = std::ranges::find_if(words, [&](const auto& w) { return text.starts_with(w.first); });
    if (word == words.end()) {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += word->second;
      text.remove_prefix(word->first.size());
    }
  }
  return result;
}

/// Lines that begin with "//@WORD " or "#@WORD " are for a part with what the word names, "@no_WORD" for one without.
std::string chosen_lines(std::string_view text, std::string_view word, bool chosen) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    bool keep = true;
    for (const std::string_view leader : {"//", "#"})
      for (const bool with : {true, false}) {
        const std::string mark = fmt::format("{}@{}{} ", leader, with ? "" : "no_", word);
        if (!line.starts_with(mark)) continue;
        line.remove_prefix(mark.size());
        keep = with == chosen;
      }
    if (keep) result += line;
  }
  return result;
}

void add_files(ScaffoldPlan& plan, std::string_view folder, const Words& words, bool sensor) {
  for (const TemplateFile& file : template_files()) {
    if (!file.path.starts_with(folder)) continue;
    const std::string path = replaced(file.path.substr(folder.size()), words);
    plan.files.push_back({path, replaced(chosen_lines(file.text, "sensor", sensor), words)});
  }
}

void add_task(ScaffoldPlan& plan, const Scaffold& scaffold) {
  const Words words{{"my_task", scaffold.name},
                    {"MyTask", type_name(scaffold.name)},
                    {"my_sensor", scaffold.sensor},
                    {"irb6_postument", scaffold.robot},
                    {" PARTS my_parts", scaffold.sensor.empty() ? "" : " PARTS vsp_" + scaffold.sensor}};
  if (scaffold.coordinated)
    add_files(plan, "coordinated/", {{"my_task", scaffold.name}}, false);
  else
    add_files(plan, "task/", words, !scaffold.sensor.empty());
  if (scaffold.outside) {
    std::erase_if(plan.files, [](const NewFile& f) { return *f.path.begin() == "test"; });
    add_files(plan, "outside/", words, false);
  }
}

/// @return a run of a robot's task on hardware of its own, which finds out by homing where it stands
std::string hardware_line(const std::string& name) {
  return fmt::format("./run {0} --clock wall --set robots.arm1.hardware={0} --set robots.arm1.synchro=homing",
                     name);
}

std::vector<std::string> next_steps(const Scaffold& scaffold) {
  const auto step = [](const std::string& command, const char* what) {
    return fmt::format("{:<44}  # {}", command, what);
  };
  const std::string& name = scaffold.name;
  const std::string test = "./run test -R " + type_name(name);
  if (scaffold.outside)
    return {step("cmake -B build -G Ninja", "-DCMAKE_PREFIX_PATH=DIR if mrroc is not below /usr"),
            step("cmake --build build", "builds it"), step("build/bin/" + name, "runs it")};
  if (scaffold.part == NewPart::sensor)
    return {step(test, "builds it and runs its tests"),
            step("./run ui_cli new task NAME --sensor " + name, "writes a task that uses it")};
  if (scaffold.part == NewPart::platform)
    return {step(test, "builds it and runs its tests"),
            step("./run rex_drive --set platforms.rex.model=" + name, "drives it")};
  std::vector<std::string> steps{
      step("./run " + name, "builds it and runs it"),
      step("./run " + name + " --view --speed 1", "shows it in a browser, at a real arm's pace")};
  if (!scaffold.coordinated) steps.push_back(step(test, "builds the tests and runs its own"));
  if (scaffold.part == NewPart::robot)
    steps.push_back(step("./run press --set robots.arm1.model=" + name, "another task on this robot"));
  if (scaffold.hardware) steps.push_back(step(hardware_line(name), "with its own hardware.cpp"));
  return steps;
}

}  // namespace

std::string_view to_string(NewPart part) {
  switch (part) {
    case NewPart::robot:
      return "robot";
    case NewPart::platform:
      return "platform";
    case NewPart::task:
      return "task";
    case NewPart::sensor:
      break;
  }
  return "sensor";
}

std::string type_name(std::string_view name) {
  std::string type;
  bool first = true;
  for (const char letter : name) {
    const bool small = letter >= 'a' && letter <= 'z';
    if (letter != '_') type += first && small ? static_cast<char>(letter - 'a' + 'A') : letter;
    first = letter == '_';
  }
  return type;
}

void check_new_name(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw FaultError(
        FaultCode::bad_usage, fmt::format("the name '{}' {}", name, why),
        "take another one of lower-case letters, digits and single underscores, for example probe_arm");
  };
  if (name.size() < kShortestName) refuse(fmt::format("has less than {} letters", kShortestName));
  if (name.size() > kLongestName) refuse(fmt::format("has more than {} letters", kLongestName));
  const auto letter = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool legal = std::ranges::all_of(name, [&](char c) { return letter(c) || digit(c) || c == '_'; });
  if (!legal || !letter(name.front()) || name.ends_with('_') || name.find("__") != std::string::npos)
    refuse("is no name for folders, programs and namespaces");
  if (is_taken(name)) refuse("has a meaning already");
}

ScaffoldPlan plan_scaffold(const Scaffold& scaffold) {
  ScaffoldPlan plan;
  if (scaffold.part == NewPart::task) {
    add_task(plan, scaffold);
  } else if (scaffold.part == NewPart::sensor) {
    add_files(plan, "sensor/", {{"my_sensor", scaffold.name}, {"MySensor", type_name(scaffold.name)}}, false);
    plan.entries.push_back({"vsp/CMakeLists.txt", scaffold.name});
    plan.entries.push_back({"test/vsp/CMakeLists.txt", scaffold.name});
  } else if (scaffold.part == NewPart::platform) {
    add_files(plan, "platform/", {{"my_platform", scaffold.name}, {"MyPlatform", type_name(scaffold.name)}},
              false);
    plan.entries.push_back({"robots/CMakeLists.txt", scaffold.name});
    plan.entries.push_back({"test/robots/CMakeLists.txt", scaffold.name});
  } else {
    const Words words{{"my_robot", scaffold.name}, {"MyRobot", type_name(scaffold.name)}};
    add_files(plan, "robot/", words, false);
    for (NewFile& file : plan.files) file.text = chosen_lines(file.text, "hardware", scaffold.hardware);
    if (scaffold.hardware) add_files(plan, "hardware/", words, false);
    plan.entries.push_back({"robots/CMakeLists.txt", scaffold.name});
    plan.entries.push_back({"test/robots/CMakeLists.txt", scaffold.name});
    Scaffold task = scaffold;
    task.robot = scaffold.name;
    add_task(plan, task);
  }
  plan.next = next_steps(scaffold);
  return plan;
}

std::string with_entry(const std::string& list, const std::string& folder) {
  constexpr std::string_view kCommand = "add_subdirectory(";
  const std::string line = fmt::format("{}{})\n", kCommand, folder);
  std::size_t place = std::string::npos;  // behind the last such line
  for (std::size_t begin = 0; begin < list.size();) {
    const std::size_t end = std::min(list.find('\n', begin), list.size() - 1) + 1;
    if (std::string_view(list).substr(begin).starts_with(kCommand)) place = end;
    begin = end;
  }
  if (place == std::string::npos) place = list.size();
  const bool ended = place == 0 || list[place - 1] == '\n';
  return list.substr(0, place) + (ended ? "" : "\n") + line + list.substr(place);
}

}  // namespace mrroc::ui
