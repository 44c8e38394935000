// The contact loop of edp/stability.hpp as a linear map of its state from step to step.
#pragma once
#include <Eigen/Dense>

#include "edp/compensating_regulator.hpp"
#include "edp/stability.hpp"

namespace mrroc::edp {

/// Continuous motion of the tip: s' = A s + b input, with the tip at position s[x] moving at dx s + dx_input
/// input. The input is the set velocity, of a drive its duty cycle.
struct TipPlant {
  Eigen::MatrixXd A;   ///< of the state
  Eigen::VectorXd b;   ///< of the input
  int x{};             ///< number of the tip's position in the state
  int motor{};         ///< of what the encoder reads; the tip's, unless gears give way
  Eigen::VectorXd dx;  ///< the tip's velocity, of the state
  double dx_input{};   ///< and of the input
};

/// The loop as a map of its state from step to step. The map is linear, so its matrix is what it makes of the
/// unit vectors. Forces in it are per stiffness: numbers of one size let the eigenvalues be found exactly.
class ContactMap {
 public:
  /// @param K  stiffness of the contact [N/m]
  ContactMap(const ContactLoop& loop, double K);

  /// @return numbers of the state
  [[nodiscard]] int size() const { return size_; }
  /// @return the map without a desired force
  [[nodiscard]] Eigen::MatrixXd matrix() const;
  /// @param force  F_d of law (28) [N]; a desired velocity v_d counts as the force v_d / B
  [[nodiscard]] Eigen::VectorXd step(Eigen::VectorXd s, double force) const;
  /// @param s  state @return place of the tip [m]
  template <class State>
  [[nodiscard]] double position(const State& s) const {
    return s[plant_.x];
  }
  /// @param s  state @return newest reading of the force over the stiffness [m]
  template <class State>
  [[nodiscard]] double reading(const State& s) const {
    return s[n_];
  }

 private:
  ContactLoop loop_;
  CompensationGains gains_{};
  double K_, D_;
  double unit_;  // a reading is the force over it [N/m]; K, unless the inertia of a tool is measured, too
  Eigen::VectorXd felt_;  // present reading, of the plant's state
  double felt_input_{};   // and of its input
  TipPlant plant_;
  int n_{}, history_{}, size_{};
  Eigen::MatrixXd over_step_;
};

}  // namespace mrroc::edp
