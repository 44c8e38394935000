// Draws the pictures of a run.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mrroc::mp {

/// Draws scripts as plots/NAME.png, and says so when gnuplot cannot. The scripts stay beside them in any case.
/// @param folder   of the run, with the tables
/// @param scripts  by their names; gnuplot runs them in the run folder, and each writes plots/NAME.png
/// @param scripts_only  gnuplot is not run
void draw(const std::filesystem::path& folder,
          const std::vector<std::pair<std::string, std::string>>& scripts, bool scripts_only = false);

/// @return the PNG files of a run folder and of its plots/, in alphabetical order, the folder's own first
[[nodiscard]] std::vector<std::filesystem::path> pictures_in(const std::filesystem::path& folder);

}  // namespace mrroc::mp
