#include "test/base/layers.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

namespace mrroc::test {
namespace {

struct Folder {
  std::string_view name;
  int level;
};

// The longest name that fits comes first. "mrroc" holds the headers generated from base/msg.
constexpr std::array kFolders{
    Folder{"base/link", 2}, Folder{"base/msg", 1}, Folder{"mrroc", 1}, Folder{"base", 0},
    Folder{"edp", 3},       Folder{"ecp", 3},      Folder{"mp", 3},    Folder{"vsp", 3},
    Folder{"ui_cli", 3},    Folder{"robots", 4},   Folder{"tasks", 4}, Folder{"sim", 5},
    Folder{"launch", 7},    Folder{"test", 9},     Folder{"bench", 9},
};
constexpr int kCellLevel = 6;  // of tasks/NAME/cell
constexpr int kMainLevel = 8;

struct Forbidden {
  std::string_view from;
  std::string_view to;
};

// Beyond the levels: tasks are hardware independent, robots are task independent (MG 5), the plant knows nothing of either's
// users.
constexpr std::array kForbidden{
    Forbidden{"tasks", "edp"},  Forbidden{"tasks", "robots"}, Forbidden{"robots", "tasks"},
    Forbidden{"robots", "ecp"}, Forbidden{"robots", "mp"},    Forbidden{"robots", "vsp"},
    Forbidden{"sim", "tasks"},  Forbidden{"sim", "mp"},       Forbidden{"sim", "ecp"},
    Forbidden{"sim", "vsp"},    Forbidden{"sim", "ui_cli"}};

struct Library {
  std::string_view header;  ///< beginning of what is included
  std::string_view owner;   ///< the folder or the file that may include it
};

constexpr std::array kLibraries{
    Library{"lcm/", "base/link"},
    Library{"bullet/", "sim"},
    Library{"btBullet", "sim"},
    Library{"BulletDynamics/", "sim"},
    Library{"BulletCollision/", "sim"},
    Library{"LinearMath/", "sim"},
    Library{"mujoco/", "sim/mujoco"},
    Library{"EGL/", "sim/camera"},
    Library{"GL/", "sim/camera"},
    Library{"opencv2/", "vsp"},
    Library{"apriltag/", "vsp"},
    Library{"hpipm_", "robots/ocp"},
    Library{"blasfeo", "robots/ocp"},
    Library{"httplib.h", "ui_cli/view/httplib.hpp"},
    Library{"CLI/", "base/command_line.cpp"},
};

bool is_in(std::string_view path, std::string_view folder) {
  return path.starts_with(folder) && path.size() > folder.size() && path[folder.size()] == '/';
}

/// @return the folder tasks/NAME/cell that the file is in
std::optional<Folder> cell_of(std::string_view path) {
  if (!is_in(path, "tasks")) return std::nullopt;
  const std::size_t end = path.find('/', std::string_view("tasks/").size());
  if (end == std::string_view::npos || !path.substr(end).starts_with("/cell/")) return std::nullopt;
  return Folder{path.substr(0, end + std::string_view("/cell").size()), kCellLevel};
}

std::optional<Folder> folder_of(std::string_view path) {
  if (const auto cell = cell_of(path)) return cell;
  for (const Folder& folder : kFolders)
    if (is_in(path, folder.name)) return folder;
  return std::nullopt;
}

bool is_main(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  return name.starts_with("main") && name.ends_with(".cpp");
}

std::string sentence(std::string_view path, std::string_view include, const std::string& reason) {
  return std::string(path) + " includes " + std::string(include) + ": " + reason;
}

std::string library_violation(std::string_view path, std::string_view include) {
  if (include == "opencv2/opencv.hpp") return "take the parts of OpenCV that are used, not the whole";
  // Benchmarks compare with libraries; a test has the rights of the folder that it mirrors.
  if (is_in(path, "bench") && !include.starts_with("CLI/")) return {};
  const std::string_view owner = path.starts_with("test/") ? path.substr(5) : path;
  for (const Library& library : kLibraries)
    if (include.starts_with(library.header) && owner != library.owner && !is_in(owner, library.owner))
      return "only " + std::string(library.owner) + " may use this library";
  return {};
}

std::string level_violation(std::string_view path, std::string_view include) {
  const std::optional<Folder> from = folder_of(path);
  const std::optional<Folder> to = folder_of(include);
  if (!from) return "the file is in none of the project's folders";
  if (from->name == "tasks" && to->name == "sim") return "a task must not see the plant, but in its cell";
  if (from->name == "launch" && to->name.starts_with("tasks")) return "launch must not know tasks";
  const int level = is_main(path) && from->level < kMainLevel ? kMainLevel : from->level;
  if (to->level > level) return std::string(from->name) + " is below " + std::string(to->name);
  if (level == kMainLevel || from->level > kMainLevel) return {};
  if (to->level == level && to->name != from->name && level != 1)
    return std::string(from->name) + " and " + std::string(to->name) + " are side by side";
  for (const Forbidden& pair : kForbidden)
    if (from->name == pair.from && to->name == pair.to)
      return std::string(pair.from) + " must not know " + std::string(pair.to);
  return {};
}

}  // namespace

std::string layer_violation(std::string_view path, std::string_view include, bool quoted) {
  std::string reason = library_violation(path, include);
  if (reason.empty() && folder_of(include)) reason = level_violation(path, include);
  if (reason.empty() && quoted && !folder_of(include))
    reason = "paths in quotation marks begin with a folder of the project";
  return reason.empty() ? "" : sentence(path, include, reason);
}

std::vector<std::string> on_circles(const Arrows& arrows) {
  // What is reached from each folder.
  Arrows reached = arrows;
  for (bool grown = true; grown;) {
    grown = false;
    for (auto& [from, targets] : reached) {
      std::set<std::string> more = targets;
      for (const std::string& to : targets)
        if (const auto next = reached.find(to); next != reached.end())
          more.insert(next->second.begin(), next->second.end());
      grown = grown || more.size() > targets.size();
      targets = std::move(more);
    }
  }
  std::vector<std::string> folders;
  for (const auto& [from, targets] : reached)
    if (targets.count(from) > 0) folders.push_back(from);
  return folders;
}

void add_arrow(Arrows& arrows, const std::string& path, const std::string& include) {
  if (is_main(path) || !folder_of(include) || include.starts_with("mrroc/")) return;
  const std::string from = path.substr(0, path.rfind('/'));
  const std::string to = include.substr(0, include.rfind('/'));
  if (from != to) arrows[from].insert(to);
}

std::string included_by(const std::string& line, bool& quoted) {
  std::string_view rest = line;
  const auto skip = [&rest](std::string_view word) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    if (!rest.starts_with(word)) return false;
    rest.remove_prefix(word.size());
    return true;
  };
  if (!skip("#") || !skip("include")) return {};
  quoted = skip("\"");
  if (!quoted && !skip("<")) return {};
  return std::string(rest.substr(0, rest.find(quoted ? '"' : '>')));
}

std::vector<std::filesystem::path> project_files(const std::filesystem::path& root) {
  static const std::array<std::string_view, 10> kinds{".hpp", ".cpp",   ".h",  ".in",   ".lcm",
                                                      ".txt", ".cmake", ".md", ".toml", ".json"};
  std::vector<std::filesystem::path> files{"run", ".ci/run"};
  for (auto entry = std::filesystem::recursive_directory_iterator(root); entry != decltype(entry)();
       ++entry) {
    const std::filesystem::path path = entry->path().lexically_relative(root);
    if (path == "build" || path == "runs" || path.filename().string().starts_with(".")) {
      if (entry->is_directory()) entry.disable_recursion_pending();
    } else if (std::count(kinds.begin(), kinds.end(), path.extension().string()) > 0) {
      files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace mrroc::test
