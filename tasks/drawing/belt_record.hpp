// How well the arms have kept their places on a belt that runs by itself.
#pragma once
#include <array>
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
  /// @return how far an arm has moved over its sheet, beside what it was to move, from the first rest of the belt to the
  ///         last one [m]; NaN: there were no two of them
  [[nodiscard]] double drift(std::size_t arm) const;

 private:
  double belt_{};  // y of E [m]
  int rested_{};   // macrosteps
  bool running_{};
  int starts_{};
  std::array<std::vector<double>, kArms> offsets_;  // of the rests [m]
};

}  // namespace mrroc::drawing
