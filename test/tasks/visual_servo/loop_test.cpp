#include <gtest/gtest.h>

#include "test/tasks/visual_servo/synthetic_cell.hpp"

namespace mrroc::visual_servo::test {
namespace {

void print(const SyntheticCell& cell) {
  if (!getenv("VS_PRINT")) return;
  for (std::size_t k = 0; k < cell.rows.size(); ++k) {
    const auto& r = cell.rows[k];
    printf("%3zu m%d %d%d true %.3f mm %.3f deg  e %.3f  d %.3f\n", k, r.m, r.sac, r.eih, r.true_mm,
           r.true_deg, 1e3 * r.e.p.norm(), 1e3 * r.T_dc.p.norm());
  }
}

TEST(Loop, Rest) {
  for (const Aggregation method : {Aggregation::mean, Aggregation::switching, Aggregation::weights}) {
    CellParameters p;
    p.k.aggregation = method;
    SyntheticCell cell(p);
    ASSERT_EQ(cell.run(), Outcome::terminated);
    print(cell);
    printf("start %.1f steps %d worst %.3f\n", cell.rows[0].true_mm, cell.steps_to(2), cell.worst_mm(50));
  }
}

TEST(Loop, Line) {
  CellParameters p;
  p.object = [](double t) { return object_at(1, -0.25 + 0.1 * std::clamp(t - 2, 0., 5.), 0.05); };
  SyntheticCell cell(p);
  ASSERT_EQ(cell.run(), Outcome::terminated);
  print(cell);
  printf("steps %d worst %.3f\n", cell.steps_to(2), cell.worst_mm(50));
}
}  // namespace
}  // namespace mrroc::visual_servo::test
