// How well the arms have kept their places on a belt that runs by itself.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// Compares the arms with the belt while it stands and the nodes stand, too: in lowering and lift-off.
class BeltRecord {
 public:
  /// Takes note of a macrostep. @param m  of the coordinator's behaviour
  void note(const Coordinator::X& x, int m);

  /// @return how often the belt has begun to run
  [[nodiscard]] int starts() const { return starts_; }
  /// @return E of an arm in its base when it began to reproduce, with the belt where that began to run [m]
  [[nodiscard]] const std::optional<Vector3>& begin(std::size_t arm) const { return begin_[arm]; }
  /// @return how far an arm has moved over its sheet, beside what it was to move, from the first rest of the belt to the
  ///         last one [m]; NaN: there were no two of them
  [[nodiscard]] double drift(std::size_t arm) const;

 private:
  double belt_{};  // y of E [m]
  int rested_{};   // macrosteps
  bool running_{};
  int starts_{};
  std::array<std::optional<Vector3>, kArms> begin_;
  double belt_begin_{};                             // y of E while it still stands [m]
  std::array<std::vector<double>, kArms> offsets_;  // of the rests [m]
};

}  // namespace mrroc::drawing
