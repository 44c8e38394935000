// Every key of the drawing task: which number it is, and how far that may go.
#include "tasks/drawing/config.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "base/text_file.hpp"

namespace mrroc::drawing {
namespace {

struct Number {
  const char* key;
  double least, most;
  bool whole;
  std::function<double(const Config&)> value;
};

const std::vector<Number>& numbers() {
  static const std::vector<Number> all{
      {"time.n_s", 2, 32, true, [](const Config& c) { return read_parameters(c).n_s; }},
      {"task.teach_force", 0, 5, false, [](const Config& c) { return read_parameters(c).teach_force; }},
      {"task.draw_force", 0.1, 5, false, [](const Config& c) { return read_parameters(c).draw_force; }},
      {"task.settle", 0, 500, true, [](const Config& c) { return read_parameters(c).settle; }},
      {"task.touch_timeout", 10, 10'000, true,
       [](const Config& c) { return read_parameters(c).touch_timeout; }},
      {"task.lift_off", 10, 250, true, [](const Config& c) { return read_parameters(c).lift_off; }},
      {"task.pause_macrosteps", 1, 100, true, [](const Config& c) { return read_parameters(c).pause; }},
      {"operator.start_height", 0.004, 0.03, false, [](const Config& c) { return read_hand_plan(c).height; }},
      {"operator.steady", 1, 500, true, [](const Config& c) { return read_hand_plan(c).steady; }}};
  return all;
}

Config with(const Number& n, double value) {
  Config config;
  config.set(n.whole ? fmt::format("{}={}", n.key, static_cast<int>(value))
                     : fmt::format("{}={:.6f}", n.key, value));
  return config;
}

TEST(DrawingConfig, EveryNumberIsThatOfItsKeyAndLeavesTheOthersAlone) {
  for (const Number& n : numbers())
    for (const double bound : {n.least, n.most}) {
      const Config config = with(n, bound);
      EXPECT_NEAR(n.value(config), bound, 1e-9) << n.key;
      for (const Number& other : numbers())
        if (other.key != n.key) {
          EXPECT_EQ(other.value(config), other.value(Config())) << other.key << " by " << n.key;
        }
    }
}

TEST(DrawingConfig, BeyondItsBoundsANumberIsRefused) {
  for (const Number& n : numbers()) {
    const double step = n.whole ? 1 : 1e-5;
    EXPECT_THROW((void)n.value(with(n, n.least - step)), ConfigError) << n.key;
    EXPECT_THROW((void)n.value(with(n, n.most + step)), ConfigError) << n.key;
  }
}

TEST(DrawingConfig, APauseTakesTenMacrostepsUnlessItIsSaid) {
  EXPECT_EQ(read_parameters(Config()).pause, 10);
}

TEST(DrawingConfig, TheHandBeginsWhereTheDrawingDoesOrWhereItIsTold) {
  EXPECT_EQ(read_hand_plan(Config(), {12, 34}).start, Point(12, 34));
  Config config;
  config.set("operator.start=[-500.0, 500.0]");
  EXPECT_EQ(read_hand_plan(config, {12, 34}).start, Point(-500, 500));
  for (const char* bad : {"operator.start=[-500.1, 0.0]", "operator.start=[0.0, 500.1]"}) {
    Config wrong;
    wrong.set(bad);
    EXPECT_THROW((void)read_hand_plan(wrong), ConfigError) << bad;
  }
}

TEST(DrawingConfig, WhatWasTaughtWithOtherMacrostepsIsRefusedWithBoth) {
  const auto refusal = [](double macrostep_s) -> std::string {
    Taught taught;
    taught.recording = Recording(macrostep_s);
    try {
      check_macrostep(taught, read_parameters(Config()), "old.taught");
    } catch (const FileError& e) {
      EXPECT_EQ(e.line(), 0);
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(0.02), "");
  EXPECT_EQ(refusal(0.02 + 5e-10), "");
  EXPECT_EQ(
      refusal(0.024),
      "old.taught: taught with macrosteps of 0.024 s, the task has 0.02 s; set time.n_s as it was, or teach "
      "anew");
  EXPECT_NE(refusal(0.018), "");
}

}  // namespace
}  // namespace mrroc::drawing
