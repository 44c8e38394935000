// Compares the pen states of a drawing, as memorised or drawn, with the ink: uses the truth of the
// simulation, for figures only.
#pragma once
#include <vector>

#include "mp/arm_trace.hpp"
#include "tasks/drawing/ink.hpp"
#include "tasks/drawing/recording.hpp"

namespace mrroc::drawing {

/// A time in which the pen is said to be on the paper [s].
struct PaperTime {
  double begin{};
  double end{};
};

/// @param node_t  when each node ended [s], one per node
/// @return the runs of nodes that were memorised as Paper surface
[[nodiscard]] std::vector<PaperTime> paper_times(const Recording& recording,
                                                 const std::vector<double>& node_t);
/// @return the runs of m = 5 of an arm's trace
[[nodiscard]] std::vector<PaperTime> paper_times(const mp::ArmTrace& trace);

/// A stroke of ink is right when one time on the paper, which no other stroke shares, holds it, and no ink of it that
/// was left before or after is farther than kStrayDistance from where the pen was then. @return strokes of ink that are not right, and times on the paper without ink
[[nodiscard]] int wrong_strokes(const Ink& ink, const std::vector<PaperTime>& said);

}  // namespace mrroc::drawing
