// The clone of the framework into which `ui_cli new` writes.
#pragma once
#include <filesystem>
#include <string>

#include "ui_cli/new/scaffold.hpp"

namespace mrroc::ui {

/// @return whether a folder is the root of a clone of the framework
[[nodiscard]] bool is_tree(const std::filesystem::path& folder);

/// @param into  what the user has given; empty: the present folder or one above it that is a clone
/// @return root of the clone
/// @throws FaultError bad_usage  there is none
[[nodiscard]] std::filesystem::path find_tree(const std::filesystem::path& into);

/// @throws FaultError bad_usage  a target of the build or a function of namespace mrroc in the clone has that name
void check_free(const std::filesystem::path& tree, const std::string& name);

/// Looks whether everything can be written. @param tree  root under which the plan's paths lie
/// @throws FaultError bad_usage  a file of the plan is there already; cannot_write
void check_plan(const std::filesystem::path& tree, const ScaffoldPlan& plan);

/// Writes everything, or nothing. @throws FaultError cannot_write
void write_plan(const std::filesystem::path& tree, const ScaffoldPlan& plan);

}  // namespace mrroc::ui
