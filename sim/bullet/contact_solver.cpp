#include "sim/bullet/contact_solver.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace mrroc::sim {
namespace {

constexpr int kBaseFreedoms = 6;
/// Modes in which Bullet iterates otherwise than here.
constexpr int kForeign = SOLVER_USE_ARTICULATED_WARMSTARTING | SOLVER_DISABLE_IMPLICIT_CONE_FRICTION;
using Values = Eigen::Map<const Eigen::VectorXd>;
/// Return value of an iteration for Bullet to go on; the change of velocities matters only where a threshold
/// is set.
constexpr btScalar kGoOn = 1;

/// @return direction of the row's impulse on the first body, in the world
btVector3 direction(const btMultiBodySolverConstraint& row) {
  return row.m_multiBodyA ? row.m_contactNormal1 : -row.m_contactNormal2;
}

bool soft(const btManifoldPoint& point) {
  return (point.m_contactPointFlags & BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING) != 0;
}

}  // namespace

void ContactSolver::gather(btMultiBodyConstraintArray& constraints, Rows& rows) {
  const auto part = [](const btAlignedObjectArray<btScalar>& of, int from, int at, const btMultiBody* body) {
    if (!body) return Stretch{};
    int first = 0, end = body->getNumDofs() + kBaseFreedoms;
    while (end > first && of[from + end - 1] == 0) --end;
    while (first < end && of[from + first] == 0) ++first;
    return Stretch{first < end ? &of[from + first] : nullptr, at + first, end - first};
  };
  rows.clear();
  for (int k = 0; k < constraints.size(); ++k) {
    btMultiBodySolverConstraint& c = constraints[k];
    const auto of_both = [&](const btAlignedObjectArray<btScalar>& of) {
      return std::array{part(of, c.m_jacAindex, c.m_deltaVelAindex, c.m_multiBodyA),
                        part(of, c.m_jacBindex, c.m_deltaVelBindex, c.m_multiBodyB)};
    };
    rows.push_back({&c, of_both(m_data.m_jacobians), of_both(m_data.m_deltaVelocitiesUnitImpulse)});
    if (c.m_multiBodyA) c.m_multiBodyA->setPosUpdated(false);
    if (c.m_multiBodyB) c.m_multiBodyB->setPosUpdated(false);
  }
}

double ContactSolver::velocity(const Row& row) const {
  double sum = 0;
  for (const Stretch& jacobian : row.jacobian)
    if (jacobian.n > 0)
      sum +=
          Values(jacobian.values, jacobian.n).dot(Values(&m_data.m_deltaVelocities[jacobian.at], jacobian.n));
  return sum;
}

/// @return the impulse of the row that would satisfy it now, were it not bounded
double ContactSolver::wanted(const Row& row) const {
  const btMultiBodySolverConstraint& c = *row.of;
  return c.m_appliedImpulse + c.m_rhs - c.m_appliedImpulse * c.m_cfm - velocity(row) * c.m_jacDiagABInv;
}

void ContactSolver::apply(const Row& row, double impulse) {
  const double change = impulse - row.of->m_appliedImpulse;
  if (change == 0) return;
  row.of->m_appliedImpulse = impulse;
  for (const Stretch& response : row.response)
    if (response.n > 0)
      Eigen::Map<Eigen::VectorXd>(&m_data.m_deltaVelocities[response.at], response.n) +=
          change * Values(response.values, response.n);
}

void ContactSolver::solve(const Row& row) {
  apply(row, std::clamp<double>(wanted(row), row.of->m_lowerLimit, row.of->m_upperLimit));
}

/// Bullet shortens what both rows want by themselves. An arm has less inertia along one of them, so that what slips would
/// be pulled aside: here rows that slip take steps of one size, and come to rest where friction is against the slip.
/// @param limit  of the impulse along both directions together
void ContactSolver::solve_cone(const Row& a, const Row& b, double limit) {
  const double applied_a = a.of->m_appliedImpulse, applied_b = b.of->m_appliedImpulse;
  if (limit == 0 && applied_a == 0 && applied_b == 0) return;
  double next_a = wanted(a), next_b = wanted(b);
  if (next_a * next_a + next_b * next_b > limit * limit) {
    const double inertia_a = a.of->m_jacDiagABInv, inertia_b = b.of->m_jacDiagABInv;
    const double step = std::min(inertia_a, inertia_b);
    if (step > 0) {
      next_a = applied_a + step / inertia_a * (next_a - applied_a);
      next_b = applied_b + step / inertia_b * (next_b - applied_b);
    }
    const double size = std::hypot(next_a, next_b);
    if (size > limit) {
      next_a *= limit / size;
      next_b *= limit / size;
    }
  }
  apply(a, next_a);
  apply(b, next_b);
}

