// Cost of the kinematics, measured by Google Benchmark.
#pragma once
#include <map>
#include <string>

namespace mrroc::bench {

/// Runs the registered benchmarks.
/// @return median time of one call [ns] by the benchmark's name, e.g. "inverse_kinematics/0"; the number is 0
///         for the arm on the pedestal, 1 for the arm on the track
std::map<std::string, double> run_kinematics_benchmarks();

}  // namespace mrroc::bench
