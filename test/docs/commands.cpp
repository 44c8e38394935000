#include "test/docs/commands.hpp"

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/file_content.hpp"

namespace mrroc::test {
namespace fs = std::filesystem;
namespace {

/// What a line to be typed begins with.
const std::regex& beginning() {
  static const std::regex r(
      R"(^(\./run|(build/release/bin/)?(ui_cli|cube_solve|calibrate|vsp_\w+)|mrroc|sudo|git|cmake|cpack|ctest|pip3?|(/usr/bin/)?python3|ip|ssh|apt-get|source|cd|MRROC_\w+=\S+ \./run)( .*|$))");
  return r;
}

bool is_command(const std::string& text) { return std::regex_match(text, beginning()); }

/// Without prompt, indentation, remark and explanation in a second column.
std::string bare(const std::string& line) {
  static const std::regex prompt(R"(^\s*(\$ )?)");
  static const std::regex rest(R"((\s+#\s.*|\s{2,}[^\s#-].*|\s+)$)");
  return std::regex_replace(std::regex_replace(line, prompt, ""), rest, "");
}

/// Language of a fence, or nothing when the line is none.
bool is_fence(const std::string& line, std::string& language) {
  static const std::regex fence(R"(^\s*```(\w*)\s*$)");
  std::smatch m;
  if (!std::regex_match(line, m, fence)) return false;
  language = m[1];
  return true;
}

bool of_a_shell(const std::string& language) {
  return language.empty() || language == "sh" || language == "bash" || language == "console";
}

/// Commands in code marks within the text; a single word is a name, not a command, but for ./run NAME.
void add_marked(const fs::path& document, int number, const std::string& line, std::vector<Command>& found) {
  static const std::regex mark("`([^`]+)`");
  for (auto m = std::sregex_iterator(line.begin(), line.end(), mark); m != std::sregex_iterator(); ++m) {
    const std::string text = std::regex_replace((*m)[1].str(), std::regex(R"(\\\|)"), "|");
    if (text.find(' ') != std::string::npos && is_command(text)) found.push_back({document, number, text});
  }
}

}  // namespace

std::vector<Command> commands_in(const fs::path& document, const std::string& text) {
  std::vector<Command> found;
  std::istringstream in(text);
  bool inside = false;
  std::string language;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (is_fence(line, language)) {
      inside = !inside;
    } else if (!inside) {
      add_marked(document, number, line, found);
    } else if (of_a_shell(language)) {
      const std::string command = bare(line);
      if (is_command(command)) found.push_back({document, number, command});
    }
  }
  return found;
}

std::vector<Command> document_commands(const fs::path& root) {
  std::vector<fs::path> documents{"README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") documents.push_back(entry.path().lexically_relative(root));
  std::ranges::sort(documents.begin() + 1, documents.end());
  std::vector<Command> all;
  std::set<std::string> seen;
  for (const fs::path& document : documents)
    for (Command& c : commands_in(document, file_content(root / document)))
      if (seen.insert(c.text).second) all.push_back(std::move(c));
  return all;
}

std::string first_words(const std::string& command) {
  static const std::regex placeholder(R"([A-Z\[<|*]|^-|.[/:])");
  std::istringstream in(command);
  std::string words;
  for (std::string word; in >> word;) {
    if (!words.empty() && std::regex_search(word, placeholder)) break;
    words += (words.empty() ? "" : " ") + word;
  }
  return words;
}

namespace {

void read_trials_of(const fs::path& file, std::vector<Trial>& trials) {
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    if (line.starts_with("= ")) {
      trials.push_back({line.substr(2), {}, {}, {}});
    } else if (!trials.empty() && line.starts_with("! ")) {
      trials.back().not_run = line.substr(2);
    } else if (!trials.empty() && line.starts_with("~ ")) {
      trials.back().stand_in = line.substr(2);
    } else if (!trials.empty() && line.starts_with("  ")) {
      trials.back().script += line.substr(2) + "\n";
    } else {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) +
                               ": neither command, script nor reason");
    }
  }
}

}  // namespace

std::vector<Trial> read_trials(const fs::path& root) {
  const fs::directory_iterator folder(root / "test/docs/trials");
  std::vector<fs::path> files(begin(folder), end(folder));
  std::ranges::sort(files);
  std::vector<Trial> trials;
  for (const fs::path& file : files) read_trials_of(file, trials);
  return trials;
}

Trial trial_of(const std::vector<Trial>& trials, const std::string& command) {
  const auto known = std::ranges::find(trials, command, &Trial::command);
  if (known == trials.end()) return {command, command, {}, {}};
  Trial t = *known;
  if (t.script.empty()) t.script = command;
  for (auto at = t.script.find('@'); at != std::string::npos; at = t.script.find('@', at + command.size()))
    t.script.replace(at, 1, command);
  return t;
}

}  // namespace mrroc::test
