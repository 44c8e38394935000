// A hand that leads through the air, and the file that tells it where.
#include "sim/hand_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/fault.hpp"
#include "sim/hand.hpp"
#include "sim/strokes_file.hpp"

namespace mrroc::sim {
namespace {

namespace fs = std::filesystem;

/// A file for the time of a test.
class File {
 public:
  explicit File(const std::string& content)
      : path_(fs::temp_directory_path() / ("hand_track_" + std::to_string(::getpid()) + ".csv")) {
    std::ofstream(path_) << content;
  }
  ~File() { fs::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

HandTrack circle() {
  std::vector<TrackPoint> points;
  for (double t = 0; t < 4; t += 0.01)
    points.push_back({t, {0.03 * std::sin(t), 0.03 * (1 - std::cos(t)), 0.05}});
  return HandTrack(points);
}

TEST(HandTrack, GoesThroughItsPointsAndStandsBeforeAndAfterThem) {
  const HandTrack track({{0, {0, 0, 1}}, {1, {1, 0, 1}}, {3, {1, 2, 1}}});
  EXPECT_EQ(track.duration(), 3);
  EXPECT_EQ(track.at(1).position, Vector3(1, 0, 1));
  for (const double t : {-1., 0., 3., 9.}) EXPECT_EQ(track.at(t).velocity, Vector3::Zero()) << t;
  EXPECT_EQ(track.at(9).position, Vector3(1, 2, 1));
  EXPECT_TRUE(HandTrack().empty());
  EXPECT_EQ(HandTrack().at(1).position, Vector3::Zero());
}

TEST(HandTrack, VelocityAndAccelerationAreThoseOfItsPlaces) {
  const HandTrack track = circle();
  for (double t = 0.1; t < 3.9; t += 0.0137) {
    const double h = 1e-5;
    const Vector3 v = (track.at(t + h).position - track.at(t - h).position) / (2 * h);
    EXPECT_LT((track.at(t).velocity - v).norm(), 1e-6) << t;
    EXPECT_NEAR(track.at(t).velocity.norm(), 0.03, 1e-4);
    EXPECT_NEAR(track.at(t).acceleration.norm(), 0.03, 2e-3);
  }
}

TEST(HandTrack, IsReadFromAFileInMillimetres) {
  const File file("t,x,y,z\n0,0,0,50\n0.5,10,0,50\n");
  ASSERT_TRUE(is_hand_track(file.path()));
  const HandTrack track = read_hand_track(file.path());
  EXPECT_EQ(track.duration(), 0.5);
  EXPECT_EQ(track.at(1).position, Vector3(0.01, 0, 0.05));
}

TEST(HandTrack, RefusesRowsThatCannotBeMeant) {
  for (const char* rows : {"", "0,1,2\n", "0,1,2,nan\n", "x,1,2,3\n", "-1,0,0,0\n", "0,0,0,0\n0,1,1,1\n",
                           "1,0,0,0\n0.5,1,1,1\n", "inf,0,0,0\n"}) {
    const File file(std::string("t,x,y,z\n") + rows);
    EXPECT_THROW(read_hand_track(file.path()), FaultError) << rows;
  }
  EXPECT_FALSE(is_hand_track(File("stroke,t,x,y\n0,0,1,1\n").path()));
  EXPECT_FALSE(is_hand_track("no/such/file"));
}

/// A tool without weight in thick oil, in a hand. @return the largest distance from the track after the first second
double led_along(const HandParameters& parameters, double& end) {
  const PaperParameters paper;
  Hand hand(parameters, paper, 1);
  const HandTrack track = circle();
  hand.follow(track);
  Vector3 tip = paper.T_0P * Vector3(0, 0, 0.05), velocity = Vector3::Zero();
  double worst = 0;
  end = -1;
  for (double t = 0; t < 10; t += 0.001) {
    const Vector3 force = hand.step(0.001, tip, velocity, false);
    velocity += 0.001 / 3 * (force - 40 * velocity);
    tip += 0.001 * velocity;
    if (hand.status().phase == HandPhase::done && end < 0) end = t;
    const Vector3 at = paper.T_0P.inverse() * tip;
    if (t > 1 && end < 0) worst = std::max(worst, std::abs((at - Vector3(0, 0.03, 0.05)).norm() - 0.03));
  }
  EXPECT_EQ(hand.status().fraction, 1);
  return worst;
}

TEST(Hand, LeadsThroughTheAirWithTheTimesOfATrackWithAndWithoutAMass) {
  for (const double mass : {0., 0.4, 1., 2.5}) {
    HandParameters p;
    p.mass = mass;
    p.tremor = 0;
    double end = 0;
    EXPECT_LT(led_along(p, end), 0.0025) << mass << " kg";
    EXPECT_NEAR(end, 4.4, 0.5) << "the track's 4 s, after it has taken the tool";
  }
}

}  // namespace
}  // namespace mrroc::sim
