// Virtual sensor of a pen: the automaton of MS fig. 3 over pose and force, one per arm.
#pragma once
#include <array>

#include "base/effector_command.hpp"
#include "base/pen_state.hpp"
#include "base/pose.hpp"
#include "base/transmission.hpp"
#include "vsp/pen_state/touched_plane.hpp"
#include "vsp/pen_state/trend.hpp"

namespace mrroc::vsp {

/// Thresholds of the automaton.
///
/// Under law (28) the force is the arm's own answer to its speed, F_a = F_d - v / B - I dv/dt, on paper and in the air
/// alike, at rest and in the band of a hand's tremor: neither its level nor its spectrum tells paper from air. What
/// does: where the paper is. The first touch is told by its transient, a pen that is lowered and stopped; all later ones,
/// and all lift-offs, by the height h above the plane of the points touched so far (TouchedPlane). In what follows
/// v and F are filtered over some milliseconds and contain the tremor; w and M F are trends without it (Trend); P is the
/// amplitude of the tremor in F, the largest |F - M F| of late, dP/dt = -P / tremor_memory.
struct PenStateParameters {
  double dt{0.002};              ///< duration of a step [s]
  double v_filter{0.020};        ///< time constant for the pen's velocity v along its axis [s]
  double F_filter{0.006};        ///< time constant for the force F along it [s]
  double tremor_period{0.25};    ///< T of the trends, longest period of a tremor [s], at most 0.5 s
  double tremor_memory{1.0};     ///< time constant with which a large P is forgotten [s]
  double lowering_speed{0.005};  ///< A: v is above this [m/s]
  double braked_speed{0.003};    ///< lowering ends without a touch when w is below minus this [m/s]
  double rest_speed{0.0015};     ///< or when |w| is below this for rest_time; once before A, |v| [m/s]
  double rest_time{0.5};         ///< [s]
  double touch_height{0.0012};   ///< B on known paper: h is below this, and v below braked_speed [m]
  double impact_force{1.25};     ///< B, an impact: F rises by more than this + 2 P, P before ... [N]
  double impact_time{0.020};     ///< ... within this time [s], at most 0.1 s
  double stop_share{
      0.25};  ///< B, a stop: the largest w of the lowering is above lowering_speed, w below this share of it ...
  double stop_force{0.8};       ///< ... and M F above the least M F of the lowering by more than this [N]
  double rest_force{1.2};       ///< B, a soft landing: |w| is below rest_speed and M F above this ... [N]
  double rest_force_time{0.2};  ///< ... for this time [s]; in the air F would have gone to zero
  double sink_depth{0.002};     ///< the touch was none: -h is above this, and v above lowering_speed [m]
  double lift_height{0.0022};   ///< C: h is above this [m]
  PlaneParameters paper;  ///< of the plane. Where it is uncertain by s, an impact or a stop counts up to
                          ///< h = touch_height + 3 s
};

/// The automaton Above paper -A-> Lowering -B-> Paper surface -C-> Lift-off -D-> Above paper (MS 27, 28). The
/// state is its memory. A touch that was none goes back to Lowering, and the plane is forgotten. When the frame jumps,
/// the automaton begins anew, above the paper and until the pen has been at rest. D follows at once, in
/// the next step; the timed lift-off is a behaviour of the task. The pen's orientation is constant.
class PenStateSensor {
 public:
  /// Begins above the paper.
  explicit PenStateSensor(const PenStateParameters& parameters = {});

  /// Takes the reading of one step; one that is none (not finite, impossible) is passed over. Real-time safe.
  void step(const StepSample& sample);

  /// @return reading of the macrostep whose steps were taken since the last call. A Lift-off that lasted one
  /// step is kept until it has been read. state = PenState; value[0] = height h above the touched paper [m], 0 before
  /// the first touch, value[1] = speed along the pen [m/s], value[2] = force along it [N], filtered
  SensorReading reading();

  /// @return after the last step
  [[nodiscard]] PenState state() const { return state_; }

 private:
  // What a lowering has been so far.
  struct Fall {
    double w_most{};   // largest trend of the speed [m/s]
    double F_least{};  // least trend of the force [N]
  };

  void begin(const Pose& T_0E, double F);
  void filter(const StepSample& sample);
  void follow_fall();
  [[nodiscard]] bool settled();
  [[nodiscard]] bool lies_elsewhere() const;
  [[nodiscard]] bool touches() const;
  [[nodiscard]] double height() const;
  [[nodiscard]] PenState next();

  PenStateParameters k_;
  PenState state_{PenState::above_paper};
  bool lifted_{};   // a Lift-off since the last reading
  bool settled_{};  // the pen has been at rest once in this frame
  bool first_{true};
  Pose T_0S_;                   // where the pen was first; x and y along its paper, z along its axis
  Vector3 p_{Vector3::Zero()};  // place of the pen tip in that frame [m]
  double v_{};                  // filtered [m/s], positive into the paper
  double F_{};                  // filtered [N]
  double rise_{};               // of F within impact_time [N]
  double rise_bound_{};         // that an impact exceeds [N]
  double amplitude_{};          // P [N]
  Trend z_, force_;
  Fall fall_;
  TouchedPlane paper_;
  double timer_{};     // [s] at rest
  double pressing_{};  // [s] at rest under rest_force
  // One of the last impact_time.
  struct Past {
    double F{}, amplitude{};
  };
  std::array<Past, 50> past_{};
  std::size_t oldest_{};
};

}  // namespace mrroc::vsp
