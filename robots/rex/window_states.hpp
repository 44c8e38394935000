// What is estimated of the stages of a window, and how model and measurements are along it.
#pragma once
#include <algorithm>
#include <array>

#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// States z_k of the stages of a window, oldest first, with their linearisations. A transition is made anew only where what it
/// is of has changed; residuals, which cost little, always. Everything is real-time safe.
class WindowStates {
 public:
  /// A correction of the state of each stage.
  using Change = std::array<StageVector, static_cast<std::size_t>(kWindowStages)>;
  /// Most halvings of a step.
  static constexpr int kHalvings = 2;

  /// @param k  0..kWindowStages - 1, here and below
  [[nodiscard]] const StageVector& operator[](int k) const noexcept {
    return z_[static_cast<std::size_t>(k)];
  }
  /// A stage has another state.
  void set(int k, const StageVector& z) noexcept {
    z_[static_cast<std::size_t>(k)] = z;
    renew(k);
  }
  /// What leads from stage k and later ones is to be linearised anew, since the window has changed there.
  void renew(int k) noexcept { linearised_ = std::min(linearised_, k); }
  /// The oldest stage leaves, as that of the window does; the newest one is to be set.
  void shift() noexcept;

  /// Linearises along the states. @param window  full
  void linearise(const StageWindow& window) noexcept;
  /// @return of linearise(), k < kWindowStages - 1
  [[nodiscard]] const StageTransition& transition(int k) const noexcept {
    return transitions_[static_cast<std::size_t>(k)];
  }
  /// @return of linearise()
  [[nodiscard]] const StageResiduals& residuals(int k) const noexcept {
    return residuals_[static_cast<std::size_t>(k)];
  }

  /// @param arrival       what is believed of the oldest stage, before its own measurements
  /// @param arrival_root  L with L L' = P of it
  /// @return what the MHE minimises, as the states were linearised last
  [[nodiscard]] double cost(const StageBelief& arrival, const StageMatrix& arrival_root) const noexcept;
  /// Takes a step from where linearise() was called: all of it, or half of it where the cost would become larger, or else a
  /// quarter. The states are within contained(), and linearised.
  /// @param step  of each stage  @return halvings, 0..kHalvings
  int take(const Change& step, const StageWindow& window, const StageBelief& arrival,
           const StageMatrix& arrival_root) noexcept;

 private:
  static constexpr auto kStages = static_cast<std::size_t>(kWindowStages);

  std::array<StageVector, kStages> z_;
  std::array<StageResiduals, kStages> residuals_;
  std::array<StageTransition, kStages> transitions_;  // the last one means nothing
  int linearised_{};  // transitions, from the oldest on, that are those of the states
};

}  // namespace mrroc::rex
