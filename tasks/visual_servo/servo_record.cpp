#include "tasks/visual_servo/servo_record.hpp"

#include <algorithm>

#include "base/agent_images.hpp"
#include "base/link/take_all.hpp"
#include "base/msg/pose_rows.hpp"
#include "base/screw.hpp"
#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/program.hpp"

namespace mrroc::visual_servo {
namespace {

/// Below this an object does not move [m/s].
constexpr double kRest = 1e-4;

/// As ServoRow has it.
int behaviour_of(int m) {
  if (m == kFromMemory) return kRemembered;
  return m == kIdle || m == kGiveUp.m ? 0 : m;
}

Pose between(const Pose& a, const Pose& b, double share) {
  return a * exp_screw(log_screw(a.inverse() * b), share);
}

/// Fills in what is true at a step, when there is a truth about it.
void add_truth(const std::vector<object_truth_t>& truths, std::int64_t step, const Pose& T_EGd, double dt,
               const Pose& D, ServoRow& row) {
  row.object_there = false;
  const auto after = std::ranges::upper_bound(truths, step, {}, &object_truth_t::step);
  if (after == truths.begin()) return;
  const object_truth_t& a = *(after - 1);
  const object_truth_t& b = after == truths.end() ? a : *after;
  if (a.present == 0 || b.present == 0) return;
  row.object_there = true;
  const double steps = std::max<double>(1, static_cast<double>(b.step - a.step));
  const double share = b.step == a.step ? 0 : static_cast<double>(step - a.step) / steps;
  const Pose T_0G = between(pose_from_rows(a.T_0G), pose_from_rows(b.T_0G), share);
  row.T_0E = between(pose_from_rows(a.T_0E), pose_from_rows(b.T_0E), share);
  row.true_e = row.T_0E.inverse() * T_0G * T_EGd.inverse();
  row.known_e = D * row.true_e;
  row.v = (pose_from_rows(b.T_0G).p - pose_from_rows(a.T_0G).p) / (steps * dt);
  if (row.v.norm() < kRest) row.v.setZero();
}

}  // namespace

ServoTable join(const std::vector<servo_report_t>& reports, const std::vector<object_truth_t>& truths,
                const Pose& T_EGd, const ecp::Pacing& pacing, const Pose& D) {
  ServoTable table;
  for (const servo_report_t& r : reports) {
    ServoRow& row = table.emplace_back();
    row.k = static_cast<std::int64_t>(table.size()) - 1;
    row.t = static_cast<double>(r.step) * pacing.dt;
    row.behaviour = behaviour_of(r.m);
    row.sac_seen = r.seen[0] != 0;
    row.eih_seen = r.seen[1] != 0;
    row.refused = r.refused != 0;
    row.e = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(r.e));
    row.set_step = Eigen::Map<const Vector3>(r.T_dc).norm() / pacing.n_s;
    row.T_0E = pose_of(r);
    add_truth(truths, r.step, T_EGd, pacing.dt, D, row);
  }
  return table;
}

ServoRecord::ServoRecord(link::Process& process, const std::string& arm)
    : report_in_(process.inbox<servo_report_t>(arm + ".servo")),
      truth_in_(process.inbox<object_truth_t>("object.truth")) {}

void ServoRecord::collect() {
  link::take_all(*report_in_, reports_);
  link::take_all(*truth_in_, truths_);
}

}  // namespace mrroc::visual_servo
