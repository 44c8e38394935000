#include "ui_cli/manual_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/config.hpp"
#include "base/fault.hpp"
#include "base/instructions.hpp"
#include "base/joined.hpp"
#include "base/representation.hpp"
#include "ui_cli/keys.hpp"
#include "ui_cli/manual_link.hpp"
#include "ui_cli/manual_steps.hpp"

namespace mrroc::ui {
namespace {

constexpr std::array<std::string_view, 4> kSpaces{"motors", "joints", "euler", "angle-axis"};
constexpr std::size_t kLongestText = 999;  // more than an instruction may have: that is refused, not cut

ManualDeed instruction(std::string words) { return {.words = std::move(words)}; }
ManualDeed refusal(std::string why) { return {.refusal = std::move(why)}; }

/// @return the words with one blank between them
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Takes the beginning away if the words begin with it.
void drop(std::vector<std::string>& words, const std::vector<std::string>& beginning) {
  if (words.size() >= beginning.size() && std::equal(beginning.begin(), beginning.end(), words.begin()))
    words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(beginning.size()));
}

/// The instruction of a line as it was typed: also with a colon before it or as it is written in a shell.
/// @param asked  what the instruction begins with, which may be typed once more
ManualDeed typed(const std::string& asked, std::string text, const std::string& tail) {
  text.erase(0, text.find_first_not_of(" :"));
  std::vector<std::string> words = words_of(text);
  drop(words, {"ui_cli"});
  drop(words, {"manual"});
  drop(words, words_of(asked));
  if (words.empty()) return {};
  const auto rest = joined(words, " ");
  if (asked.empty() && std::ranges::count(kOfShell, words[0]) > 0)
    return refusal(fmt::format("`{0}` is for a shell: `ui_cli manual {0} ...`", words[0]));
  for (const std::string& word : words)
    if (word.starts_with("--"))
      return refusal(
          fmt::format("there is no '{}' here: options are for a shell, `ui_cli manual ...`", word));
  const std::string whole = asked + (asked.empty() ? "" : " ") + rest + tail;
  if (whole.size() > kLongestInstruction) return refusal(too_long(whole.size()) + "; " + kShorter);
  return instruction(whole);
}

/// @return whether the line begins with the name of an instruction
bool names_instruction(const std::string& line) {
  const std::string name = line.substr(0, line.find(' '));
  return std::ranges::count(instruction_verbs("manual"), name) + std::ranges::count(kOfShell, name) > 0;
}

/// @return a number as short as it can be read back
std::string number(double value) { return fmt::format("{}", std::abs(value) < 1e-12 ? 0.0 : value); }

}  // namespace

std::vector<ManualArm> manual_arms(const std::filesystem::path& run_folder) {
  std::vector<ManualArm> arms;
  if (run_folder.empty() || !std::filesystem::is_regular_file(run_folder / "config.toml")) return arms;
  try {
    const Config config = Config::load(run_folder / "config.toml");
    for (const std::string& name : config.texts("robots.order", std::vector<std::string>{})) {
      const Config robot = config.section("robots." + name);
      ManualArm arm{.name = name, .axes = robot.integer("axes", 6), .presets = {}};
      for (const char* preset : {"synchro", "front", "0", "1", "2"})
        if (robot.has(std::string("presets.") + preset)) arm.presets.emplace_back(preset);
      arms.push_back(std::move(arm));
    }
  } catch (const FaultError&) {  // what a folder holds that is no run's does not matter here
    arms.clear();
  }
  return arms;
}

void ManualPage::show(const std::string& arm, const EffectorReply& reading) {
  const auto found = std::ranges::find(arms_, arm, &ManualArm::name);
  if (found != arms_.end()) found->reading = reading;
}

