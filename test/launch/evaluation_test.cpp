// Figures and pictures from the traces of a run.
#include "launch/evaluation.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "base/link/event_log.hpp"
#include "base/link/log_reader.hpp"
#include "launch/force_picture.hpp"
#include "mrroc/supervisor_t.hpp"

namespace mrroc::launch {
namespace {

namespace fs = std::filesystem;

/// A coordinator that has been executed.
class Executed final : public mp::CoordinatorRun {
 public:
  explicit Executed(std::size_t rows) : traces_(2, mp::ArmTrace(rows)) {
    for (mp::ArmTrace& trace : traces_)
      for (std::size_t k = 0; k < rows; ++k) {
        trace[k].m = 1;
        trace[k].t = 0.02 * static_cast<double>(k);
      }
  }
  Outcome execute() override { return Outcome::terminated; }
  [[nodiscard]] const Fault& fault() const override { return fault_; }
  [[nodiscard]] std::span<const mp::ArmTrace> traces() const override { return traces_; }

 private:
  std::vector<mp::ArmTrace> traces_;
  Fault fault_;
};

class EvaluationTest : public testing::Test {
 protected:
  EvaluationTest() : folder_(fs::temp_directory_path() / ("mrroc_evaluation_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    write_log();
    evaluation_.behaviours = {{.name = "push"}};
    evaluation_.figures = [](const std::vector<mp::ArmTrace>& arms, const Config&) -> mp::TaskFigures {
      return {{{.key = "rows", .words = "rows of the first arm", .unit = ""},
               static_cast<double>(arms.at(0).size())}};
    };
    evaluation_.pictures = force_picture<Axis::z, 4>;
    evaluation_.result = [](const std::vector<mp::ArmTrace>&) { return std::string("found\n"); };
  }
  ~EvaluationTest() override { fs::remove_all(folder_); }

  /// A log that says no more than that the run is over.
  void write_log() const {
    supervisor_t m{};
    m.header = {1, 1, 0};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<supervisor_t>()));
    m.encode(bytes.data(), 0, link::encoded_size<supervisor_t>());
    link::EventLog log(folder_ / link::kEventLog, 1, 1 << 20);
    log.receive("s.supervisor", bytes);
  }

  /// Evaluates a run. @param rows  of each arm
  Results& run(std::size_t rows) {
    coordinator_.emplace(rows);
    results_.emplace(Results{.setup = setup_,
                             .arms = arms_,
                             .folder = folder_,
                             .coordinator = *coordinator_,
                             .summary = summary_});
    evaluate(evaluation_, *results_);
    return *results_;
  }

  fs::path folder_;
  launch::Setup setup_;
  std::vector<CellArm> arms_{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};
  mp::Summary summary_;
  Evaluation evaluation_;
  std::optional<Executed> coordinator_;
  std::optional<Results> results_;
};

TEST_F(EvaluationTest, FiguresPicturesAndTheResultAreMadeOfTheTraces) {
  summary_.task = "press_hard";
  const Results& r = run(50);
  EXPECT_EQ(std::get<double>(summary_.figures.at("rows")), 50);
  ASSERT_EQ(r.known.size(), 1U);
  EXPECT_EQ(r.known[0].key, "rows");
  EXPECT_EQ(r.columns, (std::vector<std::string_view>{"arm1", "arm2"}));
  EXPECT_EQ(r.remarks, "found\n");
  ASSERT_EQ(r.pictures.size(), 1U);
  const auto& [name, script] = r.pictures[0];
  EXPECT_EQ(name, "force");
  for (const char* part : {"plots/force.png", "press\\_hard", "push", "desired: 4 N"})
    EXPECT_NE(script.find(part), std::string::npos) << part << " is not in\n" << script;
}

TEST_F(EvaluationTest, ARunThatEndedWithAFaultHasFiguresAndNoResult) {
  summary_.fault = Fault{.code = FaultCode::operator_stop};
  const Results& r = run(50);
  EXPECT_TRUE(summary_.figures.contains("rows"));
  EXPECT_EQ(r.remarks, "");
  EXPECT_EQ(r.pictures.size(), 1U);
}

TEST_F(EvaluationTest, ARunThatWasStoppedTellsNoFiguresButThoseThatAreAlwaysTold) {
  Results& r = run(50);
  r.known.push_back({.key = "rest", .words = "until it rested", .unit = "", .high = 100, .always = true});
  summary_.figures["rest"] = 70.0;
  const auto tells = [&r](const char* words) {
    return ending_of(r).figures.find(words) != std::string::npos;
  };
  for (const char* words : {"until it rested", "rows of the first arm", "found"}) EXPECT_TRUE(tells(words));
  summary_.stopped = true;
  EXPECT_TRUE(tells("until it rested"));
  EXPECT_FALSE(tells("rows of the first arm"));
  EXPECT_FALSE(tells("found")) << "the task's remarks";
  summary_.figures.erase("rest");
  EXPECT_EQ(ending_of(r).figures, "");
  EXPECT_TRUE(summary_.figures.contains("rows")) << "it is in summary.json";
}

TEST_F(EvaluationTest, OfARunInWhichNoArmMovedThereIsNoPicture) {
  const Results& r = run(0);
  EXPECT_EQ(std::get<double>(summary_.figures.at("rows")), 0);
  EXPECT_TRUE(r.pictures.empty());
}

}  // namespace
}  // namespace mrroc::launch
