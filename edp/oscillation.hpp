// Detects a contact that has become unstable: the force oscillates, and the oscillation does not decay.
#pragma once
#include <array>
#include <bitset>
#include <cstddef>
#include <optional>

#include "base/axis_command.hpp"
#include "base/fault.hpp"
#include "base/spatial.hpp"

namespace mrroc::edp {

/// Definition of an unstable contact. A swing is the way of the force from an
/// extremum to the next one, in the mean over a period.
struct OscillationParameters {
  double force{2};          ///< least swing that counts [N], > 0; infinite: never
  double torque{0.2};       ///< the same of the torques [N m], > 0
  double growth{1.1};       ///< mean factor from period to period that is growth, >= 1
  double sustained{0.97};   ///< mean factor that will do from twice the swings above on, > 0:
                            ///< a contact that breaks and comes back grows no more
  int periods{4};           ///< that are looked at, 2..kMostPeriods
  double lowest{4};         ///< frequency of the swings, at least [Hz]: people lead
                            ///< arms more slowly
  double highest{60};       ///< at most [Hz]
  double softest{1. / 64};  ///< share of its mobility that an axis keeps at least while its contact swings
                            ///< (edp/softening.hpp), 0..1; 1: it keeps all
  double gears{};           ///< mode in which the gears give way [Hz], 0: rigid. A fault tells
                            ///< whether it is that which swings, 0..100
};

/// Most periods that an observer looks at.
inline constexpr int kMostPeriods = 8;

/// @return whether an observer can work with them. Real-time safe
[[nodiscard]] bool is_usable(const OscillationParameters& p) noexcept;

/// Axes of E, by number.
using AxisSet = std::bitset<6>;

/// @return the axes on which force acts under law (28), in TCIM. Real-time safe
[[nodiscard]] AxisSet force_axes(const TaskFrameCommand& rows) noexcept;

/// @param swings  what the observer has told  @param rows  with which the contact was made
/// @return the same, with I and B of its axis in the text: what is to be changed. Real-time safe
[[nodiscard]] Fault with_law(const Fault& swings, const TaskFrameCommand& rows) noexcept;

/// Looks for an oscillation of the adjusted force that does not die away, axis
/// by axis.
///
/// Extrema are found with a hysteresis, so neither noise nor the tool's own
/// ringing makes any. When the last periods are of about the same length and in
/// the band, no swing is much smaller than the one before, the last is large
/// enough and their mean factor says growth, the contact is unstable. It is
/// told at a peak of the force only: then the effector is about to move out of
/// the contact, and a stop loads it no further. Real-time safe.
class OscillationObserver {
 public:
  /// @param dt duration of a step [s]
  OscillationObserver(const OscillationParameters& parameters, double dt) noexcept
      : p_(parameters), dt_(dt) {}

  /// One step. @param F_a adjusted force in E  @param watched axes to look at;
  /// the others are forgotten
  /// @return the axes on which the contact is unstable, at a peak of the force
  [[nodiscard]] AxisSet swinging(const Wrench& F_a, AxisSet watched) noexcept;

  /// One step, as swinging(), but for swings that are jumps: where an encoder counts, or a track slips, the force of a stiff
  /// contact jumps and is back a step later, which no loop does that keeps contact; half of the periods are enough.
  /// @return contact_unstable, with the axis, the last swing and its bound as
  /// figures, frequency and growth per
  ///         period in the text
  [[nodiscard]] std::optional<Fault> step(const Wrench& F_a, AxisSet watched) noexcept;

  /// What these axes have done so far does not count.
  void forget(AxisSet axes) noexcept;

 private:
  static constexpr std::size_t kMostHalves = 2 * kMostPeriods;
  /// From one extremum to the next.
  struct Half {
    double swing;  // [N], [N m]
    int steps;
    double least;  // force at its smaller end, without sign; 0: it changes its sign between both [N], [N m]
  };
  struct Period {
    double swing;
    double time;  // [s]
  };
  /// Memory of an axis.
  struct History {
    std::array<Half, kMostHalves> half{};
    std::size_t count{};                 // halves so far
    double extremum{};                   // the last one that is certain
    double best{};                       // farthest from it since then
    int since_extremum{}, since_best{};  // [steps]
    bool rising{}, begun{};
    bool certain{};  // there is an extremum; before it the force began anywhere
  };

  [[nodiscard]] bool turned(History& h, double force, double least) const noexcept;
  [[nodiscard]] Period period(const History& h, int back) const noexcept;
  [[nodiscard]] double factor(const History& h) const noexcept;
  [[nodiscard]] bool jumps(const History& h, double least) const noexcept;
  [[nodiscard]] bool regular(const History& h, double least) const noexcept;
  [[nodiscard]] double least(std::size_t axis) const noexcept { return axis < 3 ? p_.force : p_.torque; }
  [[nodiscard]] Fault told(std::size_t axis) const noexcept;

  OscillationParameters p_;
  double dt_;
  std::array<History, 6> axes_{};
};

}  // namespace mrroc::edp
