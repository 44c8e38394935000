// A coordinator that lets its arms work.
#include "mp/solo_run.hpp"

#include <gtest/gtest.h>

#include <map>

#include "test/mp/coordinator_rig.hpp"

namespace mrroc::mp {
namespace {

constexpr int kWork = 5;  // macrosteps, of which the last one tells that it is done

class SoloRunTest : public CoordinatorRig {
 protected:
  /// Arms that execute behaviour 3 when they may, for so long.
  [[nodiscard]] SoloParameters parameters() {
    SoloParameters p;
    p.arms = arms;
    p.behaviours = {{"one"}, {"two"}, {"three"}};
    p.watch = [this] {
      ++i_;
      const auto* order = orders_->newest();
      if (order && order->m == static_cast<int>(SoloOrder::work)) ++worked_;
      Report r{.ready = true};
      if (worked_ > 0) r.m = 3;
      if (worked_ >= kWork) r.event = kWorkDone;
      report_all(i_, r);
    };
    return p;
  }

  std::unique_ptr<link::Inbox<agent_order_t>> orders_{process.inbox<agent_order_t>("arm1.order")};
  std::int64_t i_{2};  // macrostep of the last report
  int worked_{};
};

TEST_F(SoloRunTest, ItsSensorIsAskedOfWhatTheArmsReportWhileTheyWorkAndOfNothingBefore) {
  const auto asked = process.inbox<sensor_setting_t>("camera.setting");
  SoloParameters p = parameters();
  p.sensor = "camera.setting";
  p.ask = [](std::span<const Report> agents) {
    return SensorSetting{.mode = agents[0].m, .value = {10. * agents[1].m}};
  };
  std::map<std::int64_t, SensorSetting> said;
  const auto reports = p.watch;
  p.watch = [&] {
    if (const auto* m = asked->newest()) said[m->header.stamp] = from_message(*m);
    reports();
  };
  SoloRun coordinator(*run, p);
  for (const std::int64_t i : {1, 2}) report_all(i);
  EXPECT_EQ(coordinator.execute(), Outcome::terminated);
  ASSERT_GE(said.size(), static_cast<std::size_t>(kWork));
  EXPECT_EQ(said.begin()->second, SensorSetting{}) << "the arms wait";
  const SensorSetting last = said.rbegin()->second;
  EXPECT_EQ(last.mode, 3);
  EXPECT_EQ(last.value[0], 30);
}

TEST_F(SoloRunTest, WhoAsksNothingHasNoLinkToASensor) {
  const auto asked = process.inbox<sensor_setting_t>("camera.setting");
  SoloRun coordinator(*run, parameters());
  for (const std::int64_t i : {1, 2}) report_all(i);
  EXPECT_EQ(coordinator.execute(), Outcome::terminated);
  EXPECT_EQ(coordinator.traces().size(), arms.size());
  EXPECT_FALSE(asked->newest());
}

}  // namespace
}  // namespace mrroc::mp
