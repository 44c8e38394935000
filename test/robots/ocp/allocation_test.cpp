// Nothing that is called in an iteration goes to the heap.
#include <gtest/gtest.h>

#include <random>

#include "robots/ocp/ocp_qp.hpp"
#include "test/heap.hpp"
#include "test/robots/ocp/random_qp.hpp"

namespace mrroc::ocp {
namespace {

TEST(OcpQpAllocation, HappensInTheConstructorOnly) {
  std::mt19937 random(21);
  std::vector<Stage> stages = mrroc::test::equal_stages(20, 10, 4, true);
  for (Stage& s : stages)
    if (s.n_u > 0) s.bounded_u = {0, 1, 2, 3};
  OcpQp qp(stages, 60);
  const mrroc::test::QpData problem = mrroc::test::random_qp(stages, random);
  Eigen::Matrix<double, 10, 1> x;
  Eigen::Vector4d u;
  bool ok = true;
  const mrroc::test::AllocationCounter counter;
  set(qp, problem);
  ok = qp.solve().ok() && qp.x(20, x) && qp.u(0, u);
  qp.cost(99, {}, {}, {}, {}, {});
  ok = ok && qp.solve().status == QpStatus::bad_data;
  EXPECT_EQ(counter.count(), 0);
  EXPECT_TRUE(ok);
}

}  // namespace
}  // namespace mrroc::ocp
