#include "mp/trace_recorder.hpp"

#include "base/latency.hpp"

namespace mrroc::mp {
namespace {

/// How old a number is, in macrosteps of the coordinator, when the reports are about the motion that belongs to it. A number
/// of the coordinator is that of what was decided in the macrostep before; a report brings its agent's number as the command's
/// way begins.
constexpr std::size_t age_of(TraceNumbers numbers) {
  return static_cast<std::size_t>(numbers == TraceNumbers::coordinator ? latency::kLoop - latency::kMessage
                                                                       : latency::kCommandToReply);
}

}  // namespace

TraceRecorder::TraceRecorder(std::size_t arms, TraceNumbers numbers, double dt, int n_s)
    : numbers_(numbers), dt_(dt), n_s_(n_s), kept_(age_of(numbers) + 1), told_(arms), reports_(arms) {}

void TraceRecorder::note(std::int64_t i, int m, std::span<const Report> reports) {
  i_ = i;
  for (std::size_t arm = 0; arm < told_.size(); ++arm) {
    reports_[arm] = reports[arm];
    told_[arm].push_front(numbers_ == TraceNumbers::coordinator ? m : reports[arm].m);
    if (told_[arm].size() > kept_) told_[arm].pop_back();
  }
}

int TraceRecorder::executed(std::size_t arm) const {
  return told_[arm].size() == kept_ ? told_[arm].back() : 0;
}

double TraceRecorder::measured_at(std::int64_t i) const {
  return static_cast<double>(i - latency::kMotionToReport) * n_s_ * dt_ + (n_s_ - 1) * dt_;
}

void TraceRecorder::add_rows(std::span<ArmTrace> traces) const {
  for (std::size_t arm = 0; arm < told_.size(); ++arm) {
    const Report& r = reports_[arm];
    if (!r.ready) continue;
    ArmRow& row = traces[arm].emplace_back();
    row.i = i_;
    row.t = measured_at(i_);
    row.m = executed(arm);
    row.pose = Eigen::Map<const Vector6>(r.T_0E.data());
    row.F = r.F_a;
    row.gap = r.gripper;
    row.blocked = r.blocked;
  }
}

}  // namespace mrroc::mp
