// Drives of the platform's task, and the figures that are made of them.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/figures.hpp"

namespace mrroc::bench {

using Arguments = std::vector<std::string>;         ///< of a program
using Summaries = std::span<const nlohmann::json>;  ///< summary.json of runs

/// A run of the platform's task to its end.
struct RexDrive {
  std::uint32_t seed{1};
  Arguments more{};    ///< further arguments
  std::string plan{};  ///< lines of a plan of its own; empty: none
  bool eyes{};         ///< the platform has cameras
  bool timed{};  ///< its time is measured: it has the machine for itself, and its processes are separate ones
};

/// A part of the group rex.
struct RexPart {
  std::vector<RexDrive> drives;
  std::function<Figures(Summaries)> figures;  ///< of the summaries of its drives, in their order
};

/// Runs all drives: first those whose time is measured, one after another; then all others several at a time, each in one
/// process. The bits of a run depend neither on the processes nor on what runs beside it. Tells on the standard error how far
/// it is.
/// @return figures of all parts, in their order
/// @throws FaultError start_failed, peer_silent; internal_error: a run left no summary; what the parts throw
Figures figures_of(const std::vector<RexPart>& parts);

/// Trackers and estimators of the platform against each other on three grounds.
/// @param plots  folder for the picture algorithms.png and its table; empty: none
/// @return the part; its figures throw FaultError cannot_write, internal_error
[[nodiscard]] RexPart rex_algorithms(const std::filesystem::path& plots);

/// What the platform's eyes are good for: drives with cameras, with and without the map.
[[nodiscard]] RexPart rex_eyes();

/// @return whether the run did what it should
[[nodiscard]] bool done(const nlohmann::json& summary);

/// @return both, one behind the other
[[nodiscard]] Arguments operator+(Arguments a, const Arguments& b);

/// Seeds of a figure that is the worst of several.
inline constexpr std::size_t kSeeds = 5;
/// Adds drives of seeds 1 to `count`. @param like  all of them are like this one
void add_seeds(std::vector<RexDrive>& drives, const RexDrive& like, std::size_t count = kSeeds);
/// @return the runs that add_seeds() has added as the k-th, from 0
[[nodiscard]] Summaries seeds(Summaries runs, std::size_t k);

/// What a figure is that a run does not have.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
/// @return a figure of the run, or kNotMeasured @throws FaultError internal_error: it did not end well
[[nodiscard]] double figure(const nlohmann::json& summary, const std::string& key);
/// @return the largest of the runs' figures; kNotMeasured when one of them has none @throws as figure()
[[nodiscard]] double most(Summaries runs, const std::string& key);
/// The smallest one.
[[nodiscard]] double least(Summaries runs, const std::string& key);
/// @return median of the real time factors
[[nodiscard]] double pace(Summaries runs);

}  // namespace mrroc::bench
