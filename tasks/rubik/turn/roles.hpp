// One arm's way through its behaviours m = 1..6.
#pragma once
#include <array>

#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {

/// Executes a role macrostep by macrostep, for those who move several arms in one thread; what it does in one call is
/// one round of base/motion.hpp's move(), over the ends of behaviours.
class Role {
 public:
  /// @param rows  kWorker or kHolder
  explicit Role(const std::array<Motion<Arm>, 6>& rows) : rows_(rows) {}

  /// @param x  images of the macrostep; memory and i_0 are changed at the begin of a behaviour
  /// @return what is decided. After m = 6: nothing is commanded
  Arm::Y step(Arm::X& x) {
    if (m_ == 0) enter(1, x);
    while (!done() && row().f_tau(x)) enter(m_ + 1, x);
    if (done()) return {x.c, {}, {}, {}};
    Arm::Y y{row().f_cc(x), row().f_ce(x), row().f_cV(x), row().f_cT(x)};
    x.c = y.c;
    return y;
  }

  /// @return behaviour in force, 1..6; 7 at the end
  [[nodiscard]] int m() const { return m_; }
  [[nodiscard]] bool done() const { return m_ > 6; }

 private:
  [[nodiscard]] const Motion<Arm>& row() const { return rows_[static_cast<std::size_t>(m_ - 1)]; }
  void enter(int m, Arm::X& x) {
    m_ = m;
    x.i_0 = x.i;
    if (!done()) x.c = row().f_entry(x);
  }

  const std::array<Motion<Arm>, 6>& rows_;
  int m_{};
};

}  // namespace mrroc::rubik
