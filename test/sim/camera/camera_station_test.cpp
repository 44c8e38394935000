#include "sim/camera/camera_station.hpp"

#include <gtest/gtest.h>

#include "base/link/memory_bus.hpp"
#include "base/link/session.hpp"
#include "base/msg/pose_rows.hpp"
#include "sim/camera/cell_view.hpp"
#include "test/rig/irb6_cell.hpp"
#include "test/sim/camera/scenes.hpp"

namespace mrroc::sim {
namespace {

using namespace std::chrono_literals;
using test::hash_of;

constexpr std::uint64_t kNone = 0;  // instead of the hash of a picture that was not given

/// What a receptor saw of one picture.
struct Seen {
  std::int64_t frame{};
  std::int64_t step{};
  std::uint64_t hash{};
  friend bool operator==(const Seen&, const Seen&) = default;
};

/// The simulator's thread and a receptor, without drivers: the arms stand on their brakes.
std::vector<PlacedCamera> placed(const CameraWorld& k, View& view) {
  std::vector<PlacedCamera> all;
  for (const SimulatedCamera& each : k.cameras) all.push_back({each, &view});
  return all;
}

class Station {
 public:
  explicit Station(const CameraWorld& k, ClockKind clock = ClockKind::step)
      : context_{"cameras", link::random_id(), "simulator", {"mp", "simulator"}, clock, 10s},
        simulator_process_(*simulator_bus_, context_),
        receptor_(*receptor_bus_, context_),
        world_(parameters_, 1),
        cell_(simulator_process_, world_, parameters_, {"arm1", "arm2"}, k.light, k.object),
        station_(simulator_process_, placed(k, cell_)),
        frames_(receptor_.inbox<camera_frame_t>(k.cameras.at(0).setup.key + ".frame")),
        truth_(receptor_.inbox<object_truth_t>("object.truth")),
        store_(link::FrameReader::open({context_.session, context_.session_id, k.cameras.at(0).setup.key})
                   .value()) {
    station_.begin();
  }

  void run(std::int64_t steps) {
    for (std::int64_t end = step_ + steps; step_ < end; ++step_) {
      station_.deliver(step_);
      receive();
      station_.look(step_);
      world_.step({});
    }
  }
  void end() {
    station_.end();
    receive();
  }
  /// What the coordinator asks in macrostep i.
  void ask(std::int64_t i, int mode) {
    setting_.set({.mode = mode});
    setting_.send(i);
    simulator_process_.poll();
    ASSERT_TRUE(station_.asked(i));
    station_.obey(i);
  }

  [[nodiscard]] const std::vector<Seen>& seen() const { return seen_; }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] const object_truth_t* truth(std::int64_t stamp) { return truth_->at(stamp); }
  [[nodiscard]] link::FrameStoreName store() const { return {context_.session, context_.session_id, "sac"}; }
  [[nodiscard]] const WorldParameters& parameters() const { return parameters_; }

 private:
  void receive() {
    receptor_.poll();
    while (const camera_frame_t* m = frames_->next(next_)) {
      next_ = m->header.stamp + 1;
      ended_ = m->last != 0;
      if (ended_) break;
      if (m->slot < 0) {
        seen_.push_back({m->header.stamp, m->step, kNone});
        continue;
      }
      link::Frame frame;
      ASSERT_EQ(store_.read(m->slot, m->header.stamp, frame), link::FrameFate::read);
      EXPECT_EQ(frame.step, m->step);
      EXPECT_DOUBLE_EQ(frame.t, 0.002 * static_cast<double>(m->step));
      seen_.push_back({m->header.stamp, m->step, hash_of(frame.image)});
    }
  }

  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> simulator_bus_{hub_.open()};
  std::unique_ptr<link::Bus> receptor_bus_{hub_.open()};
  link::NodeContext context_;
  link::Process simulator_process_;
  link::Process receptor_;
  WorldParameters parameters_{rig::irb6_cell()};
  World world_;
  CellView cell_;
  CameraStation station_;
  std::unique_ptr<link::Inbox<camera_frame_t>> frames_;
  std::unique_ptr<link::Inbox<object_truth_t>> truth_;
  link::OutgoingLink<SensorSetting> setting_{receptor_, kCamerasSetting};
  link::FrameReader store_;
  std::int64_t step_{};
  std::int64_t next_{};
  bool ended_{};
  std::vector<Seen> seen_;
};

SimulatedCamera small_camera() {
  SimulatedCamera c;
  c.setup.key = "sac";
  c.setup.mount = CameraMount::base;
  c.setup.robot = "arm1";
  c.setup.place = looking_at({1.1, 0.2, 1.9}, {0.9, 0.1, 0.9}, {1, 0, 0});
  c.setup.model = {160, 120, 150, 150, 79.5, 59.5, {}};
  c.profile = camera::fast_profile();
  return c;
}

CameraWorld one_camera() {
  CameraWorld k;
  k.cameras.push_back(small_camera());
  k.object.kind = ObjectKind::chessboard;
  k.object.arm = "arm1";
  k.object.T_0G.p = {1.0, 0.15, 0.93};
  return k;
}

TEST(CameraStation, HandsOverEveryPictureBeforeTheNextOneIsDue) {
  Station station(one_camera());
  station.run(101);
  ASSERT_EQ(station.seen().size(), 5U) << "that of step 100 is under way";
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(station.seen()[k].frame, static_cast<std::int64_t>(k));
    EXPECT_EQ(station.seen()[k].step, 20 * static_cast<std::int64_t>(k));
  }
  EXPECT_FALSE(station.ended());
  station.end();
  EXPECT_EQ(station.seen().size(), 6U);
  EXPECT_TRUE(station.ended());
}

