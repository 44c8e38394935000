// What is written down about a drive, number by number.
#include "tasks/rex_drive/drive_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace mrroc::rex_drive {
namespace {

namespace fs = std::filesystem;

class DriveTableTest : public ::testing::Test {
 protected:
  DriveTableTest() {
    std::string pattern = (fs::temp_directory_path() / "drive_table.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~DriveTableTest() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path file() const { return folder_ / "table.csv"; }
  [[nodiscard]] std::string text() const {
    std::ifstream in(file());
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_;
};

/// A row in which no two numbers are the same.
DriveRow a_row() {
  DriveRow r;
  r.t = 1.5;
  r.reference = {10, 20, 0.1};
  r.truth.p = {13, 24, 0.2};
  r.truth.v = {0.3, 0.4, 0.5};
  r.truth.load = {101, 102, 103, 104};
  r.truth.friction = {{{0.2, 0.3}, {0.6, 0.7}, {0.4, 0.5}, {0.8, 0.9}}};
  r.estimate.p = {13, 25, 0.25};
  r.estimate.covariance = {1, 2, 3, 2, 4, 5, 3, 5, 6};
  r.slip = {0.71, 0.72, 0.73};
  r.slip_sd = {0.81, 0.82, 0.83};
  r.torque = {-1, -2, -3, -4};
  r.executing = 7;
  r.remaining = 42;
  return r;
}

TEST_F(DriveTableTest, HasEveryNumberInItsColumn) {
  write_drive_table(file(), {a_row()});
  EXPECT_EQ(
      text(),
      "t,x_d,y_d,phi_d,x,y,phi,vx,vy,w,x_e,y_e,phi_e,var_x,cov_xy,var_y,var_phi,mu_x,mu_y,split,sd_mu_x,sd_"
      "mu_y,"
      "sd_split,true_mu_x,true_mu_y,true_split,tau_FL,tau_FR,tau_RL,tau_RR,N_FL,N_FR,N_RL,N_RR,track_mm,"
      "estimate_mm,fragment,remaining\n"
      "1.500,10,20,0.1,13,24,0.2,0.3,0.4,0.5,13,25,0.25,1,2,4,6,0.71,0.72,0.73,0.81,0.82,0.83,0.5,0.6,-0.4,"
      "-1,-2,-3,-4,101,102,103,104,5000.000,1000.000,7,42\n");
}

TEST_F(DriveTableTest, ColumnsAreCountedAsGnuplotDoes) {
  write_drive_table(file(), {});
  const std::string header = text();
  const auto number_of = [&](const std::string& name) {
    return 2 + std::count(header.begin(),
                          header.begin() + static_cast<std::ptrdiff_t>(header.find("," + name + ",")), ',');
  };
  EXPECT_EQ(column::x_d, number_of("x_d"));
  EXPECT_EQ(column::x, number_of("x"));
  EXPECT_EQ(column::v_x, number_of("vx"));
  EXPECT_EQ(column::x_e, number_of("x_e"));
  EXPECT_EQ(column::mu_x, number_of("mu_x"));
  EXPECT_EQ(column::sd_mu_x, number_of("sd_mu_x"));
  EXPECT_EQ(column::true_mu_x, number_of("true_mu_x"));
  EXPECT_EQ(column::tau, number_of("tau_FL"));
  EXPECT_EQ(column::load, number_of("N_FL"));
  EXPECT_EQ(column::track, number_of("track_mm"));
  EXPECT_EQ(column::estimate, number_of("estimate_mm"));
}

FragmentTable three_fragments() {
  FragmentTable all(3);
  for (std::size_t k = 0; k < 3; ++k) {
    all[k].fragment.number = static_cast<std::int64_t>(k) + 1;
    all[k].fragment.steps = 50 + static_cast<int>(k);
    all[k].fragment.notify = 10 + static_cast<int>(k);
    all[k].fragment.knot.back().v = 0.25 * static_cast<double>(k);
    all[k].handed_in = 100 * static_cast<std::int64_t>(k);
    all[k].plan = 4;
  }
  return all;
}

/// Rows a tenth of a second apart, with these fragments under way, at speeds 0, 1, 2...
DriveTable rows(const std::vector<int>& executing) {
  DriveTable table;
  for (const int number : executing) {
    DriveRow r;
    r.t = 0.1 * static_cast<double>(table.size());
    r.truth.v.vx = static_cast<double>(table.size());
    r.executing = number;
    table.push_back(r);
  }
  return table;
}

TEST_F(DriveTableTest, AFragmentStaysFromItsFirstRowToTheFirstOneOfAnother) {
  const auto s = stays(three_fragments(), rows({0, 0, 1, 1, 1, 2, 0, 9, 0}));
  ASSERT_EQ(s.size(), 3U);
  EXPECT_NEAR(s[0].begun, 0.2, 1e-12);
  EXPECT_NEAR(s[0].ended, 0.5, 1e-12);
  EXPECT_EQ(s[0].speed, 5);
  EXPECT_NEAR(s[1].begun, 0.5, 1e-12);
  EXPECT_NEAR(s[1].ended, 0.6, 1e-12);
  EXPECT_EQ(s[1].speed, 6);
  EXPECT_TRUE(std::isnan(s[2].begun) && std::isnan(s[2].ended) && std::isnan(s[2].speed)) << "it was none";
}

TEST_F(DriveTableTest, AFragmentUnderWayAtTheEndHasNotEnded) {
  const auto s = stays(three_fragments(), rows({1, 3, 3}));
  EXPECT_EQ(s[0].begun, 0);
  EXPECT_NEAR(s[2].begun, 0.1, 1e-12);
  EXPECT_TRUE(std::isnan(s[2].ended));
}

TEST_F(DriveTableTest, TellsOfEveryFragmentWhenItWasHandedOverBegunAndEnded) {
  write_fragment_table(file(), three_fragments(), rows({0, 1, 2, 2, 0}));
  EXPECT_EQ(text(),
            "number,plan,steps,notify,handed_s,begun_s,ended_s,v_end,v_end_true,ready_s\n"
            "1,4,50,10,0.00,0.10,0.20,0.0000,2.0000,nan\n"
            "2,4,51,11,2.00,0.20,0.40,0.2500,4.0000,nan\n"
            "3,4,52,12,4.00,nan,nan,0.5000,nan,nan\n");
}

TEST(Drive, ErrorsAreDistancesFromTheTruePlace) {
  EXPECT_EQ(tracking_error(a_row()), 5);
  EXPECT_EQ(estimation_error(a_row()), 1);
}

TEST(Drive, APivotTurnsOnTheSpotAllThrough) {
  Fragment f;
  EXPECT_FALSE(is_pivot(f)) << "it stands";
  f.knot.back().p.phi = 1;
  EXPECT_TRUE(is_pivot(f));
  for (std::size_t k = 0; k < f.knot.size(); ++k) {
    Fragment moves = f;
    moves.knot[k].v = -0.1;
    EXPECT_FALSE(is_pivot(moves)) << k;
  }
}

// Wheels 0 and 2 are the left ones.
TEST(Drive, TheTrueSlipIsTheMeanOfTheWheelsAndTheShareByWhichTheSidesDiffer) {
  const Slip slip = true_slip(a_row().truth);
  EXPECT_NEAR(slip.mu_x, 0.5, 1e-12);
  EXPECT_NEAR(slip.mu_y, 0.6, 1e-12);
  EXPECT_NEAR(slip.split, -0.4, 1e-12);
  EXPECT_EQ(true_slip({}).split, 0) << "no friction at all";
}

}  // namespace
}  // namespace mrroc::rex_drive