ManualDeed ManualPage::key(int key) {
  if (prompt_) return type(key);
  if (arms_.empty())
    return key == 'm' || key == key::kEscape ? ManualDeed{.leave = true} : ManualDeed{.known = false};
  if (choose(key)) return {};
  switch (key) {
    case key::kLeft:
      return jog(-1);
    case key::kRight:
      return jog(1);
    case 'a':
      if (all_) return refusal("choose one arm: its coordinates are its own");
      return ask(
          {.label = fmt::format("{} {} {} to", arms_[arm_].name, kSpaces[static_cast<std::size_t>(space_)],
                                coordinate_name(space_ >= Space::euler, axis_)),
           .words = "",
           .needs = Needs::coordinate});
    case 'h':
      return ask({.label = "home " + whom(), .words = "home " + whom(), .needs = Needs::nothing, .key = "h"});
    case 'b':
      return ask({.label = "bias " + whom(), .words = "bias " + whom(), .needs = Needs::nothing, .key = "b"});
    case 'z':
      return ask(
          {.label = "clear the fault of " + whom(), .words = "reset " + whom(), .needs = Needs::nothing});
    case ' ':
      return instruction("stop " + whom());
    case 'o':
      return ask(
          {fmt::format("preset of {} ({})", whom(), joined(arms_[arm_].presets, ", ")), "preset " + whom()});
    case 'g':
      return ask(
          {.label = fmt::format("jaws of {} to [m]", whom()), .words = "gripper " + whom(), .key = "g"});
    case 'w':
      return ask({.label = fmt::format("tool of {}: X Y Z AX AY AZ [m, rad]", whom()),
                  .words = "tool " + whom(),
                  .key = "w"});
    case 'W':
      return ask({fmt::format("weight of {}: NEWTONS [X Y Z]", whom()), "weight " + whom()});
    case 'k':
      return ask({fmt::format("kinematic model of {}", whom()), "model " + whom()});
    case 'v':
      return ask({fmt::format("servo of {}: ALGORITHM [SET]", whom()), "servo " + whom()});
    case ':':
      return ask({"instruction", ""});
    case 'j':  // no keys of their own: somebody types an instruction
    case 'l':
    case 's':
    case 't':
      return ask({.label = "instruction", .words = "", .text = std::string(1, static_cast<char>(key))});
    case 'm':
    case key::kEscape:
      return {.leave = true};
    default:
      return {.known = false};
  }
}

bool ManualPage::choose(int key) {
  auto& step = step_[static_cast<std::size_t>(unit())];
  if (key == '0') {
    all_ = true;
  } else if (key >= '1' && key < '1' + static_cast<int>(std::min<std::size_t>(arms_.size(), 9))) {
    arm_ = static_cast<std::size_t>(key - '1');
    all_ = false;
  } else if (key == 'c') {
    space_ = static_cast<Space>((static_cast<std::size_t>(space_) + 1) % kSpaces.size());
  } else if (key == key::kUp) {
    axis_ = (axis_ + coordinates() - 1) % coordinates();
  } else if (key == key::kDown) {
    axis_ = (axis_ + 1) % coordinates();
  } else if (key == '+' || key == '=') {
    step = std::min(step + 1, kSteps[0].size() - 1);
  } else if (key == '-') {
    step = step > 0 ? step - 1 : 0;
  } else if (key == '>') {
    speed_ = std::min(speed_ + 1, kSpeeds.size() - 1);
  } else if (key == '<') {
    speed_ = speed_ > 0 ? speed_ - 1 : 0;
  } else {
    return false;
  }
  axis_ = std::min(axis_, coordinates() - 1);
  return true;
}

ManualDeed ManualPage::ask(Prompt prompt) {
  prompt_ = std::move(prompt);
  return {};
}

ManualDeed ManualPage::type(int key) {
  const bool enter = key == key::kEnter || key == key::kReturn || key == key::kKeypadEnter;
  if (key == key::kEscape) {
    prompt_.reset();
    return {};
  }
  if (enter) {
    const Prompt asked = *prompt_;
    prompt_.reset();
    return sent(asked);
  }
  if (key == key::kBackspace || key == key::kDelete || key == '\b') {
    if (!prompt_->text.empty()) prompt_->text.pop_back();
  } else if (key >= ' ' && key < key::kDelete && prompt_->text.size() < kLongestText) {
    prompt_->text += static_cast<char>(key);
  }
  return {};
}

