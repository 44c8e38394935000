// The levels of the source tree: what a file may include (docs/architecture.md).
#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mrroc::test {

/// Whether an #include line keeps the levels
///   base < base/msg < base/link < {edp, ecp, mp, vsp, ui_cli} < {robots, tasks} < sim < tasks/NAME/cell < launch <
///   main*.cpp < test,
///   bench
/// and the rules about libraries. Pure.
/// @param path file from the repository root, e.g. "edp/shell.cpp"
/// @param include what stands between the quotation marks or brackets
/// @param quoted whether it stands between quotation marks
/// @return why it breaks them; empty when it keeps them
[[nodiscard]] std::string layer_violation(std::string_view path, std::string_view include,
                                          bool quoted = true);

/// To which other folders the files of each folder point with their #include lines.
using Arrows = std::map<std::string, std::set<std::string>>;

/// Adds the arrow of an #include line, if it is one between two folders of the project; mains join what they like.
/// @param path  of the file @param include  between its quotation marks
void add_arrow(Arrows& arrows, const std::string& path, const std::string& include);

/// @return the folders from which the arrows lead back to themselves
[[nodiscard]] std::vector<std::string> on_circles(const Arrows& arrows);

/// @param quoted set to whether the path stands between quotation marks
/// @return the path in an #include line of C++; empty if the line is another one
[[nodiscard]] std::string included_by(const std::string& line, bool& quoted);

/// @return all text files of the project below the root, as paths from it: no build trees, no runs
[[nodiscard]] std::vector<std::filesystem::path> project_files(const std::filesystem::path& root);

/// @return the lines of a file
[[nodiscard]] std::vector<std::string> lines_of(const std::filesystem::path& file);

}  // namespace mrroc::test
