#include "tasks/guide/config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tasks/guide/hand_way.hpp"

namespace mrroc::guide {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTool =
    "[robots.arm1.tool]\npose = [0, 0, 0.25, 0, 0, 0]\nweight = 10\nmass_centre = [0, 0, 0.1]\n";

std::shared_ptr<const Setup> setup_of(const std::vector<std::string>& settings) {
  Config config = Config::parse(kTool, "test");
  for (const std::string& s : settings) config.set(s);
  return read_setup(config, "arm1");
}

std::string refusal(const std::vector<std::string>& settings) {
  try {
    std::ignore = setup_of(settings);
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    return e.what();
  }
  return "";
}

class SvgFile {
 public:
  explicit SvgFile(const std::string& content)
      : name_((fs::temp_directory_path() / ("guide_" + std::to_string(::getpid()) + ".svg")).string()) {
    std::ofstream(name_) << content;
  }
  ~SvgFile() { fs::remove(name_); }
  SvgFile(const SvgFile&) = delete;
  SvgFile& operator=(const SvgFile&) = delete;
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
};

std::string usage_error(const std::string& fixture, std::optional<double> size = {}, int stroke = 0) {
  try {
    std::ignore = fixture_settings(fixture, size, stroke);
  } catch (const FaultError& e) {
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GuideConfig, HasEveryKindOfFixture) {
  EXPECT_NEAR(setup_of({})->fixture.curve()->length(), 0.12, 1e-9);
  EXPECT_TRUE(setup_of({"task.fixture=plane"})->fixture.is_plane());
  EXPECT_TRUE(setup_of({"task.fixture=circle"})->fixture.curve()->closed());
  EXPECT_FALSE(setup_of({"task.fixture=circle", "task.arc=180"})->fixture.curve()->closed());
  EXPECT_FALSE(setup_of({"task.fixture=curve", "task.curve=[0,0,50,0,50,50]"})->fixture.curve()->closed());
  EXPECT_TRUE(
      setup_of({"task.fixture=curve", "task.curve=[0,0,50,0,50,50,0,50,0,0]"})->fixture.curve()->closed());
}

TEST(GuideConfig, RefusesCurvesThatAreNone) {
  EXPECT_TRUE(has(refusal({"task.fixture=curve"}), "0 numbers are no curve"));
  EXPECT_TRUE(has(refusal({"task.fixture=curve", "task.curve=[0,0,50]"}), "3 numbers"));
  EXPECT_TRUE(has(refusal({"task.fixture=curve", "task.curve=[0,0,1,0]"}), "shorter than 5 mm"));
  EXPECT_TRUE(has(refusal({"task.fixture=curve", "task.curve=[0,0,50,0,0,1]"}), "too sharply at (4"));
  EXPECT_TRUE(has(refusal({"task.fixture=curve", "task.curve=[0,0,900,0]"}), "task.curve"));
  EXPECT_TRUE(has(refusal({"task.fixture=square"}), "task.fixture"));
}

TEST(GuideConfig, RefusesALawThatWouldSwing) {
  EXPECT_EQ(refusal({"task.stiffness=30000"}), "");
  EXPECT_TRUE(has(refusal({"task.stiffness=40000"}), "may swing"));
  EXPECT_TRUE(has(refusal({"task.stiffness=1000", "task.wall_stiffness=40000"}), "may swing"));
  EXPECT_EQ(refusal({"task.stiffness=40000", "task.mobility=0.0005"}), "");
  EXPECT_TRUE(has(refusal({"task.mobility=0.01", "task.free_mobility=0.005"}), "above task.free_mobility"));
}

TEST(GuideConfig, HasBoundsForEveryNumber) {
  for (const char* bad :
       {"length=0.01",     "width=0.5",        "radius=0.001",    "arc=5",          "arc=361",
        "corner=-0.1",     "stiffness=100",    "mobility=0.0",    "inertia=0.1",    "free_mobility=0.1",
        "free_inertia=50", "wall_stiffness=1", "wall_softness=0", "most_force=100", "capture=0.1",
        "entry=0.1",       "leave=11",         "entry_speed=1",   "centre=[0,0]",   "centre=[0,0,9]",
        "turned=[0,0,7]"})
    EXPECT_NE(refusal({std::string("task.") + bad}), "") << bad;
}

TEST(GuideConfig, TakesTheOnlyStrokeOfAFileOrTheOneThatIsChosen) {
  const SvgFile one("<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 L100 0 L100 50'/></svg>");
  const auto settings = fixture_settings(one.name(), 100, 0);
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0], "task.fixture=curve");
  EXPECT_NEAR(setup_of(settings)->fixture.curve()->length(), 0.15, 0.003);
  const SvgFile two(
      "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 L100 0'/><path d='M0 50 L60 50'/></svg>");
  EXPECT_TRUE(has(usage_error(two.name()), "has 2 strokes"));
  EXPECT_NEAR(setup_of(fixture_settings(two.name(), 100, 2))->fixture.curve()->length(), 0.06, 1e-4);
  EXPECT_TRUE(has(usage_error(two.name(), {}, 3), "no stroke 3"));
}

