// How far predictions of the whole arm's limits err, over random contacts, in both engines and with elastic gears.
#pragma once
#include <filesystem>

#include "bench/figures.hpp"

namespace mrroc::bench {

/// 100 random contacts each: in Bullet, in MuJoCo where this build has it, and in Bullet with elastic gears. Errors are of
/// the gain B, the 95th percentile and the median.
/// @param plots folder for the picture stability_arm.png, its table and script; empty: none
[[nodiscard]] Figures arm_limit_figures(const std::filesystem::path& plots);

}  // namespace mrroc::bench