ManualDeed ManualPage::sent(const Prompt& asked) const {
  if (asked.text.empty()) return asked.needs == Needs::nothing ? instruction(asked.words) : ManualDeed{};
  if (asked.needs == Needs::coordinate) return go_to(asked.text);
  if (!asked.key.empty() && names_instruction(asked.key + asked.text))
    return typed("", asked.key + asked.text, "");
  if (asked.needs == Needs::nothing)
    return refusal(
        fmt::format("`{}` needs no '{}'; type other instructions behind :", asked.words, asked.text));
  const bool moves = asked.words.starts_with("preset") && asked.text.find("speed") == std::string::npos;
  return typed(asked.words, asked.text, moves ? tail() : "");
}

ManualDeed ManualPage::jog(double direction) const {
  if (all_) return refusal("choose one arm with its number: arms are jogged one at a time");
  std::vector<std::string> numbers(static_cast<std::size_t>(coordinates()), "0");
  numbers[static_cast<std::size_t>(axis_)] = number(direction * step());
  return instruction(fmt::format("jog {} {} {}{}", whom(), kSpaces[static_cast<std::size_t>(space_)],
                                 fmt::join(numbers, " "), tail()));
}

ManualDeed ManualPage::go_to(const std::string& line) const {
  const std::string text = joined(words_of(line), " ");
  if (text.empty()) return {};
  double target = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), target);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(target))
    return refusal(fmt::format("'{}' is not a number", text));
  if (!arms_[arm_].reading) return refusal(fmt::format("where {} is has not been told yet", whom()));
  if (!arms_[arm_].reading->position_known)
    return refusal(fmt::format("{} does not know its position; h homes it", whom()));
  const auto now = values(arms_[arm_]);
  std::vector<std::string> numbers;
  for (int k = 0; k < coordinates(); ++k)
    numbers.push_back(k == axis_ ? number(target) : fmt::format("{:.6f}", now[static_cast<std::size_t>(k)]));
  return instruction(fmt::format("move {} {} {}{}", whom(), kSpaces[static_cast<std::size_t>(space_)],
                                 fmt::join(numbers, " "), tail()));
}

std::string ManualPage::prompt() const {
  return prompt_ ? fmt::format("{}: {}_", prompt_->label, prompt_->text) : "";
}

int ManualPage::coordinates() const {
  return space_ >= Space::euler ? 6 : std::clamp(arms_[arm_].axes, 1, static_cast<int>(kMaxAxes));
}

ManualPage::Unit ManualPage::unit() const {
  if (space_ == Space::motors) return Unit::motor;
  const bool track = space_ == Space::joints && arms_[arm_].axes > 6 && axis_ == 0;
  return track || (space_ >= Space::euler && axis_ < 3) ? Unit::length : Unit::angle;
}

double ManualPage::step() const {
  const auto u = static_cast<std::size_t>(unit());
  return kSteps[u][step_[u]];
}

std::string ManualPage::whom() const { return all_ ? "all" : arms_[arm_].name; }

std::string ManualPage::tail() const { return fmt::format(" speed {}", kSpeeds[speed_]); }

std::array<double, 8> ManualPage::values(const ManualArm& arm) const {
  std::array<double, 8> shown{};
  if (!arm.reading) return shown;
  const EffectorReply& r = *arm.reading;
  if (space_ == Space::motors) return r.motors;
  if (space_ == Space::joints) return r.joints;
  std::ranges::copy(r.T_0E, shown.begin());
  if (space_ == Space::angle_axis) return shown;
  PoseNumbers pose{};
  std::ranges::copy(r.T_0E, pose.begin());
  const auto T_0E = pose_from_numbers(Representation::xyz_angle_axis, pose);
  const PoseNumbers euler = T_0E ? numbers_from_pose(Representation::xyz_euler_zyz, *T_0E) : PoseNumbers{};
  std::copy_n(euler.begin(), 6, shown.begin());
  return shown;
}

}  // namespace mrroc::ui
