// Bullet's solver of contacts, faster, and able to begin with the impulses of the integration before.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include <array>
#include <vector>

#include "sim/bullet/impulse_memory.hpp"

namespace mrroc::sim {

/// The projected Gauss-Seidel iteration of btMultiBodyConstraintSolver with friction in two directions: the same rows
/// in the same order with the same bounds, so the same forces but for rounding, as long as nothing is remembered or
/// slips. What slips is held back against its slip, whatever inertia the bodies have along either direction; Bullet's
/// own pulls it aside. What is left out is zero: freedoms of fixed bases, friction where nothing presses
/// (docs/decisions.md). Bodies other than multi-bodies must not move. With friction in one direction, along both by
/// themselves, or Bullet's own warm start it is the solver of Bullet itself; friction against rolling is left out.
class ContactSolver final : public btMultiBodyConstraintSolver {
 public:
  /// From now on the iteration begins with the impulses of the integration before, not with none, as Bullet's own
  /// does: what changes slowly converges over the integrations. And surfaces of soft contacts give way along
  /// themselves, too, as rubber does, until friction does not hold them any more. Without effect where the solver is
  /// that of Bullet, see above.
  /// @param shear_stiffness  stiffness and damping along the surfaces, as a share of those along the normal; above 0
  void remember(double shear_stiffness) { shear_stiffness_ = shear_stiffness; }
  /// A body was made anew: the next integration begins with no impulses, of any body. What springs have borne along
  /// surfaces is gone.
  void forget() { memory_.forget(); }

  /// Once per integration, behind all islands: what they have left is remembered.
  void allSolved(const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 protected:
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int bodies_n,
                                btPersistentManifold** manifolds, int manifolds_n,
                                btTypedConstraint** constraints, int constraints_n,
                                const btContactSolverInfo& info, btIDebugDraw* drawer) override;
  /// Tells the bodies what changes their velocities, which Bullet's own solver does in each iteration.
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int bodies_n,
                                         const btContactSolverInfo& info) override;

 private:
  /// The part of a vector over the freedoms of a body that is not zero.
  struct Stretch {
    const double* values{};  ///< the first one; null: there is none
    int at{};                ///< its place among the velocities
    int n{};                 ///< how many there are
  };
  /// A constraint with its one or two bodies.
  struct Row {
    btMultiBodySolverConstraint* of{};  ///< Bullet's row, which keeps the impulse
    std::array<Stretch, 2> jacobian;    ///< of the constraint's velocity
    std::array<Stretch, 2> response;    ///< change of the bodies' velocities due to a unit impulse
  };
  using Rows = std::vector<Row>;

  void gather(btMultiBodyConstraintArray& constraints, Rows& rows);
  [[nodiscard]] double velocity(const Row& row) const;
  [[nodiscard]] double wanted(const Row& row) const;
  void apply(const Row& row, double impulse);
  void solve(const Row& row);
  void solve_cone(const Row& a, const Row& b, double limit);
  void recall(double h);
  void soften(const Row& friction, const ImpulseMemory::Contact& known, double h);
  void memorise(double h);

  double shear_stiffness_{};  // 0: nothing is remembered
  ImpulseMemory memory_;
  Rows joints_, normals_, frictions_;
  std::vector<const btMultiBodySolverConstraint*> contacts_;  // the normals, for the memory
  std::vector<ImpulseMemory::Contact> known_;                 // of each of them
  std::vector<btVector3> applied_;                            // friction of each of them, solved
};

}  // namespace mrroc::sim
