// Remembers the impulses of the integration before, with which the solver of contacts begins.
#pragma once
#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Featherstone/btMultiBodySolverConstraint.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mrroc::sim {

/// @return the point of contact that a row of it belongs to
inline const btManifoldPoint& contact_point(const btMultiBodySolverConstraint& row) {
  return *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
}

/// Impulses of drives and contacts. Bullet may find contacts anew in every integration: what was at a contact goes to
/// the nearest one of the same two links, and is forgotten where they touch no more. Two lists: of the integration
/// before, which is read, and of the present one. Same calls, same answers: nothing depends on addresses but equality.
class ImpulseMemory {
 public:
  /// Initial impulses of a contact.
  struct Contact {
    double pressed{};  ///< along the normal [N s]
    /// Along the surfaces, on the first body, in the world [N s]: of a spring what it bears without its damper.
    btVector3 shear{0, 0, 0};
  };
  /// What gives way along the surfaces of a contact: told by how far they have moved along each other.
  struct Spring {
    double
        stiffness{};  ///< of the surfaces, times the step of integration, always the same [N s/m]; 0: rigid
    double most{};    ///< of shear: coefficient of friction times what presses [N s]
  };

  /// @return the impulse of that drive's row, 0: not known [N s], [N m s]
  [[nodiscard]] double drive(const btMultiBodySolverConstraint& row) const;
  /// Several contacts that have become one give it the sum, of which friction keeps what that one can bear; one that
  /// has become several gives all to the nearest.
  /// May be called several times in an integration. @param normals  rows of contacts that are solved together
  /// @param known  of each of them, in the same order; zero where there was none
  void recall(std::span<const btMultiBodySolverConstraint* const> normals, std::vector<Contact>& known);

  /// For the next integration. @param row  solved
  void keep_drive(const btMultiBodySolverConstraint& row);
  /// @param normal  row of the contact, solved
  /// @param shear   on the first body, in the world [N s]: friction where the contact is rigid; of a spring what
  ///                recall() has given, which follows the bodies when it is recalled next
  /// @param spring  for the time until then
  void keep_contact(const btMultiBodySolverConstraint& normal, const btVector3& shear, const Spring& spring);
  /// The present integration is the one before from now on.
  void turn_page();
  /// Drives and contacts are others from now on: a body was made anew.
  void forget();

 private:
  struct Drive {
    const btMultiBodyConstraint* of;
    int row;
    double impulse;
  };
  struct Place {
    const btMultiBody *a, *b;
    int link_a, link_b;
    btVector3 on_a, on_b;  // the same point in the frames of the links, of the world where there is none [m]
  };
  struct Kept {
    Place place;
    double pressed;
    btVector3 shear;  // in the frame of the first link
    Spring spring;
  };
  struct Page {
    std::vector<Drive> drives;
    std::vector<Kept> contacts;
  };
  static Place place_of(const btMultiBodySolverConstraint& normal);

  Page before_, now_;
  std::vector<Place> here_;
};

}  // namespace mrroc::sim
