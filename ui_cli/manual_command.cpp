#include "ui_cli/manual_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "base/fault.hpp"
#include "base/representation.hpp"
#include "mrroc/manual_words_t.hpp"
#include "ui_cli/manual_link.hpp"

namespace mrroc::ui {

const char* const kManualHelp =
    "\nInstructions to the task `manual` (start it with `./run manual`); ARM is arm1, arm2 or all:\n"
    "  home ARM                                find the positions, set the tool, bias the force\n"
    "  move ARM SPACE NUMBER... [speed S] [acceleration S]   to coordinates\n"
    "  jog ARM SPACE NUMBER... [speed S] [acceleration S]    by coordinates; `motors` works before homing\n"
    "  preset ARM NAME                         to a position of the configuration: synchro, front, 0, 1, 2\n"
    "  tool ARM X Y Z AX AY AZ                 weight ARM NEWTONS [X Y Z]\n"
    "  model ARM NUMBER                        servo ARM ALGORITHM [SET]\n"
    "  gripper ARM METRES                      bias ARM\n"
    "  reset ARM                               stop ARM\n"
    "  show ARM                                positions, pose, force, state\n"
    "  end                                     the session\n"
    "SPACE: motors [rad], joints [rad, m], euler, angle-axis [m, rad]. S: share of the largest, 0 to 1.\n"
    "Options: --no-wait returns when the instruction is taken; --json, --session NAME, --url URL.\n"
    "Exit status: 0 done; 1 refused or failed; 2 bad usage or no such session; 3 nobody answers.\n";

namespace {

using Json = nlohmann::ordered_json;

/// @return the last answer: refused, taken when that is enough, done or failed
ManualAnswer ask(link::Bus& bus, const link::SessionInfo& session, const ManualWish& wish,
                 const Patience& patience) {
  ManualLink link(bus, session, {}, patience);
  link.begin(wish.words, Clock::now());
  while (true) {
    const auto answer = link.poll(Clock::now());
    if (answer && (answer->state != ManualState::taken || !wish.wait)) return *answer;
    if (!answer) bus.wait(std::min(patience.repeat, std::chrono::milliseconds(20)));
  }
}

/// @return the newest reading of an arm
EffectorReply look_at(link::Bus& bus, const link::SessionInfo& session, const std::string& arm,
                      const Patience& patience) {
  const ManualLink link(bus, session, {arm}, patience);
  const auto begun = Clock::now();
  while (!link.reading(arm)) {
    if (Clock::now() - begun > patience.give_up)
      throw FaultError(FaultCode::peer_silent,
                       fmt::format("session {} says nothing: no reply of {}", session.name, arm),
                       "instructions are for the task `manual`: look with `ui_cli list`");
    bus.wait(patience.repeat);
  }
  return *link.reading(arm);
}

void show(const EffectorReply& r, const std::string& arm, bool json, std::ostream& out) {
  PoseNumbers pose{};
  std::ranges::copy(r.T_0E, pose.begin());
  const auto T_0E = pose_from_numbers(Representation::xyz_angle_axis, pose);
  const PoseNumbers euler = T_0E ? numbers_from_pose(Representation::xyz_euler_zyz, *T_0E) : PoseNumbers{};
  const std::vector<double> F(r.F_a.v.data(), r.F_a.v.data() + 6), e(euler.begin(), euler.begin() + 6);
  if (json) {
    out << Json{{"arm", arm},
                {"state", to_string(r.state)},
                {"motors", r.motors},
                {"joints", r.joints},
                {"T_0E", r.T_0E},
                {"euler", e},
                {"F_a", F},
                {"gripper", r.gripper},
                {"blocked", r.blocked}}
               .dump()
        << "\n";
    return;
  }
  const auto row = [&](const char* name, const auto& numbers, const char* unit) {
    out << fmt::format("{:<11} {:9.4f}  {}\n", name, fmt::join(numbers, " "), unit);
  };
  out << fmt::format("{:<11} {}\n", arm, to_string(r.state));
  row("motors", r.motors, "rad");
  row("joints", r.joints, "rad, m");
  row("angle-axis", r.T_0E, "m, rad");
  row("euler", e, "m, rad");
  row("force F_a", F, "N, N m in E");
  out << fmt::format("{:<11} {:9.4f}  m{}\n", "gripper", r.gripper, r.blocked ? ", holds something" : "");
}

}  // namespace

ManualWish read_manual_words(const std::vector<std::string>& arguments) {
  ManualWish wish;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& a = arguments[k];
    const auto value = [&] {
      if (k + 1 == arguments.size()) throw FaultError(FaultCode::bad_usage, a + " needs a value");
      return arguments[++k];
    };
    if (a == "--json")
      wish.json = true;
    else if (a == "--no-wait")
      wish.wait = false;
    else if (a == "--session")
      wish.session = value();
    else if (a == "--url")
      wish.url = value();
    else if (a.starts_with("--"))
      throw FaultError(FaultCode::bad_usage, fmt::format("manual does not know '{}'", a));
    else
      words.push_back(a);
  }
  if (words.empty())
    throw FaultError(FaultCode::bad_usage, "an instruction is missing", "look at ui_cli manual --help");
  wish.words = fmt::format("{}", fmt::join(words, " "));
  if (words[0] == "show") {
    if (words.size() != 2) throw FaultError(FaultCode::bad_usage, "it is written `show ARM`");
    wish.show = words[1];
  }
  constexpr std::size_t kLongest = sizeof(manual_words_t{}.text) - 1;
  if (wish.words.size() > kLongest)
    throw FaultError(FaultCode::bad_usage, fmt::format("an instruction has at most {} characters", kLongest));
  return wish;
}

std::vector<std::string> manual_words() {
  return {"home",  "move",         "jog",       "preset", "tool",      "weight", "model",
          "servo", "gripper",      "bias",      "reset",  "stop",      "show",   "end",
          "all",   "arm1",         "arm2",      "motors", "joints",    "euler",  "angle-axis",
          "speed", "acceleration", "--no-wait", "--json", "--session", "--url"};
}

void execute_manual(link::Bus& bus, const link::SessionInfo& session, const ManualWish& wish,
                    const Patience& patience, std::ostream& out) {
  if (!wish.show.empty()) {
    show(look_at(bus, session, wish.show, patience), wish.show, wish.json, out);
    return;
  }
  const ManualAnswer answer = ask(bus, session, wish, patience);
  const bool good = answer.state == ManualState::taken || answer.state == ManualState::done;
  if (wish.json)
    out << Json{{"words", wish.words},
                {"accepted", answer.state != ManualState::refused},
                {"done", answer.state == ManualState::done},
                {"text", answer.text}}
               .dump(-1, ' ', false, Json::error_handler_t::replace)
        << "\n";
  if (!good)
    throw FaultError(FaultCode::illegal_in_state,
                     fmt::format("{} {}: {}", wish.words,
                                 answer.state == ManualState::refused ? "refused" : "failed", answer.text),
                     "look at the arm with `ui_cli manual show ARM`");
  if (!wish.json) out << answer.text << "\n";
}

}  // namespace mrroc::ui
