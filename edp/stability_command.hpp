// The command `ui_cli stability`: tells which contacts are stable under law (28), and what to change.
#pragma once
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "edp/stability.hpp"

namespace mrroc::edp {

/// @param loop       with a LagServo or an IdealServo
/// @param stiffness  that the user asks about [N/m]; absent: no verdict on one
/// @return table of damping over stiffness and sentences: what is stable, and what to change. For people
/// @throw FaultError out_of_limits
[[nodiscard]] std::string stability_report(const ContactLoop& loop, std::optional<double> stiffness);

/// @return the same figures as one JSON object: limit_N_per_m (null: none), and with a stiffness stable,
///         damping_ratio, frequency_Hz, B_for_damping_0.5
/// @throw FaultError out_of_limits
[[nodiscard]] std::string stability_json(const ContactLoop& loop, std::optional<double> stiffness);

/// @return lines "I B limit", blocks of equal I apart, for gnuplot: I 0.5..50 kg, B 0.0005..0.05 s/kg
/// @throw FaultError out_of_limits
[[nodiscard]] std::string stability_map(ContactLoop loop);

/// Runs the command. @param arguments behind the word stability @return exit status: 0, or 2 for bad usage
int run_stability(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::edp
