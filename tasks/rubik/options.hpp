// The command line's options for the cube.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::rubik {

/// The options --scramble, --state and --eyes.
struct CubeOptions {
  std::optional<std::string>
      scramble;                      ///< turns; none: the configuration says, or 20 random ones by the seed
  std::optional<std::string> state;  ///< 54 facelets; none: the same
  std::optional<std::string>
      eyes{};  ///< how the state becomes known: camera (unless given), or none: it is told
};

/// Adds the options to a program's command line.
void add_cube_options(CommandLine& line, CubeOptions& options);

/// @return KEY=VALUE of what the options say of the cube, over every file; empty: they say nothing
/// @throws FaultError bad_usage
[[nodiscard]] std::vector<std::string> cube_settings(const CubeOptions& options);

/// Scrambles the cube by the seed, unless a file or a setting says what it looks like.
void complete_cube(Config& config);

}  // namespace mrroc::rubik
