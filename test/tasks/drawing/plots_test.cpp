#include "tasks/drawing/plots.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "mp/pictures.hpp"
#include "tasks/drawing/strokes.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

const Vector3 kSheet(0.9, 0, 0.1);

// Writes what a run that teaches and copies the arrow leaves behind, without simulating one.
class MadeUpRun {
 public:
  explicit MadeUpRun(std::filesystem::path folder, double t = 0) : folder_(std::move(folder)), t_(t) {}

  void teach(const Drawing& drawing) {
    for (const Stroke& stroke : drawing) {
      lead_to(stroke.front(), m_ == 1 ? 1 : 2);
      press(2);
      m_ = 2;
      draw(stroke, 2, 0.15);
    }
    rise(2);
    write_ink(folder_ / "input.csv", ink_of(drawing));
    write_ink(folder_ / "taught.csv", ink_);
  }

  [[nodiscard]] double now() const { return t_; }

  void copy(const Drawing& drawing, int arm) {
    ink_.clear();
    lead_to(drawing.front().front(), 3);
    for (const Stroke& stroke : drawing) {
      const Point away = stroke.front() - at_;
      for (int k = 0; k < 100; ++k) step(7, at_ + away / 100, 10, 0);
      for (int k = 0; k < 50; ++k) step(4, at_, 10 - 0.2 * k, 0);
      press(4);
      draw(stroke, 5, 0.02);
      for (int k = 0; k < 50; ++k) step(6, at_, 0.2 * k, k == 0 ? -3 : 0);
    }
    write_ink(folder_ / ("ink" + std::to_string(arm) + ".csv"), ink_);
    mp::write_arm_trace(folder_ / ("arm" + std::to_string(arm) + ".csv"), trace_);
  }

 private:
  void step(int m, const Point& to, double z, double force) {
    at_ = to;
    t_ += 0.02;
    mp::ArmRow& row = trace_.emplace_back();
    row.i = static_cast<std::int64_t>(trace_.size());
    row.t = t_;
    row.m = m;
    row.pose << kSheet.x() + to.y() / 1000, kSheet.y() - to.x() / 1000, kSheet.z() + z / 1000, 0, M_PI, 0;
    row.F[Axis::z] = force + noise_(random_);
  }
  void lead_to(const Point& to, int m) {
    const Point from = at_;
    for (int k = 0; k <= 100; ++k) {
      const double u = k / 100.0;
      step(m, from + (to - from) * u, 2 + 16 * std::sin(M_PI * std::min(1.0, u + 0.1)), 2 * std::sin(9 * u));
    }
  }
  void press(int m) {
    for (int k = 0; k < 25; ++k) step(m, at_, -0.2 * std::exp(-k / 3.0) - 0.1, 1 + 4 * std::exp(-k / 1.5));
    ++stroke_;
  }
  void draw(const Stroke& stroke, int m, double shake) {
    for (const Point& p : resampled(stroke, 0.4)) {
      step(m, p + shake * Point(noise_(random_), noise_(random_)) * 10, -0.1, 1);
      ink_.push_back({stroke_, t_, at_.x(), at_.y()});
    }
  }
  void rise(int m) {
    for (int k = 0; k < 30; ++k) step(m, at_, 0.4 * k, 2);
  }

  std::filesystem::path folder_;
  std::mt19937 random_{11};
  std::normal_distribution<double> noise_{0, 0.06};
  mp::ArmTrace trace_;
  Ink ink_;
  Point at_{-40, -50};
  double t_;
  int m_{1};
  int stroke_{-1};
};

bool have_gnuplot() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }

bool is_png(const std::filesystem::path& file) { return content(file).substr(1, 3) == "PNG"; }

/// Draws the pictures of a run folder. @return those that there are now
std::vector<std::filesystem::path> draw_run(const std::filesystem::path& folder, const PlotSetup& setup) {
  mp::draw(folder, plots(folder, setup));
  return mp::pictures_in(folder);
}

