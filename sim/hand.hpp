// The operator's hand: a spring-damper force on the pen tip that leads a compliant arm over the paper.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/spatial.hpp"
#include "sim/hand_track.hpp"
#include "sim/paper.hpp"

namespace mrroc::sim {

/// A line of points in sheet coordinates [mm].
using Polyline = std::vector<Eigen::Vector2d>;

/// Motion and stiffness of the operator's hand.
struct HandParameters {
  double stiffness{1000};        ///< [N/m]
  double damping{30};            ///< [N s/m]
  double speed{0.02};            ///< largest along a stroke [m/s]
  double travel_speed{0.03};     ///< largest above the paper [m/s]
  double acceleration{0.1};      ///< along and across the path [m/s^2]; slows curves down
  double corner{25};             ///< rests at corners sharper than this [deg]
  double lowering_speed{0.012};  ///< down, in the air [m/s]
  double lifting_speed{0.03};    ///< up [m/s]
  double lift{0.010};            ///< height of travel above the paper [m]
  double uneven{0.004};          ///< amplitude of the uneven height of travel [m]
  double dwell{0.6};             ///< rests so long after touching the paper [s]
  double press{1.5};             ///< force on the paper that the operator aims at [N]
  double arm_press{1.0};         ///< part of it that the arm gives by itself (F_d of the teach-in) [N]
  double press_wander{0.25};     ///< relative standard deviation of that force
  double tremor{1e-4};           ///< per axis, rms [m]
  double tremor_frequency{8};    ///< [Hz]
  /// Resistance of the arm to being led, which the operator has learnt: 1/B of the teach-in [N s/m] ...
  double drag{200};
  double inertia{20};  ///< ... and its I [kg]
  /// Mass of hand and forearm, which muscles of that stiffness and damping move and which hold the pen by a grip [kg];
  /// 0: the muscles act on the pen.
  double mass{0};
  double grip_stiffness{4000};  ///< between a hand that has a mass and the pen [N/m]
  double grip_damping{40};      ///< [N s/m]
};

/// Present action of the hand.
enum class HandPhase : std::uint8_t { idle, leading, done };

/// Progress of the hand's script.
struct HandStatus {
  HandPhase phase{HandPhase::idle};  ///< after the last step
  bool paused{};                     ///< at rest (or coming to rest) in the middle of its script
  bool on_paper{};                   ///< the script is at a stroke, from touching until lifting
  std::int32_t stroke{};             ///< number of the stroke in work, from 0
  std::int32_t strokes{};            ///< strokes of the script
  double fraction{};                 ///< share of the script's length that is done, 0..1
};

/// The hand of one arm's operator. Deterministic: the same seed and calls give the same forces.
class Hand {
 public:
  /// @param paper  of the arm that is led  @param seed  of tremor and pressure
  Hand(const HandParameters& parameters, const PaperParameters& paper, std::uint64_t seed);
  ~Hand();
  Hand(Hand&&) noexcept;
  Hand& operator=(Hand&&) noexcept;

  /// Takes the pen and leads it along a drawing, stroke by stroke: above the start, down until it touches,
  /// along the stroke with some pressure, up, to the next. Done when lifted after the last stroke; then it
  /// holds the pen still.
  /// @param strokes  each with at least one point [mm]; empty strokes are skipped
  void lead_along(const std::vector<Polyline>& strokes);

  /// Takes the pen, leads it to a point above the sheet and holds it there (done).
  /// @param point   [mm]
  /// @param height  above the paper [m]
  void lead_to(const Eigen::Vector2d& point, double height = 0.010);

  /// Takes the tool, leads it to the beginning of a track and along it with its times; done at its end, where it
  /// holds the tool. What the operator has learnt of the arm's resistance does not count.
  /// @param track  not empty
  void follow(const HandTrack& track);

  /// Pushes the tool, wherever it goes; the force grows within 0.3 s. It leads nothing, and is idle.
  /// @param force  along the axes of the sheet [N]
  void push(const Vector3& force);

  /// Lets the pen go: the force fades to zero within 0.3 s; idle.
  void release();

  /// Comes smoothly to rest where it is and holds the pen there; later goes on along the same path.
  void pause(bool paused);

  /// @return what it does and how far it is
  [[nodiscard]] HandStatus status() const;

  /// Advances the hand's own time and gives its force on the pen tip.
  /// @param dt          [s], at most 2 ms
  /// @param tip         pen tip, in the arm's base [m]
  /// @param velocity    of the tip, in the arm's base [m/s]
  /// @param on_paper    the pen touches the paper
  /// @return force in the arm's base [N]
  Vector3 step(double dt, const Vector3& tip, const Vector3& velocity, bool on_paper);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::sim
