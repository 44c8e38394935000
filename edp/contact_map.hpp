// The contact loop of edp/stability.hpp as a linear map of its state from step to step.
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "edp/compensating_regulator.hpp"
#include "edp/stability.hpp"

namespace mrroc::edp {

/// Continuous motion of the tip: s' = A s + B input, with the tip at x s moving at dx s + dx_input input. The input is
/// the set velocity, of drives their duty cycles.
struct TipPlant {
  Eigen::MatrixXd A;         ///< of the state
  Eigen::MatrixXd B;         ///< of the inputs
  Eigen::VectorXd x;         ///< the tip's position [m], of the state
  Eigen::VectorXd dx;        ///< its velocity, of the state
  Eigen::VectorXd dx_input;  ///< and of the inputs
  double felt{1};            ///< share of the contact's force that the law feels
  Eigen::MatrixXd encoders;  ///< what they read [increments], of the state; no row: a servo without a drive
  Eigen::VectorXd set;       ///< set motion of each [increments] per way of the tip [m]
  Eigen::VectorXd
      tool{};  ///< force that accelerates what is beyond the sensor [N], of the state; empty: none
  Eigen::VectorXd tool_input{};  ///< and of the inputs
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
    return plant_.x.dot(s.head(n_));
  }
  /// @param s  state @return newest reading of the force over the stiffness [m]
  template <class State>
  [[nodiscard]] double reading(const State& s) const {
    return s[n_];
  }

 private:
  [[nodiscard]] Eigen::VectorXd inputs(Eigen::VectorXd& s, double velocity) const;

  ContactLoop loop_;
  std::vector<CompensationGains> gains_;  // of each motor that has such a regulator
  double unit_;  // a reading is the force over it [N/m]; K, unless the inertia of a tool is measured, too
  TipPlant plant_;
  Eigen::VectorXd felt_;        // present reading, of the plant's state
  Eigen::VectorXd felt_input_;  // and of its inputs
  int n_{}, history_{}, size_{};
  Eigen::MatrixXd over_step_;
};

}  // namespace mrroc::edp
