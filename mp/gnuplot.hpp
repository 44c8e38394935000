// Runs gnuplot as a child process.
#pragma once
#include <filesystem>

namespace mrroc::mp {

/// What became of a script.
enum class GnuplotResult {
  done,    ///< the script ran to its end
  absent,  ///< there is no gnuplot
  failed   ///< gnuplot did not like the script; gnuplot.log beside it says why
};

/// Runs a script and waits for its end. What gnuplot prints goes to gnuplot.log beside the script.
/// @param folder  where gnuplot runs, so that scripts can name files relative to it
/// @param script  relative to folder
[[nodiscard]] GnuplotResult run_gnuplot(const std::filesystem::path& folder,
                                        const std::filesystem::path& script);

}  // namespace mrroc::mp