TEST(CameraStation, ShowsTheWorldAsItIsAtThatStepAndNothingElse) {
  const CameraWorld k = one_camera();
  Station station(k);
  station.run(25);
  World world(station.parameters(), 1);
  const CellScene cell(station.parameters());
  camera::Scene scene = cell.take(world);
  const Pose& T_UB = station.parameters().arms[0].T_UB;
  const ObjectPath path(k.object);
  path.add_to(scene, T_UB, path.at(0));
  camera::Renderer renderer(k.cameras[0].setup.model, k.cameras[0].profile);
  EXPECT_EQ(station.seen().at(0).hash, hash_of(renderer.render(scene, T_UB * k.cameras[0].setup.place, 0)));
}

TEST(CameraStation, ShowsTheSameInEveryRun) {
  CameraWorld k = one_camera();
  k.cameras.push_back(small_camera());
  k.cameras[1].setup.key = "eih";
  k.cameras[1].setup.mount = CameraMount::robot;
  k.object.motion = ObjectMotion::hand;
  k.object.start = 0;
  Station first(k);
  first.run(121);
  Station second(k);
  second.run(121);
  EXPECT_EQ(first.seen(), second.seen());
  ASSERT_GT(first.seen().size(), 4U);
  EXPECT_NE(first.seen()[1].hash, first.seen()[3].hash);
}

TEST(CameraStation, LetsTheEyeInHandMoveWithTheHand) {
  CameraWorld k = one_camera();
  k.cameras[0].setup.mount = CameraMount::robot;
  k.cameras[0].setup.place = {Matrix3::Identity(), {0.1, 0, -0.1}};
  Station station(k);
  station.run(21);
  World world(station.parameters(), 1);
  camera::Scene scene = CellScene(station.parameters()).take(world);
  const Pose& T_UB = station.parameters().arms[0].T_UB;
  const ObjectPath path(k.object);
  path.add_to(scene, T_UB, path.at(0));
  camera::Renderer renderer(k.cameras[0].setup.model, k.cameras[0].profile);
  EXPECT_EQ(station.seen().at(0).hash,
            hash_of(renderer.render(scene, T_UB * world.truth(0).T_0E * k.cameras[0].setup.place, 0)));
}

TEST(CameraStation, ACameraOnDemandGivesPicturesOnlyWhileItIsAsked) {
  CameraWorld k = one_camera();
  k.cameras[0].setup.on_demand = true;
  Station station(k);
  station.run(30);
  station.ask(1, kTakePictures);
  station.run(40);
  station.ask(2, 0);
  station.run(30);
  std::vector<std::int64_t> given;
  for (const Seen& s : station.seen())
    if (s.hash != kNone) given.push_back(s.step);
  EXPECT_EQ(given, (std::vector<std::int64_t>{40, 60}));
  EXPECT_EQ(station.seen().size(), 5U) << "of the others it is told that there is none";
}

TEST(CameraStation, AnObjectInTheHandGoesWithTheHand) {
  CameraWorld k = one_camera();
  k.object.in_hand = true;
  k.object.T_0G = {rotation_from_angle_axis({0.1, 0.2, 0.3}), {0.1, 0, 0.05}};
  Station station(k);
  station.run(41);
  station.end();
  const object_truth_t* const m = station.truth(1);
  ASSERT_NE(m, nullptr);
  const Pose T_EG = pose_from_rows(m->T_0E).inverse() * pose_from_rows(m->T_0G);
  EXPECT_LT((T_EG.p - k.object.T_0G.p).norm(), 1e-9);
  EXPECT_LT((T_EG.R - k.object.T_0G.R).norm(), 1e-9);
}

