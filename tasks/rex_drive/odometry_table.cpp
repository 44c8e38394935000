#include "tasks/rex_drive/odometry_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/planar.hpp"
#include "base/text_file.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// @return the true pose at a step; nothing: no truth is told of it
std::optional<PlanarPose> true_pose(const std::vector<platform_truth_t>& truths, std::int64_t step, int n_s) {
  if (step % n_s != 0) return {};
  const auto found =
      std::ranges::lower_bound(truths, step / n_s, {}, [](const auto& m) { return m.header.stamp; });
  if (found == truths.end() || found->header.stamp != step / n_s) return {};
  return from_message(*found).p;
}

bool drives_at(const DriveTable& drive, std::int64_t step) {
  const auto row = std::ranges::lower_bound(drive, step, {}, &DriveRow::step);
  return row != drive.end() && row->executing > 0;
}

/// @return x, y and the turn about z of a covariance of six
PlanarCovariance planar(const std::array<double, 36>& covariance) {
  constexpr std::array<std::size_t, 3> kPlanar{0, 1, 5};
  PlanarCovariance result{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      result[3 * row + column] = covariance[6 * kPlanar[row] + kPlanar[column]];
  return result;
}

/// What a row says beyond its support; nan where it is not known.
struct Numbers {
  std::array<double, 3> motion{kUnknown, kUnknown, kUnknown}, sd{motion}, truth{motion};
  double error{kUnknown}, error_sd{kUnknown}, turn_error{kUnknown}, turn_sd{kUnknown};  // [mm], [mrad]
};

Numbers numbers_of(const OdometryRow& row) {
  constexpr double kMilli = 1e3;
  Numbers n;
  if (row.truth) n.truth = {row.truth->x, row.truth->y, row.truth->phi};
  if (!row.valid) return n;
  n.motion = {row.motion.x, row.motion.y, row.motion.phi};
  for (std::size_t k = 0; k < 3; ++k) n.sd[k] = std::sqrt(row.covariance[4 * k]);
  n.error_sd = kMilli * std::hypot(n.sd[0], n.sd[1]);
  n.turn_sd = kMilli * n.sd[2];
  if (const auto e = motion_error(row)) {
    n.error = kMilli * std::hypot(e->x, e->y);
    n.turn_error = kMilli * std::abs(e->phi);
  }
  return n;
}

}  // namespace

OdometryTable join_odometry(const DriveMessages& messages, const DriveTable& drive, double dt, int n_s) {
  OdometryTable table;
  for (const odometry_reading_t& m : messages.odometry) {
    if (m.last != 0 || !is_proper(m)) continue;
    const OdometryReading reading = from_message(m);
    OdometryRow row;
    row.t = static_cast<double>(reading.step) * dt;
    row.support = support_of(m);
    row.valid = reading.valid;
    row.drives = drives_at(drive, reading.step);
    if (reading.valid) {
      row.motion = {reading.A[3], reading.A[7], std::atan2(reading.A[4], reading.A[0])};
      row.covariance = planar(reading.covariance);
      const auto before = true_pose(messages.truths, reading.step_before, n_s);
      const auto now = true_pose(messages.truths, reading.step, n_s);
      if (before && now) row.truth = seen_from(*before, *now);
    }
    table.push_back(row);
  }
  return table;
}

std::optional<PlanarPose> motion_error(const OdometryRow& row) {
  if (!row.valid || !row.truth) return {};
  return PlanarPose{row.motion.x - row.truth->x, row.motion.y - row.truth->y,
                    wrap_angle(row.motion.phi - row.truth->phi)};
}

void write_odometry_table(const std::filesystem::path& file, const OdometryTable& table) {
  std::string text =
      "t,frame,valid,features,matches,inliers,cells,dx,dy,dphi,sd_dx,sd_dy,sd_dphi,true_dx,true_dy,true_dphi,"
      "error_mm,sd_mm,turn_error_mrad,turn_sd_mrad,reprojection_px,drives,finding\n";
  for (const OdometryRow& row : table) {
    const OdometrySupport& s = row.support;
    const Numbers n = numbers_of(row);
    text += fmt::format("{:.3f},{},{:d},{},{},{},{}", row.t, s.frame, row.valid, s.features, s.matches,
                        s.inliers, s.cells);
    for (const auto& three : {n.motion, n.sd, n.truth})
      for (const double number : three) text += fmt::format(",{:.6g}", number);
    text += fmt::format(",{:.4g},{:.4g},{:.4g},{:.4g},{:.3g},{:d},{}\n", n.error, n.error_sd, n.turn_error,
                        n.turn_sd, s.rms_px, row.drives, to_words(s.finding));
  }
  write_text_file(file, text);
}

}  // namespace mrroc::rex_drive
