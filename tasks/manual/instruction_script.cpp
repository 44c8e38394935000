#include "tasks/manual/instruction_script.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/closest_match.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/text_file.hpp"
#include "tasks/manual/vocabulary.hpp"

namespace mrroc::manual {
namespace {

/// @return a word as it is told again: answers have room for a line
std::string shown(const std::string& word) {
  constexpr std::size_t kMost = 32;
  return word.size() > kMost ? word.substr(0, kMost) + ".." : word;
}

struct Verb {
  std::string_view name;
  Kind kind;
  std::string_view form;
};
constexpr std::array kVerbs{
    Verb{"home", Kind::home, "home ARM"},
    Verb{"move", Kind::move, "move ARM motors|joints|euler|angle-axis NUMBER... [speed S] [acceleration S]"},
    Verb{"jog", Kind::move, "jog ARM motors|joints|euler|angle-axis NUMBER... [speed S] [acceleration S]"},
    Verb{"preset", Kind::move, "preset ARM NAME [speed S] [acceleration S]"},
    Verb{"tool", Kind::tool, "tool ARM X Y Z AX AY AZ"},
    Verb{"weight", Kind::force_tool, "weight ARM NEWTONS [X Y Z]"},
    Verb{"model", Kind::kinematic_model, "model ARM NUMBER"},
    Verb{"servo", Kind::servo_algorithm, "servo ARM ALGORITHM [SET]"},
    Verb{"gripper", Kind::gripper, "gripper ARM METRES"},
    Verb{"bias", Kind::bias, "bias ARM"},
    Verb{"reset", Kind::reset, "reset ARM"},
    Verb{"stop", Kind::stop, "stop ARM"},
    Verb{"end", Kind::nothing, "end"},
};
static_assert(std::ranges::equal(kVerbs, kVerbNames, {}, &Verb::name), "terminals know the same ones");

/// The words of a line, taken one after the other.
class Reader {
 public:
  explicit Reader(std::string_view line) {
    std::istringstream in{std::string(line)};
    for (std::string w; in >> w;) words_.push_back(w);
  }

  void set_form(std::string_view form) { form_ = form; }
  [[nodiscard]] bool done() const { return next_ == words_.size(); }
  [[noreturn]] void refuse(const std::string& what) const {
    throw FaultError(FaultCode::bad_usage, what, fmt::format("it is written `{}`", form_));
  }
  std::string word(const char* what) {
    if (done()) refuse(fmt::format("{} is missing", what));
    return words_[next_++];
  }
  double number(const char* what) {
    const std::string text = word(what);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      refuse(fmt::format("'{}' is not a number", shown(text)));
    return value;
  }
  int whole(const char* what, int most) {
    const double value = number(what);
    if (value != std::floor(value) || value < 0 || value > most)
      refuse(fmt::format("{} is a whole number from 0 to {}", what, most));
    return static_cast<int>(value);
  }
  /// @return whether a word comes next that is no keyword behind the numbers
  [[nodiscard]] bool has_number() const {
    return !done() && words_[next_] != "speed" && words_[next_] != "acceleration";
  }
  /// Takes the word if it is the next one.
  bool take(std::string_view wanted) {
    if (done() || words_[next_] != wanted) return false;
    ++next_;
    return true;
  }

