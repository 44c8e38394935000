#include "ui_cli/manual_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <utility>

#include "base/command_hint.hpp"
#include "base/command_words.hpp"
#include "base/fault.hpp"
#include "base/instructions.hpp"
#include "base/joined.hpp"
#include "ui_cli/homing_progress.hpp"
#include "ui_cli/layout.hpp"
#include "ui_cli/manual_link.hpp"
#include "ui_cli/manual_page.hpp"
#include "ui_cli/manual_show.hpp"
#include "ui_cli/taught_points.hpp"

namespace mrroc::ui {

namespace {

constexpr const char* kHelp =
    "Usage: ui_cli manual INSTRUCTION\n"
    "\nInstructions to the task `manual` (start it with `./run manual`); ARM is arm1, arm2 or all:\n"
    "  home ARM                                find the positions, set the tool, bias the force\n"
    "  move ARM SPACE NUMBER... [speed S] [acceleration S]   to coordinates\n"
    "  jog ARM SPACE NUMBER... [speed S] [acceleration S]    by coordinates; `motors` works before homing\n"
    "  preset ARM NAME                         to a position of the configuration: synchro, front, 0, 1, 2\n"
    "  tool ARM X Y Z AX AY AZ                 weight ARM NEWTONS [X Y Z]\n"
    "  model ARM NUMBER                        servo ARM ALGORITHM [SET]\n"
    "  gripper ARM METRES                      bias ARM\n"
    "  reset ARM                               stop ARM\n"
    "  show ARM                                positions, pose, force, state, fault, tool, weight, models;\n"
    "                                          with --json and `all` a list\n"
    "  save ARM FILE                           adds the position to a file: a line `move ARM joints ...`\n"
    "  teach ARM FILE [SPACE]                  adds the position to motions for `./run move --file FILE`\n"
    "  load FILE                               the instructions of a file, one after the other\n"
    "  end                                     the session\n"
    "SPACE: motors [rad], joints [rad, m], euler, angle-axis [m, rad]. S: share of the largest, 0 to 1.\n"
    "Options: --no-wait returns when the instruction is taken; --json, --session NAME, --url URL,\n"
    "--key-file FILE.\n"
    "Exit status: 0 done; 1 refused or failed; 2 bad usage or no such session; 3 nobody answers.\n";

using Json = nlohmann::ordered_json;

constexpr const char* kTaken =
    "taken, and not done yet; Ctrl-C ends the wait and not the motion, --no-wait does not wait for it";

std::vector<std::string> names_of(const std::vector<ManualArm>& arms) {
  std::vector<std::string> names;
  for (const ManualArm& a : arms) names.push_back(a.name);
  return names;
}

/// The task `manual` as one command speaks to it, with one link however many instructions there are: what a link has
/// subscribed to stays with the bus.
struct Task {
  Task(link::Bus& b, const link::SessionInfo& s, const ManualRequest& request, const Timeouts& p)
      : bus(b),
        session(s),
        timeouts(p),
        arms(manual_arms(s.run_folder)),
        link(b, s, arms.empty() ? std::vector{request.show} : names_of(arms), p) {}

