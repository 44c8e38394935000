#include "ui_cli/explain.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "base/fault_table.hpp"
#include "base/nearest.hpp"
#include "ui_cli/wrap.hpp"

namespace mrroc::ui {
namespace {

constexpr const char* kHelp =
    "Usage: ui_cli explain [CODE] [--json]\n\n"
    "Says what an error means, what it mostly comes from and what to do. CODE: its name or number; without "
    "it, a\n"
    "list of all.\n";

std::string_view meaning(FaultClass c) {
  switch (c) {
    case FaultClass::non_fatal:
      return "a command is refused or a motion stopped; the effector goes on working";
    case FaultClass::fatal:
      return "the effector stops and accepts nothing but a reset";
    case FaultClass::system:
      break;
  }
  return "the task ends and the drives brake";
}

std::optional<FaultCode> code_of(const std::string& word) {
  std::int64_t number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc() && end == word.data() + word.size()) return fault_code(number);
  return fault_code(std::string_view(word));
}

nlohmann::ordered_json json_of(const FaultEntry& e) {
  return {{"code", e.name},
          {"number", static_cast<int>(e.code)},
          {"class", to_string(e.fault_class)},
          {"what", e.text},
          {"causes", e.causes},
          {"remedy", e.remedy},
          {"exit_status", exit_status(e.code)}};
}

FaultError unknown(const std::string& word) {
  WordSet names;
  for (const FaultEntry& e : kFaultTable) names.emplace(e.name);
  const std::string near = nearest(word, names);
  return {FaultCode::bad_usage,
          fmt::format("there is no error '{}'{}", word,
                      near.empty() ? "" : fmt::format("; did you mean '{}'?", near)),
          "`ui_cli explain` lists all"};
}

void list(std::ostream& out, bool json) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const FaultEntry& e : kFaultTable) {
    if (e.code == FaultCode::none) continue;
    if (json)
      all.push_back(json_of(e));
    else
      out << fmt::format("{:<26} {}\n", e.name, e.text);
  }
  if (json) out << all.dump(2) << "\n";
}

}  // namespace

std::string explanation(FaultCode code) {
  const FaultEntry& e = fault_entry(code);
  std::string text = fmt::format("{} ({}, number {}): {}\n", e.name, to_string(e.fault_class),
                                 static_cast<int>(code), e.text);
  const auto add = [&text](std::string_view head, std::string_view words) {
    constexpr int kWidth = 80, kHead = 17;
    for (const std::string& line : wrap(words, kWidth - kHead))
      text += fmt::format("{:<{}}{}\n", std::exchange(head, ""), kHead, line);
  };
  add("  what follows:", fmt::format("{}; exit status {}", meaning(e.fault_class), exit_status(code)));
  std::string_view rest = e.causes;
  for (std::string_view head = "  likely causes:"; !rest.empty(); head = "") {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    add(head, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  add("  what to do:", e.remedy);
  return text;
}

std::vector<std::string> explain_words() {
  std::vector<std::string> words{"--json"};
  for (const FaultEntry& e : kFaultTable) words.emplace_back(e.name);
  return words;
}

int run_explain(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  bool json = false;
  std::vector<std::string> words;
  for (const std::string& a : arguments) {
    if (a == "--help" || a == "-h") {
      out << kHelp;
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
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const std::string& word : words) {
    const std::optional<FaultCode> code = code_of(word);
    if (!code) {
      err << unknown(word).error_line() << "\n";
      return 2;
    }
    if (json)
      all.push_back(json_of(fault_entry(*code)));
    else
      out << explanation(*code);
  }
  if (json) out << (all.size() == 1 ? all.front() : all).dump(2) << "\n";
  return 0;
}

}  // namespace mrroc::ui
