#include "tasks/rex_drive/drive_record.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/link/take_all.hpp"
#include "tasks/rex_drive/keys.hpp"

namespace mrroc::rex_drive {
namespace {

double between(double a, double b, double share) { return a + share * (b - a); }

/// Fills in what is true at a step. @return false: it is not known
bool add_truth(const std::vector<platform_truth_t>& truths, int n_s, DriveRow& row) {
  const std::int64_t macrostep = row.step / n_s;
  const auto first =
      std::ranges::lower_bound(truths, macrostep, {}, [](const auto& m) { return m.header.stamp; });
  if (first == truths.end() || first->header.stamp != macrostep) return false;
  row.truth = from_message(*first);
  const auto rest = static_cast<double>(row.step % n_s);
  if (rest == 0) return true;
  const auto next = first + 1;
  if (next == truths.end() || next->header.stamp != macrostep + 1) return false;
  const PlatformTruth after = from_message(*next);
  const double share = rest / n_s;
  PlanarPose& p = row.truth.p;
  p.x = between(p.x, after.p.x, share);
  p.y = between(p.y, after.p.y, share);
  p.phi = wrap_angle(p.phi + share * wrap_angle(after.p.phi - p.phi));
  row.truth.v.vx = between(row.truth.v.vx, after.v.vx, share);
  row.truth.v.vy = between(row.truth.v.vy, after.v.vy, share);
  row.truth.v.w = between(row.truth.v.w, after.v.w, share);
  return true;
}

double pace_in(const std::vector<CommandedPace>& paces, std::int64_t macrostep) {
  const auto found = std::ranges::lower_bound(paces, macrostep, {}, &CommandedPace::macrostep);
  return found != paces.end() && found->macrostep == macrostep ? found->pace : 1;
}

}  // namespace

void DriveMessages::cut_after(std::int64_t macrostep, std::int64_t odometry_latency) {
  const auto cut = [macrostep](auto& kept) {
    std::erase_if(kept, [macrostep](const auto& m) { return m.header.stamp > macrostep; });
  };
  cut(replies);
  cut(telemetry);
  cut(truths);
  cut(poses);
  std::erase_if(paces, [macrostep](const CommandedPace& p) { return p.macrostep > macrostep; });
  const std::int64_t last = macrostep * kPlatformSteps - odometry_latency;
  std::erase_if(odometry,
                [last](const odometry_reading_t& m) { return m.last != 0 || m.motion.step > last; });
}

void DriveMessages::add_rest(const link::LogReader& log, const std::string& platform) {
  const auto add = [&log](auto& kept, const std::string& channel) {
    using Message = typename std::remove_reference_t<decltype(kept)>::value_type;
    const std::int64_t last = kept.empty() ? -1 : kept.back().header.stamp;
    for (const auto& [stamp, m] : log.messages<Message>(channel))
      if (stamp > last) kept.push_back(m);
  };
  add(replies, platform + ".reply");
  add(telemetry, platform + ".telemetry");
  add(truths, platform + ".truth");
  add(poses, pose_channel());
  add(odometry, platform + ".odometry");
}

DriveTable join(const DriveMessages& messages, double dt, int n_s) {
  DriveTable table;
  auto telemetry = messages.telemetry.begin();
  for (const platform_reply_t& m : messages.replies) {
    const PlatformReply reply = from_message(m);
    const std::int64_t step = reply.estimate.step;
    while (telemetry != messages.telemetry.end() && telemetry->step < reply.step) ++telemetry;
    if (telemetry == messages.telemetry.end()) break;
    if (telemetry->step != reply.step || !reply.position_known) continue;
    DriveRow row;
    row.step = step;
    row.t = static_cast<double>(step) * dt;
    if (!add_truth(messages.truths, n_s, row)) continue;
    row.reference = from_message(*telemetry).reference.front();
    row.estimate = reply.estimate;
    row.slip = reply.slip;
    row.slip_sd = reply.slip_sd;
    row.torque = reply.torque;
    row.pace = pace_in(messages.paces, step / n_s);
    row.executing = reply.executing;
    row.notified = reply.notified;
    row.remaining = reply.remaining;
    row.at_rest = reply.at_rest;
    row.solver_failures = reply.solver_failures;
    row.late_map = reply.late_map;
    row.late_odometry = reply.late_odometry;
    table.push_back(row);
  }
  return table;
}

std::vector<double> map_returns(const DriveMessages& messages, double dt, int n_s) {
  constexpr int kJumped = 2;  // positions in a row
  std::vector<double> times;
  bool lost = false, seen = false;
  std::int64_t step = 0, rejected = 0;  // of the newest position that was believed
  for (const map_report_t& m : messages.poses) {
    const bool valid = m.pose.valid != 0;
    const bool jumped = seen && m.pose.step > step && m.rejected - rejected >= kJumped;
    if (valid && (lost || jumped)) times.push_back(static_cast<double>(m.header.stamp) * n_s * dt);
    seen = seen || valid;
    lost = seen && !valid;
    if (m.pose.step == step) continue;
    step = m.pose.step;
    rejected = m.rejected;
  }
  return times;
}

DriveRecord::DriveRecord(link::Process& process, const std::string& platform)
    : command_in_(process.inbox<platform_command_t>(platform + ".command")),
      reply_in_(process.inbox<platform_reply_t>(platform + ".reply")),
      telemetry_in_(process.inbox<platform_telemetry_t>(platform + ".telemetry")),
      truth_in_(process.inbox<platform_truth_t>(platform + ".truth")),
      pose_in_(process.inbox<map_report_t>(pose_channel())),
      odometry_in_(process.inbox<odometry_reading_t>(platform + ".odometry")) {}

void DriveRecord::collect(std::int64_t plan) {
  link::take_all(*reply_in_, messages_.replies);
  link::take_all(*telemetry_in_, messages_.telemetry);
  link::take_all(*truth_in_, messages_.truths);
  link::take_all(*pose_in_, messages_.poses);
  link::take_all(*odometry_in_, messages_.odometry);
  collect_commands(plan);
}

void DriveRecord::collect_commands(std::int64_t plan) {
  while (const platform_command_t* const m = command_in_->next(commands_until_ + 1)) {
    commands_until_ = m->header.stamp;
    const PlatformCommand command = from_message(*m);
    messages_.paces.push_back({commands_until_, command.pace});
    const std::int64_t last = fragments_.empty() ? 0 : fragments_.back().fragment.number;
    // A fragment that was lost on its way is handed over again.
    if (command.instruction == Instruction::set && command.fragment.number > last)
      fragments_.push_back({command.fragment, m->header.stamp, plan});
  }
}

}  // namespace mrroc::rex_drive