  link::Bus& bus;
  const link::SessionInfo& session;
  const Timeouts& timeouts;
  std::vector<ManualArm> arms;  ///< none: which there are is not known on this host
  ManualLink link;
};

/// A task that does not listen would be waited for until the timeout is over.
/// @param looks  nothing is to be moved: the arms of any task can be looked at
/// @throws FaultError illegal_in_state
void check_task(const Task& task, bool looks) {
  const link::SessionInfo& session = task.session;
  if (session.task.empty() || session.task == kManualTask) return;
  const bool armless =
      task.arms.empty() && std::filesystem::is_regular_file(session.run_folder / "config.toml");
  if (looks && !armless) return;
  throw FaultError(FaultCode::illegal_in_state,
                   armless
                       ? fmt::format("the task {} has no arms to move by hand or to look at", session.task)
                       : fmt::format("the task {} moves its arms itself, not by hand", session.task),
                   "instructions are for the task `manual`, `./run manual`; `ui_cli status` shows this one");
}

/// @param progress  is told when the instruction takes long, and then how far homing is; null: nothing is told
/// @return the last answer: refused, taken when that is enough, done or failed
ManualAnswer ask(Task& task, const std::string& words, bool wait, std::ostream* progress) {
  const std::vector<ManualArm> arms = arms_to_home(words, task.arms);
  HomingProgress homing(arms);
  const auto begun = Clock::now();
  auto next = begun + task.timeouts.told;  // line of progress
  bool taken = false, told = false;
  task.link.begin(words, begun);
  while (true) {
    const auto answer = task.link.poll(Clock::now());
    taken = taken || (answer && answer->state == InstructionState::taken);
    for (const ManualArm& a : arms)
      if (const auto reading = task.link.reading(a.name)) homing.see(a.name, *reading);
    if (progress && wait && taken && !answer && Clock::now() > next) {
      const std::string line = std::exchange(told, true) ? homing.text() : kTaken;
      if (!line.empty()) {
        *progress << line << std::endl;
        next += task.timeouts.progress;
      }
    }
    if (answer && (answer->state != InstructionState::taken || !wait)) return *answer;
    if (!answer) task.bus.wait(std::min(task.timeouts.repeat, std::chrono::milliseconds(20)));
  }
}

/// @return the newest reading of an arm @throws FaultError bad_usage: there is none of this name; peer_silent
EffectorReply look_at(Task& task, const std::string& arm) {
  const auto& arms = task.arms;
  if (!arms.empty() && std::ranges::find(arms, arm, &ManualArm::name) == arms.end())
    throw FaultError(
        FaultCode::bad_usage,
        fmt::format("there is no arm '{}'; there are {} and all", arm, joined(arms, ", ", &ManualArm::name)),
        "name one of them");
  const auto begun = Clock::now();
  while (!task.link.reading(arm)) {
    if (Clock::now() - begun > task.timeouts.give_up)
      throw FaultError(FaultCode::peer_silent,
                       fmt::format("session {} says nothing: no reply of {}", task.session.name, arm),
                       "instructions are for the task `manual`: look with `ui_cli list`");
    task.bus.wait(task.timeouts.repeat);
  }
  return *task.link.reading(arm);
}

void show_all(Task& task, bool json, std::ostream& out) {
  if (task.arms.empty())
    throw FaultError(FaultCode::bad_usage, "which arms there are is not known on this host",
                     "name one: show arm1");
  std::string between = json ? "[" : "";
  for (const ManualArm& arm : task.arms) {
    out << std::exchange(between, json ? "," : "\n");
    show_arm(look_at(task, arm.name), arm.name, json, out);
  }
  if (json) out << "]\n";
}

/// An arm that knows where it is.
struct KnownArm {
  int axes{};
  EffectorReply reply;
};

/// @param verb  what is to be done with it, for errors
KnownArm where_it_is(Task& task, const ManualRequest& request, const char* verb) {
  const EffectorReply r = look_at(task, request.show);
  const auto arm = std::ranges::find(task.arms, request.show, &ManualArm::name);
  if (arm == task.arms.end())
    throw FaultError(
        FaultCode::bad_usage,
        fmt::format("{} is no arm of the run in {}", request.show, task.session.run_folder.string()),
        fmt::format("{} on the host of the task, where its run folder is", verb));
  if (!r.position_known)
    throw FaultError(
        FaultCode::illegal_in_state,
        fmt::format("{} does not know its position, it is {}", request.show, to_string(r.state)),
        fmt::format("`ui_cli manual home {}` finds it; {} when that is done", request.show, verb));
  return {arm->axes, r};
}

/// Adds where the arm is to the motions of a file.
void teach(Task& task, const ManualRequest& request, std::ostream& out) {
  const KnownArm arm = where_it_is(task, request, "teach");
  const std::size_t points = teach_point(request.teach, request.show, arm.axes, request.space, arm.reply);
  out << (request.json ? Json{{"file", request.teach.string()}, {"positions", points}}.dump()
                       : fmt::format("position {} of {} in {}", points, request.show, request.teach.string()))
      << "\n";
}

/// Adds where the arm is to the file.
void save(Task& task, const ManualRequest& request, std::ostream& out) {
  const auto [axes, r] = where_it_is(task, request, "save");
  const std::vector<double> joints(r.joints.begin(), r.joints.begin() + axes);
  const std::string line = fmt::format("move {} joints {:.6f}", request.show, fmt::join(joints, " "));
  std::ofstream file(request.save, std::ios::app);
  file << line << "\n";
  if (!file.flush())
    throw FaultError(FaultCode::cannot_write, "cannot write " + request.save.string(),
                     "look at the rights, the space left, and whether the folder is there");
  out << (request.json ? Json{{"file", request.save.string()}, {"line", line}}.dump() : line) << "\n";
}

/// A line of a file of instructions.
struct FileLine {
  std::string place;  ///< FILE:LINE
  std::string words;
};

/// @return its lines without comments, at least one @throws FaultError bad_script
std::vector<FileLine> instructions_in(const std::filesystem::path& name) {
  constexpr const char* kForm =
      "a file for `load` has an instruction per line, such as `preset arm1 front`; "
      "`ui_cli manual save ARM FILE` writes where an arm is";
  std::ifstream file(name);
  if (!file || std::filesystem::is_directory(name))
    throw FaultError(FaultCode::bad_script,
                     fmt::format("cannot read {}{}", name.string(),
                                 std::filesystem::is_directory(name) ? ", which is a folder"
                                 : std::filesystem::exists(name)     ? ""
                                                                     : ", which does not exist here"),
                     fmt::format("name a file that this terminal can read; {}", kForm));
  std::vector<FileLine> lines;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line = line.substr(0, line.find('#'));
    line.erase(line.find_last_not_of(" \t\r") + 1);
    const std::string place = fmt::format("{}:{}", name.string(), number);
    if (line.size() > kLongestInstruction)
      throw FaultError(FaultCode::bad_script, fmt::format("{}: {}", place, too_long(line.size())));
    if (!line.empty()) lines.push_back({place, line});
  }
  if (lines.empty())
    throw FaultError(FaultCode::bad_script, fmt::format("{} holds no instruction", name.string()), kForm);
  return lines;
}

/// @return the error that an answer names, as "arm1: non-fatal joint_limit: ..." does; of one that names none
///         illegal_in_state
FaultCode code_in(const std::string& text) {
  std::istringstream in(text);
  for (std::string word; in >> word;)
    if (word.ends_with(':'))
      if (const auto code = fault_code(std::string_view(word).substr(0, word.size() - 1))) return *code;
  return FaultCode::illegal_in_state;
}

/// @throws FaultError bad_usage: not understood; what the driver says, or illegal_in_state: refused or failed
void must_be_good(const ManualAnswer& answer, const std::string& words) {
  if (answer.state == InstructionState::taken || answer.state == InstructionState::done) return;
  if (answer.state == InstructionState::not_understood)
    throw FaultError(FaultCode::bad_usage, fmt::format("{}: {}", words, answer.text),
                     fmt::format("{} are words of this terminal; `ui_cli manual --help` tells them all",
                                 listed({kOfShell.begin(), kOfShell.end()})));
  throw FaultError(code_in(answer.text),
                   fmt::format("{} {}: {}", words,
                               answer.state == InstructionState::refused ? "refused" : "failed", answer.text),
                   "look at the arm with `ui_cli manual show ARM`");
}

/// Gives the instructions of a file, each when the one before is done.
void load(Task& task, const ManualRequest& request, std::ostream& out) {
  const auto lines = instructions_in(request.load);
  for (const auto& [place, words] : lines) {
    const ManualAnswer answer = ask(task, words, true, request.json ? nullptr : &out);
    if (answer.state == InstructionState::not_understood)
      throw FaultError(FaultCode::bad_script, fmt::format("{}: {}: {}", place, words, answer.text),
                       "correct the line; those before it have been done");
    must_be_good(answer, fmt::format("{}: {}", place, words));
    if (!request.json) out << words << ": " << answer.text << std::endl;
  }
  if (request.json) out << Json{{"file", request.load.string()}, {"done", lines.size()}}.dump() << "\n";
}

}  // namespace

