// The errors that the task adds to the framework's table.
#pragma once
#include <array>

#include "base/fault.hpp"

namespace mrroc::ball {

inline constexpr FaultCode kObjectTooHeavy{kFirstTaskFault + 4};
inline constexpr FaultCode kObjectNotAsTold{kFirstTaskFault + 5};
inline constexpr FaultCode kObjectLost{kFirstTaskFault + 6};
inline constexpr FaultCode kObjectCrushed{kFirstTaskFault + 7};

// clang-format off
/// Their rows of the table of errors.
inline constexpr std::array kFaults{
    FaultEntry{kObjectTooHeavy, "object_too_heavy", FaultClass::non_fatal, "the inner force cannot hold the object by friction", "take a lighter or rougher object, or press with more where task.force (60 N at most) and what the object bears (task.most_force) allow it",
               "an object heavier or smoother than it is told; a force that is too small for it"},
    FaultEntry{kObjectNotAsTold, "object_not_as_told", FaultClass::non_fatal, "the distance of the palms is not the size of the object", "set free_body.size to what the object has, or look at where it stands",
               "an object of another size; none between the palms, or one that does not stand there; a palm that met something else"},
    FaultEntry{kObjectLost, "object_lost", FaultClass::non_fatal, "nothing is between the palms any more, or it slides", "look for the object and put it on its pedestal; take a rougher or lighter one, or press with more where task.force (60 N at most) and what the object bears (task.most_force) allow it",
               "palms or an object smoother than it is told; somebody took the object away; an arm was pushed hard"},
    FaultEntry{kObjectCrushed, "object_crushed", FaultClass::non_fatal, "the palms pressed on the object with more than it bears", "look at the object, and at what pushed the arms towards each other",
               "a person who pushed both arms together; a force sensor that reads too little; task.most_force too small"},
};
// clang-format on
inline const RegisteredFaults kRegisteredFaults{kFaults};

}  // namespace mrroc::ball
