// The plans that are built in.
#pragma once
#include <span>
#include <string_view>

#include "tasks/rex_drive/plan/plan_file.hpp"

namespace mrroc::rex_drive {

/// figure_eight: 4 x 2 m, two laps, a plan for each; the default.
/// corner: a quarter of a circle of 0.4 m between two straight legs.
/// slalom: four half waves around a line of 3.5 m, and back beside it.
/// square: 1.6 x 1.2 m, with turns on the spot.
/// pivot: a turn on the spot by 90 degrees between two legs of 1 m.
/// there_and_back: 1.5 m straight on, half a turn on the spot, and back.
[[nodiscard]] std::span<const std::string_view> built_in_plan_names();

/// @return whether it is one of them
[[nodiscard]] bool is_built_in(std::string_view plan);

/// @param name  one of built_in_plan_names() @throws std::out_of_range  of another one
[[nodiscard]] PlanList built_in_plan(std::string_view name);

}  // namespace mrroc::rex_drive
