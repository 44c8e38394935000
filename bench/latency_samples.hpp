// Computes the time from a key to its effect from a driver's record of every step.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mrroc::bench {

/// One line of the driver's record of every step.
struct Step {
  std::int64_t k{};             ///< number of the step
  std::string state{};          ///< of the driver
  std::array<double, 3> set{};  ///< set position of E [m]
};

inline constexpr double kStep = 0.002;      ///< [s]
inline constexpr double kMacrostep = 0.02;  ///< [s]

/// @param file  ARM-steps.csv of a run folder @return its lines, broken ones left out
[[nodiscard]] std::vector<Step> read_steps(const std::filesystem::path& file);

/// @return speed of the set position from one step to the next [m/s]
[[nodiscard]] double speed(const Step& a, const Step& b);

/// Whether a step is as the key wants it.
using Wanted = std::function<bool(const Step& before, const Step& now)>;

/// The latency that one press of a key has shown.
struct Latency {
  /// How the sample came about.
  enum class Kind : std::uint8_t {
    /// The key had an effect, and macrosteps says when.
    measured,
    nothing_to_see,  ///< the arm was as wanted already when the key was pressed: the sample is none
    never,           ///< it was not as wanted within kLongest: the key had no effect
  };
  Kind kind{};          ///< decides whether macrosteps counts
  double macrosteps{};  ///< from the key to the first step that is as wanted; of a measured one only
};

/// A reaction after more than that is not the key's effect but the end of the behaviour [macrosteps].
inline constexpr double kLongest = 20;

/// @param steps    all of the run, one after the other
/// @param pressed  step that was executed when the key was pressed, with its fraction
[[nodiscard]] Latency latency(const std::vector<Step>& steps, double pressed, const Wanted& wanted);

/// @return whether there is a step from the first to the second number, both in steps, that is not as wanted
[[nodiscard]] bool is_undone(const std::vector<Step>& steps, double from, double to, const Wanted& wanted);

}  // namespace mrroc::bench
