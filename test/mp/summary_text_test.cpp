// Text of a task that has ended.
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

TEST(EndingText, ARunThatWasStoppedTellsThePicturesThatWereDrawnOfIt) {
  EXPECT_EQ(
      ending_text(summary(Fault{.code = FaultCode::emergency_stop}, true), kEnding, {}),
      "\nstopped: 8.0 s simulated in 2.0 s (4.0 x real time)\n  force held [N]  4\npicture: force.png\n");
}

TEST(EndingText, ARunThatEndedWithAFaultTellsHowFarItCame) {
  const std::string text = ending_text(summary(Fault{.code = FaultCode::no_contact}), kEnding, {});
  EXPECT_NE(text.find("force held"), std::string::npos) << text;
}

TEST(EndingText, RecoverableFaultsAndTheBlackBoxAreNamedBeforeThePictures) {
  Summary s = summary(Fault{.code = FaultCode::no_contact});
  s.wall_s = 0;
  s.survived.push_back({.fault = {.code = FaultCode::over_current}, .sim_s = 1.234});
  s.black_box = {"arm1.csv", "mp.log"};
  EXPECT_EQ(ending_text(s, kEnding, {}),
            "\nended with a fault: 8.0 s simulated in 0.0 s (0.0 x real time)\n  force held [N]  4\n"
            "fault at 1.23 s, after which the task went on: " +
                describe(s.survived[0].fault) +
                "\nblack box, the last 5 s of every process: 2 files in the run folder, such as arm1.csv\n"
                "picture: force.png\n");
}

TEST(EndingText, AViewerThatHadNoTimeIsToldHowToSeeTheRun) {
  const std::string text = ending_text(summary(), kEnding, viewed(0, ClockKind::step));
  EXPECT_NE(text.find("press --view --speed 1`"), std::string::npos) << text;
  EXPECT_NE(text.find("ui_cli view runs/press-1`"), std::string::npos) << text;
  for (const TaskOptions& o : {TaskOptions{}, viewed(1, ClockKind::step), viewed(0, ClockKind::wall)})
    EXPECT_EQ(ending_text(summary(), kEnding, o).find("--speed"), std::string::npos);
}

struct Printed {
  int status;
  std::string out, err;
};

Printed printed(const Summary& summary, const FigureVerdict& verdict, bool strict) {
  Ending ending = kEnding;
  ending.verdict = verdict;
  TaskOptions options;
  options.strict = strict;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  Printed p{print_ending(summary, ending, options), {}, {}};
  p.out = ::testing::internal::GetCapturedStdout();
  p.err = ::testing::internal::GetCapturedStderr();
  return p;
}

constexpr const char* kMissed = "1 of 9 figures missed what is wanted: copy_rms_mm 29.1 (wanted <= 0.5)";

TEST(PrintedEnding, AMissedFigureIsToldBeforeTheFolderAndIsAnErrorOnlyIfThatIsWanted) {
  const FigureVerdict missed{.judged = 9, .missed = {"copy_rms_mm 29.1 (wanted <= 0.5)"}};
  for (const bool strict : {false, true}) {
    const Printed p = printed(summary(), missed, strict);
    EXPECT_EQ(p.status, strict ? 1 : 0);
    EXPECT_TRUE(p.out.ends_with(std::string("\ndone; ") + kMissed + "\nrun folder: runs/press-1\n")) << p.out;
    EXPECT_EQ(p.err.starts_with(std::string("error: figures_missed: ") + kMissed), strict) << p.err;
    EXPECT_EQ(p.err.empty(), !strict) << p.err;
  }
}

TEST(PrintedEnding, FiguresAsWantedAreToldAndNoErrorEither) {
  const Printed p = printed(summary(), {.judged = 9, .missed = {}}, true);
  EXPECT_EQ(p.status, 0);
  EXPECT_NE(p.out.find("\ndone; all 9 figures are as wanted\nrun folder"), std::string::npos) << p.out;
  EXPECT_EQ(p.err, "");
}

TEST(PrintedEnding, WhatAloneIsWantedStandsBeforeTheVerdict) {
  Ending ending = kEnding;
  ending.verdict = {.judged = 1, .missed = {}};
  ending.only = "nothing is wanted of this run but its end";
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(print_ending(summary(), ending, {}), 0);
  const std::string out = ::testing::internal::GetCapturedStdout();
  EXPECT_NE(out.find("\ndone; nothing is wanted of this run but its end: the figure is as wanted\n"),
            std::string::npos)
      << out;
}

TEST(PrintedEnding, ARunThatDidNotComeToItsEndIsNotJudged) {
  const Printed p =
      printed(summary(Fault{.code = FaultCode::no_contact}), {.judged = 9, .missed = {"x 1"}}, true);
  EXPECT_EQ(p.status, 1);
  EXPECT_EQ(p.out.find("done;"), std::string::npos) << p.out;
  EXPECT_TRUE(p.err.starts_with("error: no_contact: ")) << p.err;
}

}  // namespace
}  // namespace mrroc::mp