TEST(GuideConfig, TellsWhatIsWrongWithAFile) {
  EXPECT_NE(usage_error("no_such_file.svg"), "");
  EXPECT_NE(usage_error(SvgFile("").name()), "");
  for (const char* text :
       {"", "<svg", "<html/>", "<svg xmlns='http://www.w3.org/2000/svg'/>", "\xff\xfe\x00\x01",
        "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 Lnan 5'/></svg>"}) {
    const SvgFile bad(text);
    EXPECT_NE(usage_error(bad.name()), "") << text;
  }
  EXPECT_TRUE(has(usage_error("spiral"), "no such fixture"));
  EXPECT_TRUE(has(usage_error("line", 100), "--size and --stroke"));
  EXPECT_TRUE(has(usage_error("", {}, 2), "--size and --stroke"));
  EXPECT_NE(usage_error(SvgFile("<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 L9 9'/></svg>").name(),
                        1000),
            "");
}

TEST(HandWay, BeginsAndGoesOnWithoutAJumpAndComesToBothEnds) {
  OperatorPlan plan;
  plan.compliance = 1e-3;
  for (const char* shape : {"line", "plane", "circle"}) {
    const auto k = setup_of({std::string("task.fixture=") + shape});
    const auto way = hand_way(*k, plan);
    double beyond = 0;
    for (std::size_t n = 1; n < way.size(); ++n) {
      EXPECT_NEAR(way[n].t - way[n - 1].t, 0.01, 1e-9);
      ASSERT_LT((way[n].p - way[n - 1].p).norm(), 1.3e-3) << shape << " at " << way[n].t;
      beyond = std::max(beyond, std::abs(k->fixture.stand(way[n].p, {}).beyond[0]));
    }
    EXPECT_EQ(beyond > 0.015, shape != std::string("circle")) << "as far as 15 N take the hand";
    EXPECT_NEAR(k->fixture.stand(way.front().p, {}).distance(), plan.start, 1e-3);
    EXPECT_LT(k->fixture.stand(way.back().p, {}).distance(), 1e-3) << "it ends without a push";
  }
}

TEST(HandWay, SlowsDownBeforeNarrowBendsAndPullsTheDampedToolThroughThemNoHarder) {
  OperatorPlan plan;
  plan.compliance = 1e-3;
  plan.push = 0;
  const auto k = setup_of({"task.fixture=curve", "task.curve=[-45,-20,-15,20,15,-20,45,20]"});
  const auto way = hand_way(*k, plan);
  const Curve& curve = *k->fixture.curve();
  double before = 0;
  int slow = 0, quick = 0;
  for (std::size_t n = 1; n < way.size(); ++n) {
    const Standing s = k->fixture.stand(way[n].p, {});
    const double speed = (way[n].p - way[n - 1].p).norm() / 0.01;
    if (s.off() > 1e-4 || s.beyond[0] != 0) {  // not on the fixture yet, or at its ends
      before = speed;
      continue;
    }
    ASSERT_LE(speed, plan.speed * 1.001);
    ASSERT_GE(speed - before, -1.5 * plan.acceleration * 0.01 - 1e-3) << "he brakes in time, at " << way[n].t;
    const double share = std::min(1.0, curve.narrowest(s.s) / k->law.bend);
    if (share < 0.5) {
      ASSERT_LE(speed, 1.15 * share * plan.speed + 1e-3) << way[n].t;
    }
    slow += speed > 0 && share < 0.5;
    quick += speed > 0.99 * plan.speed;
    before = speed;
  }
  EXPECT_GT(slow, 100);
  EXPECT_GT(quick, 100) << "elsewhere he is as quick as ever";
}

}  // namespace
}  // namespace mrroc::guide