TEST(Plots, ARunGetsThePapersFiguresAndAPictureOfItsInk) {
  const Folder folder;
  MadeUpRun first(folder.path());
  first.teach(arrow());
  const double taught_s = first.now();
  first.copy(arrow(), 1);
  MadeUpRun(folder.path(), taught_s).copy(arrow(), 2);
  const auto pictures = draw_run(folder.path(), {{kSheet, kSheet}});
  for (const std::string name : {"fig8_trajectory", "fig9_height", "fig10_force", "drawing"})
    EXPECT_FALSE(content(folder / "plots" / (name + ".gp")).empty()) << name;
  if (!have_gnuplot()) GTEST_SKIP() << "without gnuplot only the scripts can be looked at";
  EXPECT_EQ(pictures.size(), 4u);
  for (const auto& picture : pictures) EXPECT_TRUE(is_png(picture)) << picture;
  EXPECT_FALSE(std::filesystem::exists(folder / "plots" / "gnuplot.log"));
  if (const char* keep = std::getenv("MRROC_KEEP_PLOTS"))
    std::filesystem::copy(
        folder.path(), keep,
        std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
}

TEST(Plots, TablesThatAreNotThereAreLeftOut) {
  const Folder folder;
  EXPECT_TRUE(draw_run(folder.path(), {}).empty());
  MadeUpRun(folder.path()).copy(arrow(), 1);  // a run without teach-in and without the second arm
  draw_run(folder.path(), {{kSheet, kSheet}});
  EXPECT_EQ(content(folder / "plots" / "fig9_height.gp").find("arm2"), std::string::npos);
  EXPECT_EQ(content(folder / "plots" / "fig9_height.gp").find("teach-in: "), std::string::npos);
  EXPECT_EQ(content(folder / "plots" / "gnuplot.log"), "");
}

TEST(Plots, ARunThatEndedEarlyGetsWhatThereIs) {
  const Folder folder;
  mp::ArmTrace trace(30);
  for (std::size_t k = 0; k < trace.size(); ++k) {
    trace[k].t = 0.02 * static_cast<double>(k);
    trace[k].m = k < 10 ? 0 : 1;  // it never reached the paper
  }
  mp::write_arm_trace(folder / "arm1.csv", trace);
  mp::write_arm_trace(folder / "arm2.csv", {});
  write_ink(folder / "ink1.csv", {});
  write_ink(folder / "input.csv", ink_of({{Point(3, 4)}}));
  const auto pictures = draw_run(folder.path(), {});
  EXPECT_EQ(content(folder / "plots" / "gnuplot.log"), "");
  if (have_gnuplot()) {
    EXPECT_EQ(pictures.size(), 4u);
  }
  std::filesystem::remove_all(folder.path() / "plots");
  mp::write_arm_trace(folder / "arm1.csv", mp::ArmTrace(3));  // not even that
  draw_run(folder.path(), {});
  EXPECT_EQ(content(folder / "plots" / "gnuplot.log"), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "plots" / "fig9_height.gp"));
}

TEST(Plots, ADamagedTableIsNamed) {
  const Folder folder;
  std::ofstream(folder / "arm1.csv") << "i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked\n1,2,3\n";
  EXPECT_THROW((void)plots(folder.path(), {}), FileError);
}

TEST(ArmTrace, ReadsBack) {
  const Folder folder;
  mp::ArmRow row{7, 0.14, 5, {}, {{1, 2, 3, 0.1, 0.2, 0.3}}, std::nullopt, 0.05, true};
  row.pose << 0.9, -0.1, 0.1234567, 0.1, 3.1, 0;
  mp::write_arm_trace(folder / "a.csv", {row});
  const mp::ArmTrace read = mp::read_arm_trace(folder / "a.csv");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].i, 7);
  EXPECT_EQ(read[0].m, 5);
  EXPECT_NEAR((read[0].pose - row.pose).norm(), 0, 1e-7);
  EXPECT_EQ(read[0].F, row.F);
  EXPECT_EQ(read[0].gap, 0.05);
  EXPECT_TRUE(read[0].blocked);
}

}  // namespace
}  // namespace mrroc::drawing