std::string manual_help() { return command_hint(kHelp); }

ManualRequest read_manual_words(const std::vector<std::string>& arguments) {
  ManualRequest request;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& a = arguments[k];
    const auto value = [&] {
      if (k + 1 == arguments.size()) throw FaultError(FaultCode::bad_usage, a + " needs a value");
      return arguments[++k];
    };
    if (a == "--json")
      request.json = true;
    else if (a == "--no-wait")
      request.wait = false;
    else if (a == "--session")
      request.session = value();
    else if (a == "--url")
      request.url = value();
    else if (a == "--key-file")
      request.key_file = value();
    else if (a.starts_with("--"))
      throw FaultError(FaultCode::bad_usage, fmt::format("manual does not know '{}'", a));
    else
      words.push_back(a);
  }
  if (words.empty())
    throw FaultError(FaultCode::bad_usage, "an instruction is missing", "look at `ui_cli manual --help`");
  request.words = joined(words, " ");
  const auto form = [&](std::size_t count, const char* written) {
    if (words.size() != count)
      throw FaultError(FaultCode::bad_usage, fmt::format("it is written `{}`", written));
  };
  if (words[0] == "show") {
    form(2, "show ARM");
    request.show = words[1];
  } else if (words[0] == "save") {
    form(3, "save ARM FILE");
    request.show = words[1];
    request.save = words[2];
  } else if (words[0] == "teach") {
    if (words.size() != 4) form(3, "teach ARM FILE [motors|joints|frame|euler|angle-axis]");
    request.show = words[1];
    request.teach = words[2];
    if (words.size() == 4) request.space = space_of_word(words[3]);
  } else if (words[0] == "load") {
    form(2, "load FILE");
    request.load = words[1];
  }
  if (request.words.size() > kLongestInstruction && request.load.empty() && request.save.empty() &&
      request.teach.empty())
    throw FaultError(FaultCode::bad_usage, too_long(request.words.size()), kShorter);
  return request;
}

