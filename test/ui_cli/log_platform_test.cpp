// `ui_cli log show` and `log plot` of a platform, of which the run has an agent without an effector beside it.
#include <cmath>

#include "base/link/log_reader.hpp"
#include "base/msg/convert_platform.hpp"
#include "test/ui_cli/run_folder.hpp"
#include "ui_cli/log/log_plot.hpp"
#include "ui_cli/log/platform_fields.hpp"

namespace mrroc::test {
namespace {

using ui::PlotOptions;

/// A platform drives along x with 0.5 m/s, 10 mm beside its reference; its estimate is in between. Its position is known from
/// macrostep 5 on; the truth of the last macrostep is not told.
class DrivenRun : public RunFolder {
 protected:
  DrivenRun() : run_(home_ / "drive") {
    fs::create_directories(run_);
    std::ofstream(run_ / "config.toml")
        << "[time]\nn_s = 10\n[robots]\norder = []\n[platforms]\norder = [\"rex\"]\n";
    link::EventLog to(run_ / link::kEventLog, 1);
    log(to, "supervisor", supervisor_t{}, 1, 1, 0);
    for (std::int64_t i = 1; i <= kMacrosteps; ++i) write_macrostep(to, i);
  }

  static void write_macrostep(link::EventLog& to, std::int64_t i) {
    const double x = 0.01 * static_cast<double>(i);
    Report r{.m = 2, .position_known = true};
    r.driver_state = DriverState::executing;
    log(to, "rex.report", to_message(r), 1, i, i);
    log(to, "map.report", to_message(Report{.m = 1}), 1, i, i);
    PlatformReply reply;
    reply.state = DriverState::executing;
    reply.position_known = i >= 5;
    reply.executing = 7;
    reply.estimate.step = 10 * i;
    reply.estimate.p = {x, 0.004, 0.1};
    reply.estimate.v.vx = 0.49;
    reply.slip = {0.68, 0.59, 0.01};
    reply.torque = {1, 2, 3, 4};
    log(to, "rex.reply", to_message(reply), 1, i, i);
    PlatformTelemetry telemetry;
    telemetry.reference[0] = {x, 0, 0.1};
    log(to, "rex.telemetry", to_message(telemetry), 1, i, i);
    if (i == kMacrosteps) return;
    PlatformTruth truth;
    truth.p = {x, 0.01, 0.1};
    truth.v.vx = 0.5;
    truth.friction = {{{0.8, 0.6}, {0.4, 0.6}, {0.8, 0.6}, {0.4, 0.6}}};
    log(to, "rex.truth", to_message(truth), 1, i, i);
  }

  [[nodiscard]] std::vector<ui::Sample> samples(const std::string& name) const {
    const ui::RunRecord run(run_);
    const auto fields = ui::chosen_fields(ui::platform_fields(""), {name});
    return ui::PlatformReadings(run, "rex").samples(fields.front(), 0, 100);
  }
  [[nodiscard]] std::string script(const PlotOptions& o) const {
    std::vector<ui::RunRecord> runs;
    runs.emplace_back(run_);
    return ui::plot_script(runs, o, "p.png");
  }
  [[nodiscard]] std::string error_of(const fs::path& folder, const PlotOptions& o) const {
    std::vector<ui::RunRecord> runs;
    runs.emplace_back(folder);
    try {
      return ui::plot_script(runs, o, "p.png");
    } catch (const FaultError& e) {
      return e.error_line();
    }
  }