/// A spring and a damper along the surfaces: the row gives way by what the impulse is more than the spring's.
/// Bullet makes rows of friction that do not give way.
void ContactSolver::soften(const Row& friction, const ImpulseMemory::Contact& known, double h) {
  btMultiBodySolverConstraint& c = *friction.of;
  const btManifoldPoint& point = contact_point(c);
  if (!soft(point)) return;
  const double stiffness = shear_stiffness_ * point.m_combinedContactStiffness1;
  const double damping = shear_stiffness_ * point.m_combinedContactDamping1;
  const double yields = 1 / (h * (stiffness * h + damping));  // speed per impulse
  const double before = c.m_jacDiagABInv;
  c.m_jacDiagABInv = 1 / (1 / before + yields);
  c.m_cfm = yields * c.m_jacDiagABInv;
  c.m_rhs = c.m_rhs * c.m_jacDiagABInv / before + c.m_cfm * known.shear.dot(direction(c));
}

void ContactSolver::recall(double h) {
  for (const Row& row : joints_) apply(row, memory_.drive(*row.of));
  contacts_.clear();
  for (const Row& row : normals_) contacts_.push_back(row.of);
  memory_.recall(contacts_, known_);
  for (std::size_t k = 0; k < normals_.size(); ++k) apply(normals_[k], known_[k].pressed);
  for (const Row& row : frictions_) {
    if (row.of->m_jacDiagABInv == 0) continue;  // Bullet has switched it off: nothing moves along it
    const ImpulseMemory::Contact& known = known_[static_cast<std::size_t>(row.of->m_frictionIndex)];
    soften(row, known, h);
    apply(row, known.shear.dot(direction(*row.of)));
  }
}

void ContactSolver::memorise(double h) {
  for (const Row& row : joints_) memory_.keep_drive(*row.of);
  applied_.assign(normals_.size(), btVector3(0, 0, 0));
  for (const Row& row : frictions_)
    applied_[static_cast<std::size_t>(row.of->m_frictionIndex)] +=
        row.of->m_appliedImpulse * direction(*row.of);
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    const btMultiBodySolverConstraint& normal = *normals_[k].of;
    const btManifoldPoint& point = contact_point(normal);
    if (soft(point))
      memory_.keep_contact(normal, known_[k].shear,
                           {.stiffness = h * shear_stiffness_ * point.m_combinedContactStiffness1,
                            .most = normal.m_friction * normal.m_appliedImpulse});
    else
      memory_.keep_contact(normal, applied_[k], {});
  }
}

void ContactSolver::allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) {
  memory_.turn_page();
  btMultiBodyConstraintSolver::allSolved(info, drawer);
}

btScalar ContactSolver::solveSingleIteration(int iteration, btCollisionObject** bodies, int bodies_n,
                                             btPersistentManifold** manifolds, int manifolds_n,
                                             btTypedConstraint** constraints, int constraints_n,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) {
  if ((info.m_solverMode & SOLVER_USE_2_FRICTION_DIRECTIONS) == 0 || (info.m_solverMode & kForeign) != 0)
    return btMultiBodyConstraintSolver::solveSingleIteration(
        iteration, bodies, bodies_n, manifolds, manifolds_n, constraints, constraints_n, info, drawer);
  if (iteration == 0) {
    gather(m_multiBodyNonContactConstraints, joints_);
    gather(m_multiBodyNormalContactConstraints, normals_);
    gather(m_multiBodyFrictionContactConstraints, frictions_);
    if (shear_stiffness_ > 0) recall(info.m_timeStep);
  }
  const auto solve_row = [this](const Row& row) { solve(row); };
  if (iteration % 2 == 1)
    std::for_each(joints_.begin(), joints_.end(), solve_row);
  else
    std::for_each(joints_.rbegin(), joints_.rend(), solve_row);
  std::for_each(normals_.begin(), normals_.end(), solve_row);
  for (std::size_t k = 0; k + 1 < frictions_.size(); k += 2) {
    const btMultiBodySolverConstraint& c = *frictions_[k].of;
    const double pressed = normals_[static_cast<std::size_t>(c.m_frictionIndex)].of->m_appliedImpulse;
    solve_cone(frictions_[k], frictions_[k + 1], c.m_friction * pressed);
  }
  return kGoOn;
}

btScalar ContactSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int bodies_n,
                                                      const btContactSolverInfo& info) {
  if (shear_stiffness_ > 0) memorise(info.m_timeStep);
  const auto apply = [this](btMultiBody* body, int response, double impulse) {
    if (body) body->applyDeltaVeeMultiDof2(&m_data.m_deltaVelocitiesUnitImpulse[response], impulse);
  };
  for (Rows* rows : {&joints_, &normals_, &frictions_}) {
    for (const Row& row : *rows) {
      const btMultiBodySolverConstraint& c = *row.of;
      apply(c.m_multiBodyA, c.m_jacAindex, c.m_appliedImpulse);
      apply(c.m_multiBodyB, c.m_jacBindex, c.m_appliedImpulse);
    }
    rows->clear();
  }
  return btMultiBodyConstraintSolver::solveGroupCacheFriendlyFinish(bodies, bodies_n, info);
}

}  // namespace mrroc::sim
