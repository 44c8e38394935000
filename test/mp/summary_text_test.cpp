// What a task tells when it has ended.
#include "mp/summary_text.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

const Ending kEnding{.folder = "runs/press-1", .figures = "  force held [N]  4\n", .pictures = {"force.png"}};

/// 8 s of simulated time in 2 s.
Summary summary(std::optional<Fault> fault = {}, bool stopped = false) {
  Summary s;
  s.task = "press";
  s.fault = fault;
  s.stopped = stopped;
  s.sim_s = 8;
  s.wall_s = 2;
  return s;
}

TaskOptions viewed(double speed, ClockKind clock) {
  TaskOptions o;
  o.view = true;
  o.speed = speed;
  o.clock = clock;
  return o;
}

TEST(EndingText, ARunThatIsDoneTellsItsFiguresAndPictures) {
  EXPECT_EQ(ending_text(summary(), kEnding, {}),
            "\ndone: 8.0 s simulated in 2.0 s (4.0 x real time)\n  force held [N]  4\npicture: force.png\n");
}

TEST(EndingText, ARunThatWasStoppedTellsNoFigures) {
  EXPECT_EQ(ending_text(summary(Fault{.code = FaultCode::emergency_stop}, true), kEnding, {}),
            "\nstopped: 8.0 s simulated in 2.0 s (4.0 x real time)\n");
}

TEST(EndingText, ARunThatEndedWithAFaultTellsHowFarItCame) {
  const std::string text = ending_text(summary(Fault{.code = FaultCode::no_contact}), kEnding, {});
  EXPECT_NE(text.find("force held"), std::string::npos) << text;
}

TEST(EndingText, AViewerThatHadNoTimeIsToldHowToSeeTheRun) {
  const std::string text = ending_text(summary(), kEnding, viewed(0, ClockKind::step));
  EXPECT_NE(text.find("press --view --speed 1`"), std::string::npos) << text;
  EXPECT_NE(text.find("ui_cli view runs/press-1`"), std::string::npos) << text;
  for (const TaskOptions& o : {TaskOptions{}, viewed(1, ClockKind::step), viewed(0, ClockKind::wall)})
    EXPECT_EQ(ending_text(summary(), kEnding, o).find("--speed"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::mp
