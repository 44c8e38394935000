// Ends a motion that no command follows: the speed of the set point falls smoothly to zero.
#pragma once

namespace mrroc::edp {

/// Most steps that a stop may take (edp.md: at rest within 100 steps of the macrostep's end; the drives need
/// the rest of them).
inline constexpr int kMaxStopSteps = 40;

/// Share of the initial speed that is left in step k of a stop: 1 - tau^2 (3 - 2 tau), tau = k/n. Its slope
/// is zero at both ends, so the set point's acceleration has no steps.
/// @param k step 0..n  @param n steps of the whole stop, at least 1
/// @return 1 at k = 0, 0 at k = n. Real-time safe
constexpr double remaining_speed(int k, int n) noexcept {
  const double tau = static_cast<double>(k) / n;
  return 1 - tau * tau * (3 - 2 * tau);
}

/// @return speed of step k divided by the speed of step k - 1, k = 1..n. Real-time safe
constexpr double speed_ratio(int k, int n) noexcept {
  return k < n ? remaining_speed(k, n) / remaining_speed(k - 1, n) : 0;
}

/// @return way of a whole stop of n steps, in steps of the initial speed: the sum of remaining_speed over
///         k = 1..n, which is (n - 1)/2 because the ramp is symmetric. Real-time safe
constexpr double stopping_way(int n) noexcept { return 0.5 * (n - 1); }

/// @return way of a stop of n steps up to its step k, in steps of the initial speed: the sum of remaining_speed over
///         1..k, from the sums of squares and of cubes. Real-time safe
constexpr double way_of_stop(int k, int n) noexcept {
  const double sum = 0.5 * k * (k + 1);
  return k - sum * (2 * k + 1) / (static_cast<double>(n) * n) +
         2 * sum * sum / (static_cast<double>(n) * n * n);
}

/// @return way that is left of a stop of n steps after step k, in steps of the speed of step k; 0 for k >= n.
///         Real-time safe
constexpr double remaining_way(int k, int n) noexcept {
  double way = 0;
  for (int j = k + 1; j < n; ++j) way += remaining_speed(j, n);
  return k < n ? way / remaining_speed(k, n) : 0;
}

}  // namespace mrroc::edp
