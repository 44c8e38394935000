// What a task prints when it has ended.
#pragma once
#include <string>

#include "mp/run_folder.hpp"

namespace mrroc::mp {

/// Prints how the run ended and how long it took to standard output.
/// @param figures  lines that follow, see figure_table()
void print_summary(const Summary& summary, const std::string& figures);

}  // namespace mrroc::mp
