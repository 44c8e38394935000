#include "tasks/visual_servo/servo_run.hpp"

#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/program.hpp"

namespace mrroc::visual_servo {
namespace {

mp::SoloParameters solo_parameters(const Parameters& k, bool gives_start,
                                   std::optional<ServoRecord>& record) {
  mp::SoloParameters solo;
  solo.arms = {std::string(kArm)};
  solo.behaviours.resize(static_cast<std::size_t>(kFromMemory));
  const auto add = [&solo](const auto& row) {
    solo.behaviours[static_cast<std::size_t>(row.m - 1)] = {std::string(row.name), std::string(row.until)};
  };
  for (const Selectable& row : kBehaviours) add(row.motion);
  add(kGiveUp);
  solo.lasts = k.duration;
  solo.dt = k.pacing.dt;
  solo.n_s = k.pacing.n_s;
  solo.gives_start = gives_start;
  if (record) solo.watch = [&record] { record->collect(); };
  return solo;
}

}  // namespace

ServoRun::ServoRun(mp::TaskRun& run, const Parameters& parameters, bool gives_start, bool records)
    : k_(parameters),
      record_(records ? std::optional<ServoRecord>(std::in_place, run.process(), std::string(kArm))
                      : std::nullopt),
      solo_(run, solo_parameters(parameters, gives_start, record_)) {}

Outcome ServoRun::execute() {
  const Outcome o = solo_.execute();
  if (record_) record_->collect();
  return o;
}

ServoTable ServoRun::table(const Pose& D) const {
  return record_ ? join(record_->reports(), record_->truths(), k_.T_EGd, k_.pacing, D) : ServoTable{};
}

}  // namespace mrroc::visual_servo
