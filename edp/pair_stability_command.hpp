// The command `ui_cli stability --pair`: tells which wall a pair of master and slave bears, before anything moves.
#pragma once
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "edp/pair_stability.hpp"

namespace mrroc::edp {

/// @param stiffness  of the wall that the user asks about [N/m]; absent: no verdict on one
/// @return sentences: the largest wall that is stable, and by how much delay it falls. For people
/// @throw FaultError out_of_limits
[[nodiscard]] std::string pair_report(const PairLoop& pair, std::optional<double> stiffness);

/// @return the same as one JSON object: limit_N_per_m (null: none up to kStiffestWall), colgate_N_per_m, and with a stiffness
///         stable
/// @throw FaultError out_of_limits
[[nodiscard]] std::string pair_json(const PairLoop& pair, std::optional<double> stiffness);

/// Runs the command. @param arguments behind the word stability @return exit status: 0, or 2 for bad usage
int run_pair_stability(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::edp
