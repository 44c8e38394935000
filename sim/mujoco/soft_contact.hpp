// Parameters of MuJoCo's contacts for a stiffness and a damping in newtons.
#pragma once
#include <algorithm>

namespace mrroc::sim {

/// MuJoCo knows a contact as an acceleration that it asks for, and a resistance R [1/kg] to being pushed:
/// R f = a_ref - a, a_ref = -damping v - stiffness r. With R = 1/(K h^2 + B h) this is a spring K with a damper B that an
/// integration of h takes implicitly, at its end, as Bullet does. R comes from an impedance d and the inverse mass that
/// MuJoCo has for both bodies: R = inverse_mass (1 - d)/d.
struct SoftContact {
  double impedance{};   ///< d, the same at every depth
  double stiffness{};   ///< as solref has it directly, for that d
  double damping{};     ///< the same
  double resistance{};  ///< R [1/kg]
};

/// @param stiffness     K [N/m], > 0 @param relaxation  damping B over stiffness [s] @param h  integration step [s]
/// @param inverse_mass  mj_model.body_invweight0 of both bodies together [1/kg], > 0
[[nodiscard]] inline SoftContact soft_contact(double stiffness, double relaxation, double h,
                                              double inverse_mass) {
  constexpr double kLeast = 1e-4, kMost = 0.9999;  // MuJoCo's own limits of d
  const double damping = stiffness * relaxation;
  const double wanted = 1 / (h * (stiffness * h + damping));
  SoftContact c;
  c.impedance = std::clamp(inverse_mass / (inverse_mass + wanted), kLeast, kMost);
  c.resistance = inverse_mass * (1 - c.impedance) / c.impedance;
  // MuJoCo divides what solref says by d.
  c.stiffness = c.impedance * c.resistance * stiffness;
  c.damping = c.impedance * c.resistance * (damping + stiffness * h);
  return c;
}

}  // namespace mrroc::sim