  fs::path run_;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(DrivenRun, IsToldInThePlatformsWords) {
  ASSERT_EQ(run({"show", run_.string(), "--from", "0.4", "--to", "0.4"}), 0) << err_.str();
  EXPECT_TRUE(
      has(out_.str(), "x y    200.0      4.0 mm  phi    5.7 deg  v  0.490 m/s  mu  0.68  0.59  fragment 7"))
      << out_.str();
  EXPECT_FALSE(has(out_.str(), "x y z")) << out_.str();
  EXPECT_FALSE(has(out_.str(), " N\n")) << out_.str();
  for (const std::string& line : lines()) EXPECT_FALSE(has(line, " map ") && has(line, " mm")) << line;
}

TEST_F(DrivenRun, EveryChannelOfAPlatformHasTheTimeThatItsMessagesAreFor) {
  {
    const link::LogReader before(run_);
    link::EventLog to(run_ / link::kEventLog, 1);
    for (const link::LoggedMessage& m : before.messages()) to.receive("s." + m.channel, m.bytes);
    motion_capture_t seen{};
    seen.step = 150;
    log(to, "rex.motion_capture", seen, 1, 4, 3);
    odometry_reading_t pair{};
    pair.motion.step_before = 200;
    pair.motion.step = 240;
    log(to, "rex.odometry", pair, 1, 7, 6);
    platform_reading_t reading{};
    log(to, "rex.hardware_state", reading, 1, 71, 70);
    platform_drive_t drive{};
    log(to, "rex.hardware_command", drive, 1, 71, 70);
  }
  const auto first_time_of = [&](const std::string& channel) {
    EXPECT_EQ(run({"csv", run_.string(), channel}), 0) << err_.str();
    return lines().at(1).substr(0, lines().at(1).find(','));
  };
  EXPECT_EQ(first_time_of("rex.motion_capture"), "0.3");
  EXPECT_EQ(first_time_of("rex.odometry"), "0.48");
  EXPECT_EQ(first_time_of("rex.hardware_state"), "0.14");
  EXPECT_EQ(first_time_of("rex.hardware_command"), "0.14");
  for (const char* const channel : {"rex.truth", "rex.reply", "rex.telemetry", "rex.report"})
    EXPECT_EQ(first_time_of(channel), "0.02") << channel;
  ASSERT_EQ(run({"show", run_.string(), "--channel", "rex.motion_capture", "--from", "0.31"}), 0);
  EXPECT_EQ(out_.str(), "");
}

TEST_F(DrivenRun, HasNoDriverOfAnAgentWithoutAnEffector) {
  ASSERT_EQ(run({"show", run_.string(), "--m"}), 0) << err_.str();
  std::size_t drivers = 0;
  for (const std::string& line : lines()) drivers += has(line, "driver ") ? 1 : 0;
  EXPECT_EQ(drivers, 1U) << out_.str();
}

TEST_F(DrivenRun, HasFieldsFromTheFirstKnownPositionOn) {
  const auto track = samples("track");
  ASSERT_EQ(track.size(), static_cast<std::size_t>(kMacrosteps) - 4);
  EXPECT_NEAR(track.front().t, 0.1, 1e-12);
  EXPECT_NEAR(track.front().y, 10, 1e-9);
  EXPECT_TRUE(std::isnan(track.back().y)) << "nobody tells the truth of it";
  EXPECT_NEAR(samples("estimate").front().y, 6, 1e-9);
  EXPECT_NEAR(samples("phi_e").front().y, 0.1 * 180 / 3.14159265, 1e-6);
  EXPECT_NEAR(samples("true_mu_x").front().y, 0.6, 1e-12);
  EXPECT_NEAR(samples("true_split").front().y, 1. / 3, 1e-12) << "the left wheels have more";
  EXPECT_EQ(samples("tau_RL").front().y, 3);
  EXPECT_EQ(samples("vx_e").front().y, 0.49);
}

TEST_F(DrivenRun, ItsHeadingGoesOnWhereHalfATurnIsPassed) {
  run_ = home_ / "turn";
  fs::create_directories(run_);
  fs::copy_file(home_ / "drive" / "config.toml", run_ / "config.toml");
  {
    link::EventLog to(run_ / link::kEventLog, 1);
    log(to, "supervisor", supervisor_t{}, 1, 1, 0);
    for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
      const double phi = 3 + 0.02 * static_cast<double>(i);
      log(to, "rex.report", to_message(Report{.m = 2, .position_known = true}), 1, i, i);
      PlatformReply reply;
      reply.position_known = true;
      reply.estimate.step = 10 * i;
      reply.estimate.p.phi = wrap_angle(phi + 0.05);
      log(to, "rex.reply", to_message(reply), 1, i, i);
      PlatformTelemetry telemetry;
      telemetry.reference[0].phi = wrap_angle(phi);
      log(to, "rex.telemetry", to_message(telemetry), 1, i, i);
      PlatformTruth truth;
      truth.p.phi = wrap_angle(phi - 0.05);
      log(to, "rex.truth", to_message(truth), 1, i, i);
    }
  }
  constexpr double kDegrees = 180 / 3.14159265358979;
  for (const auto& [name, offset] : {std::pair{"phi_d", 0.0}, {"phi_e", 0.05}, {"phi", -0.05}}) {
    const auto all = samples(name);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(kMacrosteps)) << name;
    for (std::size_t k = 0; k < all.size(); ++k)
      EXPECT_NEAR(all[k].y, kDegrees * (3.02 + 0.02 * static_cast<double>(k) + offset), 1e-6) << name << k;
  }
}

TEST_F(DrivenRun, ItsAxesNameQuantityAndUnit) {
  const std::string path = script({.what = "path"});
  EXPECT_TRUE(has(path, "'heading [deg]'")) << path;
  EXPECT_TRUE(has(path, "'place on the map, x [m]'"));
  EXPECT_FALSE(has(path, "path [deg]"));
  EXPECT_TRUE(has(script({.what = "", .fields = {"phi_e"}}), "'heading [deg]'"));
}

TEST_F(DrivenRun, IsDrawnWithAPanelForEachQuantity) {
  for (const std::string& what : ui::platform_subjects())
    EXPECT_TRUE(has(script({.what = what}), "rex")) << what;
  const std::string slip = script({.what = "slip"});
  for (const char* part : {"rex: friction along the wheels", "rex: friction across the wheels",
                           "rex: split left and right", "t,mu_x,true_mu_x"})
    EXPECT_TRUE(has(slip, part)) << part;
  EXPECT_TRUE(has(script({.what = "", .fields = {"vx", "track"}}), "t,vx\n"));
}

TEST_F(DrivenRun, WhatThereIsNotOfAPlatformIsToldWithWhatThereIs) {
  EXPECT_TRUE(
      has(error_of(run_, {.what = "force"}),
          "tells of no arm; of its platform rex there are path, error, torques, slip, speeds, behaviours"))
      << error_of(run_, {.what = "force"});
  EXPECT_TRUE(
      has(error_of(a_, {.what = "slip"}), "tells of no platform; of its arm arm1 there are force, pose"))
      << error_of(a_, {.what = "slip"});
  EXPECT_TRUE(
      has(error_of(run_, {.what = "slip", .arms = {"map"}}), "has no platform 'map'; platforms: rex"));
}

}  // namespace
}  // namespace mrroc::test
