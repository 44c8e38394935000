#include "ui_cli/explain.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "base/closest_match.hpp"
#include "base/command_hint.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/operator.hpp"
#include "base/wrap.hpp"
#include "ui_cli/consequence.hpp"
#include "ui_cli/states.hpp"

namespace mrroc::ui {
namespace {

constexpr const char* kHelp =
    "Usage: ui_cli explain [CODE] [--json]\n\n"
    "Says what an error means, what it mostly comes from and what to do. CODE: its name or number,\n"
    "a state as it is shown, such as `holding` or `waiting for start`, or a whole line\n`error: CODE: ...`; "
    "without it, a list of all.\n";

/// @return the code alone, where the words are an error line as programs write it; otherwise the words
std::vector<std::string> without_error_line(const std::vector<std::string>& words) {
  constexpr std::string_view kBegin = "error: ";
  const std::string line = joined(words, " ");
  const std::size_t end = line.find(':', kBegin.size());
  if (!line.starts_with(kBegin)) return words;
  return {line.substr(kBegin.size(), end == std::string::npos ? end : end - kBegin.size())};
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<FaultCode> code_of(const std::string& word) {
  std::int64_t number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc() && end == word.data() + word.size()) return fault_code(number);
  if (lower(word) == to_string(OperatorOrder::emergency_stop)) return FaultCode::emergency_stop;
  return fault_code(std::string_view(lower(word)));
}

/// @return the words as one state is written: their case and what is between them do not matter
std::string as_state(const std::vector<std::string>& words) {
  std::string name = lower(joined(words, " "));
  std::ranges::replace(name, '_', ' ');
  std::ranges::replace(name, '-', ' ');
  return name;
}

/// @return such as `signal n` of `signal 11`: of a code with a number behind it all have one entry
std::string without_number(const std::string& name) {
  constexpr std::string_view kSignal = "signal ";
  const bool numbered =
      name.starts_with(kSignal) && name.size() > kSignal.size() &&
      std::all_of(name.begin() + kSignal.size(), name.end(), [](unsigned char c) { return std::isdigit(c); });
  return numbered ? std::string(kSignal) + "n" : name;
}

/// Those with one name, such as `ready`, which arms and processes can be.
using States = std::vector<StateEntry>;

/// @return all states with that name
States states_of(const std::vector<std::string>& words) {
  const std::string name = without_number(as_state(words));
  States found;
  for (const StateEntry& s : kStates)
    if (as_state({std::string(s.name)}) == name) found.push_back(s);
  return found;
}

/// @return all states, each name once, in the order of the table
std::vector<States> states_by_name() {
  std::vector<States> all;
  for (const StateEntry& s : kStates) {
    const auto same = std::ranges::find_if(all, [&](const States& n) { return n.front().name == s.name; });
    if (same == all.end())
      all.push_back({s});
    else
      same->push_back(s);
  }
  return all;
}

nlohmann::ordered_json json_of(const StateEntry& s) {
  return {{"state", s.name}, {"of", s.of}, {"what", s.text}, {"remedy", s.next}};
}

nlohmann::ordered_json json_of(const FaultEntry& e) {
  return {{"code", e.name},
          {"number", static_cast<int>(e.code)},
          {"class", to_string(e.fault_class)},
          {"what", e.text},
          {"causes", e.causes},
          {"remedy", e.remedy},
          {"follows", consequence(e.code)},
          {"exit_status", exit_status(e.code)}};
}

FaultError unknown(const std::string& word) {
  WordSet names;
  for (const FaultEntry& e : all_faults()) names.emplace(e.name);
  for (const StateEntry& s : kStates) names.emplace(s.name);
  return {FaultCode::bad_usage,
          fmt::format("there is no error and no state '{}'{}", word, did_you_mean(lower(word), names)),
          "`ui_cli explain` lists all"};
}

void list(std::ostream& out, bool json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const FaultEntry& e : all_faults()) {
    if (e.code == FaultCode::none) continue;
    if (json)
      all.push_back(json_of(e));
    else
      out << fmt::format("{:<26} {}\n", e.name, e.text);
  }
  if (json) {
    out << all.dump(2) << "\n";
    return;
  }
  out << "\n";
  for (const States& states : states_by_name()) {
    std::string_view name = states.front().name;
    for (const StateEntry& s : states)
      out << fmt::format("{:<26} of {}: {}\n", std::exchange(name, ""), s.of, s.text);
  }
}

/// Adds a paragraph with a heading before it.
void add(std::string& text, std::string_view head, std::string_view words) {
  constexpr int kWidth = 80, kHead = 17;
  for (const std::string& line : wrap(command_hint(words), kWidth - kHead))
    text += fmt::format("{:<{}}{}\n", std::exchange(head, ""), kHead, line);
}

std::string explanation(const States& states) {
  std::string text;
  if (states.size() > 1) text = fmt::format("{}\n", states.front().name);
  for (const StateEntry& s : states) {
    text += states.size() > 1 ? fmt::format("  of {}: {}\n", s.of, s.text)
                              : fmt::format("{} (of {}): {}\n", s.name, s.of, s.text);
    add(text, "  what to do:", s.next);
  }
  return text;
}

/// What one word, or all of them as one state, stands for. @return whether it is known
bool explain(const std::vector<std::string>& words, bool json, nlohmann::ordered_json& all,
             std::ostream& out) {
  const auto code = words.size() == 1 ? code_of(words.front()) : std::nullopt;
  if (code && json) all.push_back(json_of(fault_entry(*code)));
  if (code && !json) out << ui::explanation(*code);
  if (code) return true;
  const States states = states_of(words);
  if (!json) out << explanation(states);
  for (const StateEntry& s : states)
    if (json) all.push_back(json_of(s));
  return !states.empty();
}

}  // namespace

std::string explanation(FaultCode code) {
  const FaultEntry& e = fault_entry(code);
  std::string text = fmt::format("{} ({}, number {}): {}\n", e.name, to_string(e.fault_class),
                                 static_cast<int>(code), e.text);
  add(text, "  what follows:", fmt::format("{}; exit status {}", consequence(code), exit_status(code)));
  std::string_view rest = e.causes;
  for (std::string_view head = "  likely causes:"; !rest.empty(); head = "") {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    add(text, head, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  add(text, "  what to do:", e.remedy);
  return text;
}

std::vector<std::string> explain_words() {
  std::vector<std::string> words{"--json"};
  for (const FaultEntry& e : all_faults()) words.emplace_back(e.name);
  for (const StateEntry& s : kStates)
    if (s.name.find(' ') == std::string_view::npos && std::ranges::count(words, s.name) == 0)
      words.emplace_back(s.name);
  return words;
}

int run_explain(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  bool json = false;
  std::vector<std::string> words;
  for (const std::string& a : arguments) {
    if (a == "--help" || a == "-h") {
      out << command_hint(kHelp);
      return 0;
    }
    if (a == "--json")
      json = true;
    else
      words.push_back(a);
  }
  if (words.empty()) {
    list(out, json);
    return 0;
  }
  words = without_error_line(words);
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  // Several words may be one state, such as waiting for start.
  const bool one = words.size() > 1 && explain(words, json, all, out);
  for (std::size_t k = 0; k < words.size() && !one; ++k)
    if (!explain({words[k]}, json, all, out)) {
      err << unknown(words[k]).error_line() << "\n";
      return 2;
    }
  if (json) out << (all.size() == 1 ? all.front() : all).dump(2) << "\n";
  return 0;
}

}  // namespace mrroc::ui
