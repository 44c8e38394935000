// The small tables, shared by all tests of the solvers.
#pragma once
#include <cstdlib>

#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik::test {

/// @return the folder of the tables: the build's, or what the environment says
inline const char* tables_folder() {
  const char* const other = std::getenv("MRROC_TEST_TABLES");
  return other ? other : MRROC_TEST_TABLES;
}

inline const Tables& small_tables() {
  static const Tables tables(TableSet::small, tables_folder(), 1);
  return tables;
}

inline const Bounds& small_bounds() {
  static const Bounds bounds(small_tables());
  return bounds;
}

}  // namespace mrroc::rubik::test
