// Configuration and options of a run, known before anything starts.
#pragma once
#include <vector>

#include "base/config.hpp"
#include "launch/cell_nodes.hpp"
#include "mp/options.hpp"

namespace mrroc::launch {

/// Configuration and options of one run.
struct Setup {
  Config config;              ///< the task's, the user's, and what the task has found out
  std::vector<CellArm> arms;  ///< of the run: the task's, and those that the configuration adds
  mp::TaskOptions options;    ///< of the command line; the seed is that of the configuration
};

}  // namespace mrroc::launch
