// The parts of a new robot, platform, task or sensor: files made from templates, and the lines that make them known to
// the build. Nothing here reads or writes a file.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace mrroc::ui {

/// Kinds of things that `ui_cli new` makes.
enum class NewPart : std::uint8_t { robot, platform, task, sensor };

/// @return "robot", "platform", "task" or "sensor"
[[nodiscard]] std::string_view to_string(NewPart part);

/// The user's order.
struct Scaffold {
  NewPart part{};                       ///< what is made
  std::string name;                     ///< see check_new_name()
  std::string robot{"irb6_postument"};  ///< of a task: its arm, as in [robots.ARM] model
  std::string sensor{};                 ///< of a task: its virtual sensor; empty: none
  bool hardware{};                      ///< of a robot: a seam to drives of its own, hardware.cpp
  bool coordinated{};                   ///< of a task: two arms, and a coordinator with behaviours of its own
  bool outside{};                       ///< of a task: a project of its own, against the installed framework
};

/// A file to be written.
struct NewFile {
  std::filesystem::path path;  ///< below the tree
  std::string text;            ///< all of its content
};

/// A line to be added to a CMakeLists.txt that is there.
struct NewEntry {
  std::filesystem::path list;  ///< below the tree
  std::string folder;          ///< for add_subdirectory
};

/// All that has to be done, and what the user may do then.
struct ScaffoldPlan {
  std::vector<NewFile> files;     ///< none of them exists yet
  std::vector<NewEntry> entries;  ///< in lists that exist
  std::vector<std::string> next;  ///< commands
};

/// @throws FaultError bad_usage  the name is no lower-case identifier, a word of C++, or one that the framework uses
void check_new_name(const std::string& name);

/// @return what has to be written for it. A robot comes with a task of the same name that moves it
[[nodiscard]] ScaffoldPlan plan_scaffold(const Scaffold& scaffold);

/// @return name in the way of types: probe_arm gives ProbeArm
[[nodiscard]] std::string type_name(std::string_view name);

/// @param list  text of a CMakeLists.txt
/// @return the same with add_subdirectory(folder) behind the last such line, or at its end
[[nodiscard]] std::string with_entry(const std::string& list, const std::string& folder);

}  // namespace mrroc::ui