std::vector<std::string> manual_words() {
  const auto verbs = instruction_verbs("manual");
  std::vector<std::string> words(verbs.begin(), verbs.end());
  words.insert(words.end(), kOfShell.begin(), kOfShell.end());
  for (const char* other : {"all", "arm1", "arm2", "motors", "joints", "euler", "angle-axis", "speed",
                            "acceleration", "--no-wait", "--json", "--session", "--url", "--key-file"})
    words.emplace_back(other);
  return words;
}

void execute_manual(link::Bus& bus, const link::SessionInfo& session, const ManualRequest& request,
                    const Timeouts& timeouts, std::ostream& out) {
  Task task(bus, session, request, timeouts);
  check_task(task, !request.show.empty());
  if (!request.save.empty()) return save(task, request, out);
  if (!request.teach.empty()) return teach(task, request, out);
  if (request.show == "all") return show_all(task, request.json, out);
  if (!request.show.empty()) return show_arm(look_at(task, request.show), request.show, request.json, out);
  if (!request.load.empty()) return load(task, request, out);
  const ManualAnswer answer = ask(task, request.words, request.wait, request.json ? nullptr : &out);
  if (request.json)
    out << Json{{"words", request.words},
                {"accepted", answer.state != InstructionState::refused &&
                                 answer.state != InstructionState::not_understood},
                {"done", answer.state == InstructionState::done},
                {"text", answer.text}}
               .dump(-1, ' ', false, Json::error_handler_t::replace)
        << "\n";
  must_be_good(answer, request.words);
  if (!request.json) out << answer.text << "\n";
}

}  // namespace mrroc::ui
