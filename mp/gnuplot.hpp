// Runs gnuplot as a child process.
#pragma once
#include <filesystem>

namespace mrroc::mp {

/// Result of a script.
enum class GnuplotResult {
  done,    ///< the script ran to its end
  absent,  ///< there is no gnuplot
  failed,  ///< gnuplot did not like the script; gnuplot.log beside it says why
  stopped  ///< allow_gnuplot(false) was called
};

/// Runs a script and waits for its end. What gnuplot prints goes to gnuplot.log beside the script.
/// One script at a time.
/// @param folder  where gnuplot runs, so that scripts can name files relative to it
/// @param script  relative to folder
[[nodiscard]] GnuplotResult run_gnuplot(const std::filesystem::path& folder,
                                        const std::filesystem::path& script);

/// Can be called from another thread than run_gnuplot().
/// @param now  false: the gnuplot that runs is killed, and no script runs from now on. True, the default: scripts run
void allow_gnuplot(bool now);

}  // namespace mrroc::mp
