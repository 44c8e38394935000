#include "ui_cli/log/platform_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/msg/convert_platform.hpp"
#include "mrroc/agent_report_t.hpp"

namespace mrroc::ui {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Row = PlatformRow;

double distance(const PlanarPose& a, const PlanarPose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Friction of the ground below the wheels, along or across them, on one side.
double side(const Row& r, std::size_t along, std::size_t wheel) {
  return (r.truth.friction[wheel][along] + r.truth.friction[wheel + 2][along]) / 2;
}
double true_mu(const Row& r, std::size_t along) {
  return r.has_truth ? (side(r, along, 0) + side(r, along, 1)) / 2 : kUnknown;
}
double true_split(const Row& r) {
  const double sum = side(r, 0, 0) + side(r, 0, 1);
  return r.has_truth && sum > 0 ? (side(r, 0, 0) - side(r, 0, 1)) / sum : kUnknown;
}

// Quantities: fields of one share a chart.
constexpr const char* kPlaceX = "place on the map, x";
constexpr const char* kPlaceY = "place on the map, y";
constexpr const char* kHeading = "heading";
constexpr const char* kErrors = "distance of the true place";
constexpr const char* kTorques = "torques of the wheels";
constexpr const char* kLoads = "loads of the wheels";
constexpr const char* kAlong = "friction along the wheels";
constexpr const char* kAcross = "friction across the wheels";
constexpr const char* kSplit = "split left and right";
constexpr const char* kSpread = "standard deviations of the slip";
constexpr const char* kForward = "speed forward";
constexpr const char* kLeftward = "speed to the left";
constexpr const char* kTurnRate = "turn rate";
constexpr const char* kWheelSpeeds = "speeds of the wheels";

constexpr auto kTorque = [](const Row& r, std::size_t k) { return r.reply.torque[k]; };
constexpr auto kLoad = [](const Row& r, std::size_t k) { return r.reply.load[k]; };
constexpr auto kWheelSpeed = [](const Row& r, std::size_t k) { return r.reply.estimate.theta_dot[k]; };

/// A field with its name in platform.csv, where it has one.
struct Kind {
  const char* subject;
  const char* name;
  const char* legend;
  const char* quantity;
  const char* unit;
  double scale;
  bool usual;
  double (*value)(const Row&, std::size_t);
  std::size_t index{};
};

// clang-format off
constexpr std::array kKinds{
    Kind{"path", "x_d", "reference", kPlaceX, "m", 1, true, [](const Row& r, std::size_t) { return r.reference.x; }},
    Kind{"path", "x", "true", kPlaceX, "m", 1, true, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.p.x : kUnknown; }},
    Kind{"path", "x_e", "estimate", kPlaceX, "m", 1, true, [](const Row& r, std::size_t) { return r.reply.estimate.p.x; }},
    Kind{"path", "y_d", "reference", kPlaceY, "m", 1, true, [](const Row& r, std::size_t) { return r.reference.y; }},
    Kind{"path", "y", "true", kPlaceY, "m", 1, true, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.p.y : kUnknown; }},
    Kind{"path", "y_e", "estimate", kPlaceY, "m", 1, true, [](const Row& r, std::size_t) { return r.reply.estimate.p.y; }},
    Kind{"path", "phi_d", "reference", kHeading, "deg", kDegrees, true, [](const Row& r, std::size_t) { return r.reference.phi; }},
    Kind{"path", "phi", "true", kHeading, "deg", kDegrees, true, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.p.phi : kUnknown; }},
    Kind{"path", "phi_e", "estimate", kHeading, "deg", kDegrees, true, [](const Row& r, std::size_t) { return r.reply.estimate.p.phi; }},
    Kind{"error", "track", "from the reference", kErrors, "mm", 1e3, true, [](const Row& r, std::size_t) { return r.has_truth ? distance(r.truth.p, r.reference) : kUnknown; }},
    Kind{"error", "estimate", "from the estimate", kErrors, "mm", 1e3, true, [](const Row& r, std::size_t) { return r.has_truth ? distance(r.truth.p, r.reply.estimate.p) : kUnknown; }},
    Kind{"torques", "tau_FL", "front left", kTorques, "N m", 1, true, kTorque, 0},
    Kind{"torques", "tau_FR", "front right", kTorques, "N m", 1, true, kTorque, 1},
    Kind{"torques", "tau_RL", "rear left", kTorques, "N m", 1, true, kTorque, 2},
    Kind{"torques", "tau_RR", "rear right", kTorques, "N m", 1, true, kTorque, 3},
    Kind{"torques", "N_FL", "front left", kLoads, "N", 1, false, kLoad, 0},
    Kind{"torques", "N_FR", "front right", kLoads, "N", 1, false, kLoad, 1},
    Kind{"torques", "N_RL", "rear left", kLoads, "N", 1, false, kLoad, 2},
    Kind{"torques", "N_RR", "rear right", kLoads, "N", 1, false, kLoad, 3},
    Kind{"slip", "mu_x", "estimate", kAlong, "", 1, true, [](const Row& r, std::size_t) { return r.reply.slip.mu_x; }},
    Kind{"slip", "true_mu_x", "true", kAlong, "", 1, true, true_mu, 0},
    Kind{"slip", "mu_y", "estimate", kAcross, "", 1, true, [](const Row& r, std::size_t) { return r.reply.slip.mu_y; }},
    Kind{"slip", "true_mu_y", "true", kAcross, "", 1, true, true_mu, 1},
    Kind{"slip", "split", "estimate", kSplit, "", 1, true, [](const Row& r, std::size_t) { return r.reply.slip.split; }},
    Kind{"slip", "true_split", "true", kSplit, "", 1, true, [](const Row& r, std::size_t) { return true_split(r); }},
    Kind{"slip", "sd_mu_x", "along", kSpread, "", 1, false, [](const Row& r, std::size_t) { return r.reply.slip_sd.mu_x; }},
    Kind{"slip", "sd_mu_y", "across", kSpread, "", 1, false, [](const Row& r, std::size_t) { return r.reply.slip_sd.mu_y; }},
    Kind{"slip", "sd_split", "split", kSpread, "", 1, false, [](const Row& r, std::size_t) { return r.reply.slip_sd.split; }},
    Kind{"speeds", "vx", "true", kForward, "m/s", 1, true, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.v.vx : kUnknown; }},
    Kind{"speeds", "vx_e", "estimate", kForward, "m/s", 1, true, [](const Row& r, std::size_t) { return r.reply.estimate.v.vx; }},
    Kind{"speeds", "vy", "true", kLeftward, "m/s", 1, false, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.v.vy : kUnknown; }},
    Kind{"speeds", "vy_e", "estimate", kLeftward, "m/s", 1, false, [](const Row& r, std::size_t) { return r.reply.estimate.v.vy; }},
    Kind{"speeds", "w", "true", kTurnRate, "rad/s", 1, true, [](const Row& r, std::size_t) { return r.has_truth ? r.truth.v.w : kUnknown; }},
    Kind{"speeds", "w_e", "estimate", kTurnRate, "rad/s", 1, true, [](const Row& r, std::size_t) { return r.reply.estimate.v.w; }},
    Kind{"speeds", "theta_dot_FL", "front left", kWheelSpeeds, "rad/s", 1, false, kWheelSpeed, 0},
    Kind{"speeds", "theta_dot_FR", "front right", kWheelSpeeds, "rad/s", 1, false, kWheelSpeed, 1},
    Kind{"speeds", "theta_dot_RL", "rear left", kWheelSpeeds, "rad/s", 1, false, kWheelSpeed, 2},
    Kind{"speeds", "theta_dot_RR", "rear right", kWheelSpeeds, "rad/s", 1, false, kWheelSpeed, 3},
    Kind{"behaviours", "m", "", "behaviours", "", 1, true, [](const Row& r, std::size_t) { return static_cast<double>(r.m); }}};