 private:
  std::vector<std::string> words_;
  std::size_t next_{};
  std::string_view form_{"VERB ARM ..."};
};

const Verb& verb_of(Reader& in) {
  const std::string word = in.word("what is to be done");
  const auto found = std::ranges::find(kVerbs, std::string_view(word), &Verb::name);
  if (found != kVerbs.end()) return *found;
  WordSet known;
  for (const Verb& v : kVerbs) known.insert(std::string(v.name));
  throw FaultError(
      FaultCode::bad_usage, fmt::format("there is no '{}'{}", shown(word), did_you_mean(word, known)),
      fmt::format("it is written `VERB ARM ...`, the verbs are {}", joined(kVerbs, ", ", &Verb::name)));
}

std::vector<std::size_t> arms_of(Reader& in, const std::vector<ArmInfo>& arms) {
  std::istringstream keys(in.word("the arm"));
  std::vector<std::size_t> chosen;
  for (std::string key; std::getline(keys, key, ',');) {
    const auto found = std::ranges::find(arms, key, &ArmInfo::key);
    if (key == "all") {
      for (std::size_t k = 0; k < arms.size(); ++k) chosen.push_back(k);
    } else if (found != arms.end()) {
      chosen.push_back(static_cast<std::size_t>(found - arms.begin()));
    } else {
      in.refuse(fmt::format("there is no arm '{}'; there are {} and all", shown(key),
                            joined(arms, ", ", &ArmInfo::key)));
    }
  }
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

Representation space_of(Reader& in) {
  const std::string word = in.word("the space");
  if (word == "motors") return Representation::motors;
  if (word == "joints") return Representation::joints;
  if (word == "euler") return Representation::xyz_euler_zyz;
  if (word == "angle-axis") return Representation::xyz_angle_axis;
  in.refuse(fmt::format("'{}' is no space; spaces are motors, joints, euler and angle-axis", shown(word)));
}

double share_of(Reader& in) {
  const double share = in.number("the share");
  if (!(share > 0) || share > 1) in.refuse("a share is above 0 and at most 1");
  return share;
}

void read_shares(Reader& in, ManualOrder& o) {
  while (!in.done()) {
    if (in.take("speed"))
      o.velocity = share_of(in);
    else if (in.take("acceleration"))
      o.acceleration = share_of(in);
    else
      return;
  }
}

void read_values(Reader& in, ManualOrder& o, std::size_t count, const std::string& arm) {
  for (std::size_t k = 0; k < count; ++k) {
    if (!in.has_number())
      in.refuse(
          fmt::format("a number is missing: {} wants {}, there {} {}", arm, count, k == 1 ? "is" : "are", k));
    o.value[k] = in.number("a number");
  }
}

ManualOrder order_of(Reader in, const Verb& verb, const ArmInfo& arm) {
  ManualOrder o{.kind = verb.kind};
  switch (verb.kind) {
    case Kind::move:
      if (verb.name == "preset") {
        const std::string name = in.word("the name");
        const auto found = arm.presets.find(name);
        if (found == arm.presets.end())
          in.refuse(fmt::format("{} has no preset '{}'; it has {}", arm.key, shown(name),
                                joined(arm.presets, ", ", [](const auto& preset) { return preset.first; })));
        o.value = found->second;
      } else {
        o.space = space_of(in);
        o.reference = verb.name == "jog" ? Reference::relative : Reference::absolute;
        const bool per_axis = o.space == Representation::motors || o.space == Representation::joints;
        read_values(in, o, per_axis ? static_cast<std::size_t>(arm.axes) : 6, arm.key);
      }
      read_shares(in, o);
      break;
    case Kind::tool:
      read_values(in, o, 6, arm.key);
      break;
    case Kind::force_tool:
      read_values(in, o, 1, arm.key);
      if (!in.done())
        for (std::size_t k = 1; k < 4; ++k) o.value[k] = in.number("the mass centre");
      break;
    case Kind::kinematic_model:
      o.model = static_cast<std::uint16_t>(in.whole("a model", 1000));
      break;
    case Kind::servo_algorithm:
      o.algorithm = static_cast<std::uint8_t>(in.whole("an algorithm", 255));
      if (!in.done()) o.parameter_set = static_cast<std::uint8_t>(in.whole("a parameter set", 255));
      break;
    case Kind::gripper:
      if (!arm.jaws)
        in.refuse(
            fmt::format("{0} has no gripper; robots.{0}.gripper in the configuration gives it one", arm.key));
      read_values(in, o, 1, arm.key);
      if (!(o.value[0] > 0)) in.refuse("a distance of jaws is above 0");
      break;
    default:
      break;
  }
  if (!in.done()) in.refuse(fmt::format("'{}' is one word too many", shown(in.word(""))));
  return o;
}

}  // namespace

Instructions understand(std::string_view line, const std::vector<ArmInfo>& arms) {
  Reader in(line);
  const Verb& verb = verb_of(in);
  in.set_form(verb.form);
  Instructions instructions;
  if (verb.name == "end") {
    if (!in.done()) in.refuse("`end` stands alone");
    instructions.end = true;
    return instructions;
  }
  instructions.arms = arms_of(in, arms);
  for (const std::size_t arm : instructions.arms)
    instructions.orders.push_back(order_of(in, verb, arms[arm]));
  return instructions;
}

InstructionScript load_script(const std::filesystem::path& file, const std::vector<ArmInfo>& arms) {
  constexpr std::size_t kLargestScript = 1'000'000;
  std::istringstream in(read_input_file(file, kLargestScript, FaultCode::bad_script));
  InstructionScript script;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream words(line);
    ScriptedInstruction s;
    if (!(words >> s.i) || s.i < 1)
      throw FaultError(FaultCode::bad_script,
                       fmt::format("{}:{}: a line is MACROSTEP WORDS...", file.string(), number));
    std::getline(words >> std::ws, s.instruction);
    try {
      static_cast<void>(understand(s.instruction, arms));
    } catch (const FaultError& e) {
      throw FaultError(FaultCode::bad_script, fmt::format("{}:{}: {}", file.string(), number, e.what()));
    }
    script.push_back(s);
  }
  std::ranges::stable_sort(script, {}, &ScriptedInstruction::i);
  return script;
}

}  // namespace mrroc::manual