TEST(CameraStation, StandsWhereItReallyIsWhenTheCalibrationErrs) {
  CameraWorld k = one_camera();
  k.cameras[0].profile.noise = 0;
  Station right(k);
  right.run(21);
  k.cameras[0].error.p.x() = 0.01;
  Station wrong(k);
  wrong.run(21);
  EXPECT_NE(right.seen().at(0).hash, wrong.seen().at(0).hash);
  k.cameras[0].setup.place = k.cameras[0].setup.place * Pose{Matrix3::Identity(), {-0.01, 0, 0}};
  Station moved(k);
  moved.run(21);
  EXPECT_EQ(right.seen().at(0).hash, moved.seen().at(0).hash);
}

/// Hashes of a camera's pictures 0, 1, 2..., which it takes every 0.04 s.
std::vector<std::uint64_t> pictures_of(const CameraWorld& k) {
  Station station(k);
  station.run(121);
  std::vector<std::uint64_t> hashes;
  for (const Seen& s : station.seen()) {
    EXPECT_EQ(s.frame, static_cast<std::int64_t>(hashes.size()));
    EXPECT_EQ(s.step, 20 * s.frame);
    hashes.push_back(s.hash);
  }
  return hashes;
}

TEST(CameraStation, ACameraIsSilentBlackOrFrozenInItsTimeAndSeesAsBeforeAfterIt) {
  CameraWorld k = one_camera();
  const std::vector<std::uint64_t> good = pictures_of(k);
  ASSERT_EQ(good.size(), 6U);
  const TimeIntervals third_and_fourth{{0.07, 0.13}};
  k.cameras[0].faults.silent = third_and_fourth;
  EXPECT_EQ(pictures_of(k), (std::vector{good[0], good[1], kNone, kNone, good[4], good[5]}));
  k.cameras[0].faults = {.black = third_and_fourth};
  const std::uint64_t black = hash_of(Image(160, 120, k.cameras[0].profile.channels));
  EXPECT_EQ(pictures_of(k), (std::vector{good[0], good[1], black, black, good[4], good[5]}));
  k.cameras[0].faults = {.frozen = third_and_fourth};
  EXPECT_EQ(pictures_of(k), (std::vector{good[0], good[1], good[1], good[1], good[4], good[5]}));
}

TEST(CameraStation, ACameraThatHangsShowsTheLastViewWithNoiseOfItsOwn) {
  CameraWorld k = one_camera();
  const std::vector<std::uint64_t> good = pictures_of(k);
  k.cameras[0].faults.hangs = {{0.07, 0.13}};
  const std::vector<std::uint64_t> noisy = pictures_of(k);
  EXPECT_NE(noisy[2], noisy[1]);
  EXPECT_NE(noisy[3], noisy[2]);
  EXPECT_EQ(noisy[1], good[1]);
  EXPECT_EQ(noisy[4], good[4]);
  k.cameras[0].profile.noise = 0;
  const std::vector<std::uint64_t> still = pictures_of(k);
  EXPECT_EQ(still[2], still[1]);
  EXPECT_EQ(still[3], still[1]);
}

TEST(CameraStation, ACameraThatIsFrozenFromTheBeginningGivesItsFirstPictureAgainAndAgain) {
  CameraWorld k = one_camera();
  const std::vector<std::uint64_t> good = pictures_of(k);
  k.cameras[0].faults.frozen = {{0, 0.1}};
  EXPECT_EQ(pictures_of(k), (std::vector{good[0], good[0], good[0], good[3], good[4], good[5]}));
}

TEST(CameraStation, WithExchangedCablesACameraShowsWhatAnotherOneSees) {
  CameraWorld k = one_camera();
  k.cameras[0].profile.noise = 0;
  k.cameras.push_back(small_camera());
  k.cameras[1].setup.key = "other";
  k.cameras[1].profile.noise = 0;
  k.cameras[1].setup.place.p.y() += 0.1;
  k.cameras[0].faults.shows = "other";
  const std::vector<std::uint64_t> exchanged = pictures_of(k);
  k.cameras[0].faults.shows = "sac";
  EXPECT_NE(pictures_of(k), exchanged);
  std::swap(k.cameras[0].setup.place, k.cameras[1].setup.place);
  EXPECT_EQ(pictures_of(k), exchanged);
}

