// The sheet of paper in front of an arm, and the ink on it.
#pragma once
#include <cstdint>
#include <vector>

#include "base/pose.hpp"

namespace mrroc::sim {

/// Table, paper and the contact of the pen with it.
struct PaperParameters {
  /// T_0P: pose of the sheet in the arm's base: origin at the sheet's centre on its surface, z up, x and y as
  /// on the drawing seen from above by someone behind the arm: x to the right (-y of the base), y away.
  Pose T_0P{(Matrix3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished(), Vector3(0.90, 0, 0.92)};
  double size{0.30};            ///< edge of the square sheet [m]; outside of it there is table, no ink
  double stiffness{1e4};        ///< of pen and paper in series [N/m]
  double damping_ratio{0.002};  ///< damping per stiffness [s]
  double friction{0.2};         ///< of the pen on the paper
  double new_stroke_height{
      1e-3};  ///< a pen that was higher than this above the paper begins a new stroke [m]
};

/// One sample of ink. Sheet coordinates in mm: origin at the centre, x right, y up, seen from above.
struct InkPoint {
  std::int32_t stroke{};  ///< from 0
  double t{};             ///< simulated time [s]
  double x{};             ///< [mm]
  double y{};             ///< [mm]
  double force{};         ///< normal force, mean over the step [N]
};

/// The ink that a pen leaves where, and only where, it touches the sheet; one sample per step of contact. A
/// bounce lower than new_stroke_height interrupts the ink but does not begin a new stroke.
class Ink {
 public:
  /// Begins with an empty sheet.
  explicit Ink(const PaperParameters& parameters);

  /// @param tip     pen tip in the arm's base [m]
  /// @param force   normal force, mean over the step [N]; 0: no contact
  /// @param t       simulated time [s]
  void step(const Vector3& tip, double force, double t);

  /// Takes a new sheet: no ink, strokes count from 0.
  void clear();

  /// @return all ink so far, in the order of time
  [[nodiscard]] const std::vector<InkPoint>& points() const { return points_; }

 private:
  PaperParameters parameters_;
  Pose T_P0_;
  std::vector<InkPoint> points_;
  std::int32_t stroke_{-1};
  bool lifted_{true};
};

}  // namespace mrroc::sim
