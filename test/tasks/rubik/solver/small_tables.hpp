// The small tables, shared by all tests of the solvers.
#pragma once
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik::test {

inline const Tables& small_tables() {
  static const Tables tables(TableSet::small, MRROC_TEST_TABLES, 1);
  return tables;
}

inline const Bounds& small_bounds() {
  static const Bounds bounds(small_tables());
  return bounds;
}

}  // namespace mrroc::rubik::test
