#include "tasks/drawing/belt_record.hpp"

#include <cmath>
#include <limits>

namespace mrroc::drawing {
namespace {

constexpr double kStands = 2e-6;  // way in a macrostep of a belt that stands [m]
constexpr double kRuns = 1e-4;    // of one that runs [m]
/// After which the arms stand, too: the loop, and their servos.
constexpr int kSettled = 8;  // [macrosteps]

/// The arms have let go of the hands, and the belt has hardly moved [macrosteps].
constexpr int kBegun = 4;

/// y of E, which is upright [m].
double y_of(const Report& r) { return -r.T_0E[1]; }

/// Way along y of the nodes executed [m].
double planned(const CoordinatorMemory& c) {
  double way = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(c.p); ++n)
    way += c.recording[n].velocity[Axis::y] * c.k.dt * c.k.n_s;
  return way;
}

}  // namespace

void BeltRecord::note(const Coordinator::X& x, int m) {
  if (!x.has_conveyor() || !x.c.k.belt_runs) return;
  const double belt = y_of(x.T.agent[kConveyor]);
  const double way = std::abs(belt - belt_);
  belt_ = belt;
  rested_ = way < kStands ? rested_ + 1 : 0;
  if (way > kRuns && !running_) ++starts_;
  running_ = way > kRuns || (running_ && way > kStands);
  if (m < 4) belt_begin_ = belt;
  if (m == 4 && x.i - x.i_0 == kBegun)
    for (std::size_t arm = 0; arm < kArms; ++arm)
      if (auto& begin = begin_[arm]; !begin) {
        const auto& E = x.T.agent[arm].T_0E;
        begin = Vector3(E[0], E[1] + (belt - belt_begin_), E[2]);
      }
  const bool nodes_stand = (m == 4 || m == 6) && x.i - x.i_0 > kSettled;
  if (rested_ != kSettled || !nodes_stand || starts_ == 0) return;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    offsets_[arm].push_back(y_of(x.T.agent[arm]) - belt - planned(x.c));
}

double BeltRecord::drift(std::size_t arm) const {
  const auto& offsets = offsets_[arm];
  if (offsets.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(offsets.back() - offsets.front());
}

}  // namespace mrroc::drawing
