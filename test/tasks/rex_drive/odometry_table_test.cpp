// What is written down about the visual odometry of a drive, and the figures of it.
#include "tasks/rex_drive/odometry_table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <variant>

#include "tasks/rex_drive/odometry_figures.hpp"

namespace mrroc::rex_drive {
namespace {

namespace fs = std::filesystem;

constexpr double kDt = 0.002;
constexpr int kSteps = 10;
constexpr std::int64_t kPeriod = 40;
constexpr double kWay = 0.04;   // true, from pair to pair [m]
constexpr double kTurn = 0.05;  // the same [rad]

/// Readings of pairs 0 to n; the first has none before it. The motion that is measured is wrong by `error`.
DriveMessages messages(int n, const PlanarPose& error) {
  DriveMessages m;
  PlanarPose p{1, 2, 0};
  for (int macrostep = 0; macrostep <= 4 * n; ++macrostep) {
    PlatformTruth truth;
    truth.p = p;
    m.truths.push_back(to_message(truth));
    m.truths.back().header.stamp = macrostep;
    if (macrostep % 4 == 3) {
      p.x += kWay * std::cos(p.phi);
      p.y += kWay * std::sin(p.phi);
      p.phi += kTurn;
    }
  }
  for (int k = 0; k <= n; ++k) {
    OdometryReading r{.step_before = (k - 1) * kPeriod, .step = k * kPeriod, .valid = k > 0};
    const double turn = kTurn + error.phi;
    r.A = {std::cos(turn),
           -std::sin(turn),
           0,
           kWay + error.x,
           std::sin(turn),
           std::cos(turn),
           0,
           error.y,
           0,
           0,
           1,
           0};
    for (std::size_t i = 0; i < 6; ++i) r.covariance[7 * i] = 1e-6;
    const auto finding = k > 0 ? OdometryFinding::motion : OdometryFinding::no_before;
    m.odometry.push_back(to_message(
        r,
        {.finding = finding, .features = 400, .matches = 300, .inliers = 250, .cells = 20, .rms_px = 0.25}));
    m.odometry.back().header.stamp = k;
  }
  return m;
}

/// A fragment is under way in all of its rows.
DriveTable driving(int n) {
  DriveTable table;
  for (int macrostep = 0; macrostep <= 4 * n; ++macrostep) {
    DriveRow row;
    row.step = kSteps * macrostep;
    row.executing = 1;
    table.push_back(row);
  }
  return table;
}

OdometryTable table_of(const DriveMessages& m) { return join_odometry(m, driving(1000), kDt, kSteps); }

double value(const mp::Figures& figures, const char* key) {
  const auto found = figures.find(key);
  EXPECT_NE(found, figures.end()) << key;
  return found == figures.end() ? 0 : std::get<double>(found->second);
}

TEST(OdometryTable, HasAMotionAndTheTrueOneOfEveryPairButTheFirst) {
  const OdometryTable table = table_of(messages(3, {0.001, -0.002, 0.003}));
  ASSERT_EQ(table.size(), 4U);
  EXPECT_FALSE(table[0].valid);
  EXPECT_EQ(table[0].support.finding, OdometryFinding::no_before);
  EXPECT_FALSE(motion_error(table[0]));
  for (std::size_t k = 1; k < table.size(); ++k) {
    EXPECT_NEAR(table[k].t, 0.08 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(table[k].support.frame, static_cast<std::int64_t>(k));
    EXPECT_TRUE(table[k].drives);
    ASSERT_TRUE(table[k].truth);
    EXPECT_NEAR(table[k].truth->x, kWay, 1e-12);
    EXPECT_NEAR(table[k].truth->y, 0, 1e-12);
    EXPECT_NEAR(table[k].truth->phi, kTurn, 1e-12);
    const auto error = motion_error(table[k]);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->x, 0.001, 1e-12);
    EXPECT_NEAR(error->y, -0.002, 1e-12);
    EXPECT_NEAR(error->phi, 0.003, 1e-12);
  }
}

TEST(OdometryTable, TheCovarianceIsThatOfPlaceAndTurnInThePlane) {
  DriveMessages m = messages(1, {});
  OdometryReading r = from_message(m.odometry[1]);
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column)
      r.covariance[6 * row + column] = row == column ? 1e-6 * static_cast<double>(row + 1) : 1e-8;
  m.odometry[1] = to_message(r, {.finding = OdometryFinding::motion});
  const PlanarCovariance P = table_of(m).at(1).covariance;
  EXPECT_EQ(P, (PlanarCovariance{1e-6, 1e-8, 1e-8, 1e-8, 2e-6, 1e-8, 1e-8, 1e-8, 6e-6}));
}

TEST(OdometryTable, LeavesOutWhatIsNoReadingAndTellsNoTruthThatIsNotKnown) {
  DriveMessages m = messages(3, {});
  m.odometry[2].last = 1;
  m.odometry[3].motion.A[0] = 7;  // no rotation
  m.truths.erase(m.truths.begin() + 4);
  const OdometryTable table = table_of(m);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_TRUE(table[1].valid);
  EXPECT_FALSE(table[1].truth);
  EXPECT_FALSE(motion_error(table[1]));
  m.truths.clear();
  EXPECT_EQ(table_of(m).size(), 2U) << "a real platform";
}

TEST(OdometryTable, OfTheEndItHasWhatMustHaveComeByThen) {
  DriveMessages m = messages(10, {});
  m.cut_after(30, kPeriod);
  ASSERT_FALSE(m.odometry.empty());
  EXPECT_EQ(m.odometry.back().motion.step, 240) << "visible in step 280; the next one in step 320";
}

TEST(OdometryTable, EveryNumberStandsInItsColumn) {
  std::string pattern = (fs::temp_directory_path() / "odometry_table.XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  write_odometry_table(folder / "odometry.csv", table_of(messages(1, {0.003, 0.004, -0.002})));
  std::ifstream in(folder / "odometry.csv");
  std::string header, first, second;
  std::getline(in, header);
  std::getline(in, first);
  std::getline(in, second);
  EXPECT_EQ(first,
            "0.000,0,0,400,300,250,20,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,nan,0.25,1,"
            "there is no pair of pictures before");
  EXPECT_EQ(second,
            "0.080,1,1,400,300,250,20,0.043,0.004,0.048,0.001,0.001,0.001,0.04,0,0.05,5,1.414,2,1,0.25,1,"
            "a motion is measured");
  std::vector<std::string> names;
  std::istringstream words(header);
  for (std::string word; std::getline(words, word, ',');) names.push_back(word);
  const auto name = [&names](int column) { return names.at(static_cast<std::size_t>(column - 1)); };
  EXPECT_EQ(name(odometry_column::t), "t");
  EXPECT_EQ(name(odometry_column::features), "features");
  EXPECT_EQ(name(odometry_column::matches), "matches");
  EXPECT_EQ(name(odometry_column::inliers), "inliers");
  EXPECT_EQ(name(odometry_column::error), "error_mm");
  EXPECT_EQ(name(odometry_column::sd), "sd_mm");
  EXPECT_EQ(name(odometry_column::turn_error), "turn_error_mrad");
  EXPECT_EQ(name(odometry_column::turn_sd), "turn_sd_mrad");
  fs::remove_all(folder);
}

TEST(OdometryFigures, AreNoneWithoutEyes) { EXPECT_TRUE(odometry_figures({}).empty()); }

TEST(OdometryFigures, TellErrorsFromPairToPairAndAlongTheWay) {
  // An error along the way, 0.5 % of it.
  const mp::Figures f = odometry_figures(table_of(messages(200, {0.005 * kWay, 0, 0})));
  EXPECT_EQ(value(f, "odometry_pairs"), 201);
  EXPECT_EQ(value(f, "odometry_invalid"), 1);
  EXPECT_NEAR(value(f, "odometry_valid_pct"), 100.0 * 200 / 201, 1e-9);
  EXPECT_EQ(value(f, "odometry_inliers"), 250);
  EXPECT_NEAR(value(f, "odometry_rms_mm"), 5 * kWay, 1e-9);
  EXPECT_NEAR(value(f, "odometry_turn_rms_mrad"), 0, 1e-9);
  EXPECT_EQ(value(f, "odometry_95_pct"), 100) << "0.2 mm, and a standard deviation of 1 mm";
}

/// @return where n equal motions lead: chords of a circle
Eigen::Vector2d led_to(int n, double way, double turn) {
  const double reach = way * std::sin(0.5 * n * turn) / std::sin(0.5 * turn);
  return reach * Eigen::Vector2d(std::cos(0.5 * (n - 1) * turn), std::sin(0.5 * (n - 1) * turn));
}

TEST(OdometryFigures, TheDriftIsThatOfMotionsPutTogether) {
  const int pairs = static_cast<int>(std::lround(kDriftWay / kWay));
  for (const PlanarPose& error :
       {PlanarPose{0.0004, 0, 0}, PlanarPose{0, 0, 0.002}, PlanarPose{-0.001, 0, -0.001}}) {
    const double drift = value(odometry_figures(table_of(messages(60, error))), "odometry_drift_pct");
    // The last pair may be the one before or after the way is as long, by rounding.
    double nearest = 1e9;
    for (const int n : {pairs, pairs + 1}) {
      const Eigen::Vector2d off = led_to(n, kWay + error.x, kTurn + error.phi) - led_to(n, kWay, kTurn);
      nearest = std::min(nearest, std::abs(drift - 100 * off.norm() / (n * kWay)));
    }
    EXPECT_LT(nearest, 1e-6) << error.x << " " << error.phi;
  }
}

TEST(OdometryFigures, AnErrorOfThreeDeviationsIsOutsideOfTheEllipsoid) {
  EXPECT_EQ(value(odometry_figures(table_of(messages(5, {0, 0.003, 0}))), "odometry_95_pct"), 0);
}

TEST(OdometryFigures, CountWhatIsSeenWhileItDrives) {
  DriveTable drive = driving(10);
  for (DriveRow& row : drive)
    if (row.step >= 200) row.executing = 0;
  const mp::Figures f = odometry_figures(join_odometry(messages(10, {}), drive, kDt, kSteps));
  EXPECT_EQ(value(f, "odometry_pairs"), 5);
}

TEST(OdometryFigures, APairThatSeesNothingBeginsANewWay) {
  DriveMessages m = messages(100, {});
  for (int k = 20; k <= 100; k += 20) m.odometry[static_cast<std::size_t>(k)].motion.valid = 0;
  const mp::Figures f = odometry_figures(table_of(m));
  EXPECT_EQ(f.count("odometry_drift_pct"), 0U) << "no way of 2 m";
  EXPECT_EQ(value(f, "odometry_invalid"), 6);
}

TEST(OdometryFigures, OfABlindPlatformTellThatItIsBlind) {
  DriveMessages m = messages(5, {});
  for (auto& reading : m.odometry) reading.motion.valid = 0;
  const mp::Figures f = odometry_figures(table_of(m));
  EXPECT_EQ(value(f, "odometry_valid_pct"), 0);
  EXPECT_EQ(f.count("odometry_rms_mm"), 0U);
}

}  // namespace
}  // namespace mrroc::rex_drive
