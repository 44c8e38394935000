// Places to push in, for tests.
#pragma once
#include "tasks/box_push/pushes.hpp"

namespace mrroc::box_push {

inline Hall a_hall() {
  Hall hall;
  hall.room = {.lower = {-5, -4}, .upper = {5, 4}, .obstacles = {}};
  return hall;
}

}  // namespace mrroc::box_push
