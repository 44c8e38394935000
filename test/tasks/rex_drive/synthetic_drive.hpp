// A run of a platform as its messages would tell it: 4 s straight on, in two fragments of two plans.
#pragma once
#include <cmath>

#include "tasks/rex_drive/figures.hpp"

namespace mrroc::rex_drive {

inline constexpr double kSpeed = 0.5;

/// Fragment of 2 s along x.
inline Fragment straight_fragment(std::int64_t number, double from, double end_speed) {
  Fragment f{.number = number, .steps = 100, .notify = 46};
  for (std::size_t k = 0; k < kFragmentKnots; ++k)
    f.knot[k] = {{from + kSpeed * 2 * static_cast<double>(k) / (kFragmentKnots - 1), 0, 0}, kSpeed, 0};
  f.knot.back().v = end_speed;
  return f;
}

/// The true place is `error` beside the reference, the estimate half of it, and the platform rests for a second at the end.
inline DriveResults synthetic_drive(double error = 0.01) {
  DriveResults r;
  r.plans = {{.number = 1, .n = 1, .point = {{{1, 0}}}, .speed = kSpeed, .ahead = 1},
             {.number = 2, .n = 1, .point = {{{2, 0}}}, .speed = kSpeed}};
  r.fragments = {{straight_fragment(1, 0, kSpeed), 10, 1}, {straight_fragment(2, 1, 0), 60, 2}};
  r.acked_in = 100;
  r.iterations = {1, 2, 3};
  for (int i = 0; i < 250; ++i) {
    DriveRow row;
    row.step = 10 * i;
    row.t = 0.02 * i;
    const bool drives = i < 200;
    row.reference = {drives ? kSpeed * row.t : 2, 0, 0};
    row.truth.p = {row.reference.x, error, 0};
    row.truth.v.vx = drives ? kSpeed : 0;
    for (auto& friction : row.truth.friction) friction = {0.7, 0.6};
    row.estimate.p = {row.reference.x, error / 2, 0};
    row.estimate.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
    row.slip = {0.69, 0.6, 0.02};
    row.executing = drives ? 1 + i / 100 : 0;
    row.notified = i >= 146 ? 2 : i >= 46 ? 1 : 0;
    row.at_rest = i >= 205;
    r.table.push_back(row);
  }
  return r;
}

}  // namespace mrroc::rex_drive