// clang-format on

/// @return the angle, turned around until it is the one nearest to another
double near_to(double other, double angle) { return other + wrap_angle(angle - other); }

/// Headings that go on where half a turn is passed, and of one row all on the same turn.
void unwrap_headings(std::vector<Row>& rows) {
  double before = 0;
  for (Row& row : rows) {
    row.reference.phi = near_to(before, row.reference.phi);
    row.reply.estimate.p.phi = near_to(row.reference.phi, row.reply.estimate.p.phi);
    row.truth.p.phi = near_to(row.reference.phi, row.truth.p.phi);
    before = row.reference.phi;
  }
}

}  // namespace

const std::vector<std::string>& platform_subjects() {
  static const std::vector<std::string> names{"path", "error", "torques", "slip", "speeds", "behaviours"};
  return names;
}

std::vector<PlotField> platform_fields(const std::string& subject) {
  std::vector<PlotField> all;
  for (const Kind& kind : kKinds) {
    if (!subject.empty() && subject != kind.subject) continue;
    PlotField f;
    f.name = kind.name;
    f.legend = kind.legend;
    f.subject = kind.subject;
    f.quantity = kind.quantity;
    f.unit = kind.unit;
    f.source = f.subject == "behaviours" ? FieldSource::behaviour : FieldSource::pose;
    f.index = kind.index;
    f.scale = kind.scale;
    f.usual = kind.usual;
    f.of_platform = kind.value;
    all.push_back(f);
  }
  return all;
}

PlatformReadings::PlatformReadings(const RunRecord& run, const std::string& platform) {
  const auto reports = run.log().messages<agent_report_t>(platform + ".report");
  const auto telemetry = run.log().messages<platform_telemetry_t>(platform + ".telemetry");
  const auto truths = run.log().messages<platform_truth_t>(platform + ".truth");
  const auto steps = static_cast<std::int64_t>(std::llround(run.macrostep_s() / run.step_s()));
  for (const auto& [stamp, message] : run.log().messages<platform_reply_t>(platform + ".reply")) {
    const auto thought = telemetry.find(stamp);
    if (message.position_known == 0 || thought == telemetry.end()) continue;
    PlatformRow row;
    row.t = static_cast<double>(stamp) * run.macrostep_s();
    row.reply = from_message(message);
    row.reference = from_message(thought->second).reference.front();
    if (const auto report = reports.find(stamp); report != reports.end()) row.m = report->second.m;
    // Truth is told at the beginnings of macrosteps, which is when estimates are of.
    const std::int64_t step = row.reply.estimate.step;
    if (const auto truth = truths.find(step / steps); step % steps == 0 && truth != truths.end()) {
      row.has_truth = true;
      row.truth = from_message(truth->second);
    }
    rows_.push_back(row);
  }
  unwrap_headings(rows_);
}

std::vector<Sample> PlatformReadings::readings(const PlotField& field, double from, double to) const {
  std::vector<Sample> samples;
  for (const PlatformRow& row : rows_)
    if (row.t >= from && row.t <= to)
      samples.push_back({row.t, field.scale * field.of_platform(row, field.index)});
  return samples;
}

}  // namespace mrroc::ui
