// The search for the place where two arms turn faces of a cube: how the cell's place (tasks/rubik/cell/layout.hpp) is found.
#pragma once
#include <cstdint>

#include "tasks/rubik/plan/cell.hpp"

namespace mrroc::bench {

/// A place where arms might meet.
struct MeetingCandidate {
  rubik::Meeting
      meeting;       ///< `joints` as the front grips of both hands need them: the branches that are meant
  double reach{-1};  ///< see meeting_reach(); negative: beyond a limit, or one arm does not come there
};

/// @param cell     two arms; its own meeting place does not matter
/// @param meeting  the place, and joints near those that are meant
/// @return the least margin of all postures: distance from a limit of a joint or motor as a share of half its range, or
///         2 (1 - |cos q5|), which is 0 in the wrist's singularity. Over the front grips of both hands in four positions
///         a quarter turn apart, drawn back by kRetreatDistance too, and a grip of the track arm from the best side of
///         the cube. Negative: out of reach
[[nodiscard]] double meeting_reach(const rubik::PlanCell& cell, const rubik::Meeting& meeting);

/// @return whether both hands may hold a cube there, in all quarter turns of either, without any other touch
[[nodiscard]] bool meeting_is_free(const rubik::PlanCell& cell, const rubik::Meeting& meeting);

/// Draws places between the arms, directions, turns about them and positions of the track, then betters the best ones
/// step by step. The same arguments give the same answer.
/// @param candidates  number of draws, > 0
/// @return the best one whose grips are free of collisions; paths to it are the planner's matter
[[nodiscard]] MeetingCandidate search_meeting(const rubik::PlanCell& cell, int candidates,
                                              std::uint64_t seed);

}  // namespace mrroc::bench
