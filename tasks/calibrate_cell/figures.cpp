#include "tasks/calibrate_cell/figures.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/calibrate_cell/calibrate_cell.hpp"

namespace mrroc::calibrate_cell {
namespace {

Wrench mean_reading(const mp::ArmTrace& trace, int m) {
  Wrench mean;
  for (const Axis a : kAxes) mean[a] = mp::mean_force(trace, a, m, HUGE_VAL);
  return mean;
}

/// @param end  behind the last row of a touch @return its mean over the readings
Touch touch_of(std::span<const mp::ArmRow> rows, const ProbePlan& plan, std::size_t n) {
  const auto readings = static_cast<std::size_t>(plan.readings);
  const auto last = rows.last(std::min(rows.size(), readings));
  Touch touch;
  Pose T_0E;
  for (const mp::ArmRow& row : last) {
    T_0E = pose_from_angle_axis(row.pose);
    touch.middle += middle_of_tip(plan, T_0E) / static_cast<double>(last.size());
  }
  touch.along = in_base(direction(n), T_0E.R);
  return touch;
}

std::optional<std::vector<BallFit>> balls_of(std::span<const Touch> touched, const ProbePlan& plan) {
  std::vector<BallFit> balls;
  if (touched.size() != touches(plan)) return {};
  for (std::size_t k = 0; k < plan.balls.size(); ++k) {
    std::vector<Vector3> middles;
    for (const Touch& t : touched.subspan(k * kTouchesPerBall, kTouchesPerBall)) middles.push_back(t.middle);
    const auto ball = fit_ball(middles, believed(plan, touched, k), plan.ball_radius + plan.tip_radius);
    if (!ball) return {};
    balls.push_back(*ball);
  }
  return balls;
}

std::vector<Vector3> centres(const std::vector<BallFit>& balls) {
  std::vector<Vector3> c;
  for (const BallFit& ball : balls) c.push_back(ball.centre);
  return c;
}

double worst_rms(const Calibration& found) {
  double worst = 0;
  for (const auto& balls : found.balls)
    for (const BallFit& ball : balls) worst = std::max(worst, ball.rms);
  return worst;
}

}  // namespace

std::vector<Touch> touches_of(const mp::ArmTrace& trace, const ProbePlan& plan) {
  std::vector<Touch> touched;
  const std::span<const mp::ArmRow> rows(trace);
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].m == kMeasure) ++end;
    if (end > first) touched.push_back(touch_of(rows.subspan(first, end - first), plan, touched.size()));
    first = end + 1;
  }
  return touched;
}

ecp::ForceTool tool_of(const mp::ArmTrace& trace) {
  return ecp::identified_tool(mean_reading(trace, kWithToolUp), mean_reading(trace, kWithToolSideways));
}

std::optional<Calibration> calibration_of(const std::vector<mp::ArmTrace>& traces,
                                          const std::array<ProbePlan, kArms>& plans) {
  Calibration found;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto balls = balls_of(touches_of(traces.at(arm), plans[arm]), plans[arm]);
    if (!balls) return {};
    found.balls[arm] = *balls;
  }
  const auto T_12 = fit_pose(centres(found.balls[0]), centres(found.balls[1]));
  if (!T_12) return {};
  found.T_12 = *T_12;
  return found;
}

double misfit(const Calibration& found) {
  constexpr double kOfBall = 4, kOfPose = 6;  // unknowns
  constexpr double kMorePerBall = kTouchesPerBall - kOfBall;
  double sum = 0, more = 0;
  for (const auto& balls : found.balls)
    for (const BallFit& ball : balls) {
      sum += kMorePerBall * ball.rms * ball.rms;
      more += kMorePerBall;
    }
  for (const double apart : found.T_12.residuals) {
    sum += apart * apart;
    more += 3;
  }
  return std::sqrt(sum / (more - kOfPose));
}

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& traces, const std::optional<Pose>& T_12,
                        const Bases& believed, const std::optional<Bases>& real) {
  PoseDistance before{NAN, NAN}, after{NAN, NAN};
  if (real) before = distance(relation(believed), relation(*real));
  if (real && T_12) after = distance(*T_12, relation(*real));
  std::vector<double> weights;
  for (const mp::ArmTrace& trace : traces) weights.push_back(trace.empty() ? NAN : tool_of(trace).w);
  return {{{.key = "base_err_mm",
            .words = "base of arm2 from that of arm1, off the truth",
            .unit = "mm",
            .high = 0.5},
           after.mm},
          {{.key = "base_err_deg", .words = "  its direction", .unit = "deg", .high = 0.05}, after.deg},
          {{"base_before_mm", "  as it was believed before", "mm"}, before.mm},
          {{"base_before_deg", "  its direction", "deg"}, before.deg},
          {{"tool_weight_N", "weight of the tools", "N"}, weights}};
}

mp::TaskFigures touch_figures(const std::optional<Calibration>& found) {
  return {{{"touch_rms_mm", "touches off the sphere of their ball, the worst ball", "mm rms"},
           found ? 1e3 * worst_rms(*found) : NAN},
          {{"balls_rms_mm", "balls as both arms found them, apart from each other", "mm rms"},
           found ? 1e3 * found->T_12.rms : NAN}};
}

}  // namespace mrroc::calibrate_cell
