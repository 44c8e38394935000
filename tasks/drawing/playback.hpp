// Reproduction of recorded nodes at a pace of task time between 0 and 1.
#pragma once
#include "base/pen_state.hpp"
#include "tasks/drawing/recording.hpp"

namespace mrroc::drawing {

/// The part of a recording that one macrostep of reproduction executes.
struct Advance {
  double p{};   ///< nodes executed after the macrostep
  double vx{};  ///< mean velocity along x of E in the macrostep [m/s]
  double vy{};  ///< along y [m/s]
};

/// @return whether nodes are left and the next one is (or is not) on the paper
/// @param p  nodes executed so far
bool next_node_is(const Recording& recording, double p, bool on_paper);

/// Executes a share of the recording: at pace 1 exactly one node, at a lower pace as much of it, so that the
/// path does not depend on the pace. Stops in front of the first node of the other kind.
/// @param p         nodes executed so far
/// @param pace      nodes per macrostep, 0..1
/// @param on_paper  whether nodes on the paper are executed, or those above it
Advance advance(const Recording& recording, double p, double pace, bool on_paper);

}  // namespace mrroc::drawing
