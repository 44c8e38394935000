#include "ui_cli/new/tree.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/file_content.hpp"
#include "base/text_file.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

void check_writable(const fs::path& path) {
  if (access(path.c_str(), W_OK) == 0) return;
  throw FaultError(FaultCode::cannot_write, fmt::format("no right to write {}", path.string()),
                   "take a clone of your own, with --into DIR");
}

/// The folder itself, or the nearest one above it that is there.
fs::path existing(fs::path folder) {
  std::error_code ignored;
  while (!folder.empty() && !fs::exists(folder, ignored)) folder = folder.parent_path();
  return folder.empty() ? "." : folder;
}

/// Takes back what has been written when the rest cannot be.
class Undo {
 public:
  Undo() = default;
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() {
    std::error_code ignored;
    for (const fs::path& file : files_) fs::remove(file, ignored);
    for (const fs::path& folder : folders_) fs::remove(folder, ignored);  // the deepest come first
    for (const auto& [file, text] : texts_) std::ofstream(file) << text;
  }
  /// A file is going to be written, with the folders that it needs.
  void writes(const fs::path& file) {
    files_.push_back(file);
    std::vector<fs::path> made;
    for (fs::path f = file.parent_path(); !f.empty() && !fs::exists(f); f = f.parent_path())
      made.push_back(f);
    folders_.insert(folders_.begin(), made.begin(), made.end());
  }
  void changes(const fs::path& file, const std::string& before) { texts_.emplace_back(file, before); }
  /// All has been written.
  void forget() {
    files_.clear();
    folders_.clear();
    texts_.clear();
  }

 private:
  std::vector<fs::path> files_, folders_;
  std::vector<std::pair<fs::path, std::string>> texts_;
};

void write(const fs::path& file, const std::string& text) {
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  if (failed)
    throw FaultError(FaultCode::cannot_write,
                     fmt::format("{}: {}", file.parent_path().string(), failed.message()));
  write_text_file(file, text);
}

}  // namespace

bool is_tree(const fs::path& folder) {
  for (const char* part : {"robots", "tasks", "vsp", "test/robots", "test/tasks", "test/vsp"})
    if (!fs::is_regular_file(folder / part / "CMakeLists.txt")) return false;
  return fs::is_regular_file(folder / "run");
}

fs::path find_tree(const fs::path& into) {
  if (!into.empty()) {
    if (is_tree(into)) return fs::weakly_canonical(into);
    throw FaultError(FaultCode::bad_usage, fmt::format("{} is no clone of the framework", into.string()),
                     "give the folder that holds `run`, robots and tasks");
  }
  for (fs::path folder = fs::current_path();; folder = folder.parent_path()) {
    if (is_tree(folder)) return folder;
    if (folder == folder.root_path()) break;
  }
  throw FaultError(
      FaultCode::bad_usage, "there is no clone of the framework in or above the present folder",
      "go to the folder that holds `run`, or give it with --into DIR; for a task against the installed "
      "framework give --outside DIR");
}

void check_free(const fs::path& tree, const std::string& name) {
  const auto refuse = [&](const fs::path& file) {
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("the name '{}' has a meaning already, in {}", name,
                                 file.lexically_relative(tree).string()),
                     "take another name");
  };
  const std::regex target("(library\\(mrroc_|mrroc_program\\(|add_executable\\()" + name + "\\s");
  const std::regex function("\\b" + name + "\\(");  // names are identifiers
  for (const char* folder :
       {"base", "edp", "ecp", "mp", "vsp", "ui_cli", "robots", "tasks", "sim", "bench"}) {
    if (!fs::is_directory(tree / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(tree / folder)) {
      const fs::path& file = entry.path();
      const bool list = file.filename() == "CMakeLists.txt";
      const bool header = file.extension() == ".hpp" && file.parent_path() == tree / "base";
      if ((list || header) && std::regex_search(file_content(file), list ? target : function)) refuse(file);
    }
  }
}

void check_plan(const fs::path& tree, const ScaffoldPlan& plan) {
  std::error_code unknown;  // what must not be looked at cannot be written either
  for (const NewFile& file : plan.files)
    if (fs::exists(tree / file.path, unknown))
      throw FaultError(FaultCode::bad_usage, fmt::format("{} is there already", (tree / file.path).string()),
                       "take another name, or remove it first");
  for (const NewFile& file : plan.files) check_writable(existing((tree / file.path).parent_path()));
  for (const NewEntry& entry : plan.entries) {
    check_writable(tree / entry.list);
    check_writable((tree / entry.list).parent_path());
  }
}

void write_plan(const fs::path& tree, const ScaffoldPlan& plan) {
  Undo undo;
  for (const NewFile& file : plan.files) {
    undo.writes(tree / file.path);
    write(tree / file.path, file.text);
  }
  for (const NewEntry& entry : plan.entries) {
    const std::string before = file_content(tree / entry.list);
    undo.changes(tree / entry.list, before);
    write(tree / entry.list, with_entry(before, entry.folder));
  }
  undo.forget();
}

}  // namespace mrroc::ui
