#include "edp/platform/reply.hpp"

#include <algorithm>

namespace mrroc::edp {

PlatformReply build_reply(const PlatformView& driver, const PlatformAnswer& answer,
                          const BasicProtocol<PlatformEffector>& protocol) noexcept {
  const bool commanded = answer.verdict != Verdict::none;
  PlatformReply reply;
  reply.session = commanded ? answer.session : protocol.owner().value_or(0);
  reply.number = answer.number;
  reply.verdict = answer.verdict;
  reply.fault = commanded ? answer.fault : driver.fault;
  if (answer.replay) {
    const PlatformReply& stored = protocol.stored();
    reply.session = stored.session;
    reply.number = stored.number;
    reply.verdict = stored.verdict;
    reply.fault = stored.fault;
  }
  reply.step = driver.step;
  reply.expected = protocol.expected();
  reply.state = driver.state;
  reply.accepted = driver.queue.accepted();
  reply.notified = driver.queue.notified();
  reply.executing = driver.queue.executing();
  reply.iteration = driver.queue.iteration();
  reply.remaining = driver.queue.remaining();
  const EstimatorResult& x = driver.observer.result();
  reply.estimate = x.estimate;
  reply.slip = x.slip;
  reply.slip_sd = x.slip_sd;
  reply.torque = driver.torque;
  reply.load = driver.load;
  reply.adapting = driver.observer.adapting();
  reply.position_known = driver.position_known;
  reply.at_rest = driver.at_rest;
  reply.late_odometry = driver.observer.late_odometry();
  reply.late_map = driver.observer.late_map();
  reply.rejected = driver.observer.rejected();
  reply.solver_failures = driver.observer.failures() + driver.follower.failures();
  return reply;
}

PlatformTelemetry build_telemetry(const PlatformView& driver) noexcept {
  PlatformTelemetry telemetry;
  telemetry.step = driver.step;
  std::ranges::transform(driver.reference, telemetry.reference.begin(), &PathPoint::p);
  telemetry.horizon.fill(driver.observer.result().estimate.p);
  telemetry.estimator_iterations = driver.observer.health().iterations;
  if (!driver.follows) return telemetry;
  const TrackerResult& planned = driver.follower.result();
  telemetry.horizon = planned.horizon;
  telemetry.torque = planned.torques;
  telemetry.tracker_iterations = planned.health.iterations;
  return telemetry;
}

}  // namespace mrroc::edp
