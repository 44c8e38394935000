// Virtual sensor of a pen: the automaton of MS fig. 3 over pose and force, one per arm.
#pragma once
#include <array>

#include "base/effector_command.hpp"
#include "base/pen_state.hpp"
#include "base/transmission.hpp"

namespace mrroc::vsp {

/// Thresholds of the automaton. Under law (28) F_a equals F_d whenever the arm is at rest, in the air and on
/// paper alike: only transients, height and its rate tell the states apart.
struct PenStateParameters {
  double dt{0.002};              ///< duration of a step [s]
  double v_filter{0.020};        ///< time constant for the pen's velocity along its axis [s]
  double F_filter{0.006};        ///< time constant for the force along it [s]
  double lowering_speed{0.005};  ///< A: the pen moves to the paper faster than this [m/s]
  double braked_speed{0.003};    ///< lowering ends without impact when the pen rises faster than this [m/s]
  double rest_speed{
      0.0015};            ///< or when it is slower than this for rest_time, which must be once before A [m/s]
  double rest_time{0.5};  ///< [s]
  double impact_force{1.25};    ///< B: the force rises by more than this ... [N]
  double impact_time{0.020};    ///< ... within this time [s], at most 0.1 s
  double rest_force{1.2};       ///< or B, a soft landing: at rest with more than this ... [N]
  double rest_force_time{0.2};  ///< ... for this time [s]; in the air F_a would have gone to zero
  double settling_time{0.3};    ///< no lift-off before this time after an impact: the pen bounces [s]
  double paper_filter{0.3};     ///< time constant with which the height of the paper is followed [s]
  double sink_depth{0.001};     ///< a pen that sinks faster than lowering_speed, and so far below the paper,
                                ///< has not touched it: lowering goes on [m]
  double lift_height{0.0006};   ///< C: the pen is higher than this above the paper ... [m]
  double lift_speed{0.004};     ///< ... and rises faster than this [m/s]
  double pull_force{4.0};       ///< or C: the pen is pulled off with more than this [N]
};

/// The automaton Above paper -A-> Lowering -B-> Paper surface -C-> Lift-off -D-> Above paper (MS 27, 28). The
/// state is its memory. A touch that was none goes back to Lowering. D follows at once, in the next step; the timed lift-off is a behaviour of the task.
class PenStateSensor {
 public:
  /// Begins above the paper.
  explicit PenStateSensor(const PenStateParameters& parameters = {});

  /// Takes the reading of one step; one that is none (not finite, impossible) is passed over. Real-time safe.
  void step(const StepSample& sample);

  /// @return reading of the macrostep whose steps were taken since the last call. A Lift-off that lasted one
  /// step is
  ///         kept until it has been read. state = PenState; value[0] = height above the touched paper [m],
  ///         value[1] = speed along the pen [m/s], value[2] = force along it [N], filtered
  SensorReading reading();

  /// @return after the last step
  [[nodiscard]] PenState state() const { return state_; }

 private:
  void filter(const StepSample& sample);
  [[nodiscard]] PenState next();
  [[nodiscard]] bool settled();
  [[nodiscard]] PenState touch();

  PenStateParameters k_;
  PenState state_{PenState::above_paper};
  bool lifted_{};   // a Lift-off since the last reading
  bool settled_{};  // the pen has been at rest once since the start
  bool first_{true};
  Vector3 p_{Vector3::Zero()};  // last position of the pen tip in the base [m]
  double depth_{};              // way along the pen's axis since the start [m], grows into the paper
  double v_{};                  // filtered [m/s], positive into the paper
  double F_{};                  // filtered [N]
  double paper_{};              // depth at which the paper is [m]
  double timer_{};              // [s] in the present state, in lowering: at rest
  double pressing_{};           // [s] at rest under rest_force
  std::array<double, 50> past_F_{};
  int n_F_{};  // samples taken
};

}  // namespace mrroc::vsp
