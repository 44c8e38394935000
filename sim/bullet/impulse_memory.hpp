// What the solver of contacts begins with: the impulses of the integration before.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodySolverConstraint.h>

#include <cstddef>
#include <vector>

namespace mrroc::sim {

/// Impulses of drives and contacts. Contacts are known again by their bodies and by where they are on one of them,
/// since Bullet may find them anew in every integration; what acts along their surfaces turns with the first body.
/// Two lists: of the integration before, which is read, and of the present one. Same calls, same answers: nothing
/// depends on addresses but equality.
class ImpulseMemory {
 public:
  /// What was at a contact. Of friction that gives way only what its spring bears: the damper has forgotten the rest.
  struct Contact {
    double pressed{};          ///< along the normal [N s]
    btVector3 shear{0, 0, 0};  ///< along the surfaces, on the first body, in the world [N s]
  };

  /// @return the impulse of that drive's row, 0: not known [N s], [N m s]
  [[nodiscard]] double drive(const btMultiBodySolverConstraint& row) const;
  /// @param normal  row of the contact @return what was there; nothing where no contact was
  [[nodiscard]] Contact contact(const btMultiBodySolverConstraint& normal) const;

  /// For the next integration. @param row  solved
  void keep_drive(const btMultiBodySolverConstraint& row);
  /// @param normal  row of the contact, solved  @param shear  as in Contact
  void keep_contact(const btMultiBodySolverConstraint& normal, const btVector3& shear);
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
    btVector3 on_a, on_b;  // in the frames of the links [m]
    Contact contact;
  };
  struct Page {
    std::vector<Drive> drives;
    std::vector<Place> places;
  };
  static Place place_of(const btMultiBodySolverConstraint& normal);

  Page before_, now_;
};

}  // namespace mrroc::sim