TEST(CameraStation, TellsTheTruthForFigures) {
  CameraWorld k = one_camera();
  k.object.motion = ObjectMotion::line;
  k.object.start = 0;
  k.object.absent_until = 0.05;
  Station station(k);
  station.run(101);
  for (std::int64_t stamp = 0; stamp <= 4; ++stamp) {
    const object_truth_t* const m = station.truth(stamp);
    ASSERT_NE(m, nullptr);
    EXPECT_EQ(m->step, 20 * stamp);
    EXPECT_EQ(m->present, stamp >= 2);
    EXPECT_DOUBLE_EQ(m->T_0G[3], ObjectPath(k.object).at(0.04 * static_cast<double>(stamp)).T_0G.p.x());
    EXPECT_NEAR(m->T_0E[11], 0.94, 0.01);
  }
}

TEST(CameraStation, GathersLightAroundTheStepOfThePicture) {
  CameraWorld k = one_camera();
  k.cameras[0].profile.noise = 0;
  k.object.motion = ObjectMotion::line;
  k.object.start = 0;
  k.object.speed = 1;
  k.object.acceleration = 100;
  Station sharp(k);
  sharp.run(61);
  k.cameras[0].exposure = 8;
  k.cameras[0].instants = 3;
  Station blurred(k);
  blurred.run(61);
  ASSERT_EQ(blurred.seen().size(), 3U);
  EXPECT_NE(blurred.seen()[1].hash, sharp.seen()[1].hash);
  EXPECT_EQ(blurred.seen()[1].step, 20);
  World world(blurred.parameters(), 1);
  std::vector<camera::Instant> exposure;
  for (std::int64_t step = 0; step <= 24; ++step) {
    if (step == 16 || step == 20 || step == 24) {
      camera::Scene scene = CellScene(blurred.parameters()).take(world);
      const ObjectPath path(k.object);
      path.add_to(scene, blurred.parameters().arms[0].T_UB, path.at(0.002 * static_cast<double>(step)));
      exposure.push_back({scene, blurred.parameters().arms[0].T_UB * k.cameras[0].setup.place});
    }
    world.step({});
  }
  camera::Renderer renderer(k.cameras[0].setup.model, k.cameras[0].profile);
  EXPECT_EQ(blurred.seen()[1].hash, hash_of(renderer.render(exposure, 1)));
}

TEST(CameraStation, LeavesPicturesOutRatherThanBeingLateForTheWallClock) {
  Station station(one_camera(), ClockKind::wall);
  station.run(400);  // much faster than pictures can be drawn
  station.end();
  EXPECT_LT(station.seen().size(), 20U);
  EXPECT_GE(station.seen().size(), 1U);
  for (const Seen& s : station.seen()) EXPECT_EQ(s.step, 20 * s.frame);
  EXPECT_TRUE(station.ended());
}

TEST(CameraStation, LeavesNoStoreBehind) {
  Station station(one_camera());
  EXPECT_FALSE(std::filesystem::exists(station.store().path())) << "its name is gone when all have opened it";
}

TEST(CameraStation, ShowsTheOtherCameras) {
  CameraWorld k = one_camera();
  k.cameras[0].profile.noise = 0;
  Station alone(k);
  alone.run(21);
  k.cameras.push_back(small_camera());
  k.cameras[1].setup.key = "eih";
  k.cameras[1].setup.mount = CameraMount::robot;
  k.cameras[1].setup.place = {Matrix3::Identity(), {0.12, 0.1, -0.1}};
  Station two(k);
  two.run(21);
  EXPECT_NE(alone.seen().at(0).hash, two.seen().at(0).hash);
}

TEST(CameraStation, SeesTheArmHideTheObject) {
  // Straight from above, the wrist stands between the camera and the middle of the sheet.
  CameraWorld k = one_camera();
  k.cameras[0].setup.place = looking_at({0.9, 0, 2.4}, {0.9, 0, 0.9}, {1, 0, 0});
  k.cameras[0].profile.noise = 0;
  k.object.T_0G.p = {0.9, 0, 0.925};
  k.object.kind = ObjectKind::apriltag;
  k.object.tag_edge = 0.05;
  Station with(k);
  with.run(21);
  k.object.kind = ObjectKind::none;
  Station without(k);
  without.run(21);
  EXPECT_EQ(with.seen().at(0).hash, without.seen().at(0).hash) << "nothing of it is seen";
}

}  // namespace
}  // namespace mrroc::sim
