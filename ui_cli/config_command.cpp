#include "ui_cli/config_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "base/closest_match.hpp"
#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/program.hpp"
#include "ui_cli/subprocess.hpp"

namespace mrroc::ui {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kAbout =
    "Lists the parameters of a task, which --set KEY=VALUE changes and ./run campaign --vary draws.\n"
    "With --truth: only those of the plant. No controller reads them; they begin as what is believed.\n"
    "Without a task: of all tasks.";

struct Options {
  bool truth{}, json{};
  std::string task;
  std::vector<std::string> settings;
};

std::vector<std::string> tasks() {
  std::vector<std::string> names;
  std::istringstream words(MRROC_TASKS);
  for (std::string name; words >> name;) names.push_back(name);
  return names;
}

/// @return whether its program has been built
bool is_built(const std::string& task) {
  try {
    return !program_beside(task).empty();
  } catch (const FaultError&) {
    return false;
  }
}

Finished ask(const std::string& task, const Options& o, bool json) {
  std::vector<std::string> words{"--parameters"};
  if (o.truth) words.emplace_back("--truth");
  if (json) words.emplace_back("--json");
  for (const std::string& setting : o.settings) words.insert(words.end(), {"--set", setting});
  return run_program(program_beside(task), words);
}

/// A key that several tasks have stands once; where they give it other values, those are told.
struct Entry {
  Json parameter;
  std::map<std::string, std::vector<std::string>> tasks;  // by the value that they have
};

std::string words_of(const Json& parameter, const char* key) {
  const auto found = parameter.find(key);
  return found == parameter.end() || found->is_null() ? "" : found->get<std::string>();
}

std::map<std::string, Entry> all_keys(const Options& o) {
  std::map<std::string, Entry> all;
  for (const std::string& task : tasks()) {
    if (!is_built(task)) continue;
    const Finished answer = ask(task, o, true);
    const Json list = Json::parse(answer.out, nullptr, false);
    if (answer.status != 0 || !list.is_array()) continue;
    for (const Json& parameter : list) {
      Entry& entry = all[words_of(parameter, "key")];
      if (entry.parameter.is_null()) entry.parameter = parameter;
      entry.tasks[words_of(parameter, "default")].push_back(task);
    }
  }
  return all;
}

std::string table_of(const std::map<std::string, Entry>& all) {
  std::string text;
  for (const auto& [key, entry] : all) {
    text += fmt::format("{} = {}", key, words_of(entry.parameter, "default"));
    for (const char* const part : {"range", "unit"})
      if (const std::string word = words_of(entry.parameter, part); !word.empty())
        text += fmt::format("{}{}", std::string_view(part) == "range" ? "  # " : " ", word);
    if (const std::string meaning = words_of(entry.parameter, "meaning"); !meaning.empty())
      text += fmt::format("\n    {}", meaning);
    if (const std::string believed = words_of(entry.parameter, "believed"); !believed.empty())
      text += fmt::format("; believed: {}", believed);
    for (const auto& [value, names] : entry.tasks)
      if (entry.tasks.size() > 1) text += fmt::format("\n    {}: {}", value, joined(names, ", "));
    text += "\n";
  }
  return text;
}

std::string json_of(const std::map<std::string, Entry>& all) {
  Json list = Json::array();
  for (const auto& [key, entry] : all) {
    list.push_back(entry.parameter);
    Json& defaults = list.back()["tasks"];
    for (const auto& [value, names] : entry.tasks)
      for (const std::string& task : names) defaults[task] = value;
  }
  return list.dump(2) + "\n";
}

void check_task(const std::string& task) {
  const std::vector<std::string> all = tasks();
  if (std::ranges::find(all, task) != all.end()) return;
  throw FaultError(
      FaultCode::bad_usage,
      fmt::format("there is no task '{}'{}", task, did_you_mean(task, WordSet(all.begin(), all.end()))),
      "there are " + joined(all, ", "));
}

}  // namespace

std::vector<std::string> config_words() {
  std::vector<std::string> words{"--truth", "--set", "--json"};
  std::ranges::move(tasks(), std::back_inserter(words));
  return words;
}

int run_config(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Options o;
  CommandLine line(kAbout, "ui_cli config");
  line.option("task", o.task, "whose parameters; without it, those of all tasks that have been built");
  line.flag("--truth", o.truth, "only what is true of the plant, with what controllers believe instead");
  line.option("--set", o.settings, "as the task takes it, for keys that there are only then; may be repeated")
      .type_name("KEY=VALUE");
  line.flag("--json", o.json, "print JSON");
  if (const auto status = line.parse_words(arguments, out, err,
                                           {"ui_cli config --truth drawing", "ui_cli config rubik --json"}))
    return *status;
  if (o.task.empty()) {
    const auto all = all_keys(o);
    out << (o.json ? json_of(all) : table_of(all));
    return 0;
  }
  check_task(o.task);
  const Finished answer = ask(o.task, o, o.json);
  out << answer.out;
  return answer.status;
}

}  // namespace mrroc::ui
