// Which face of the cube the coordinator sees: the newest one that is visible, in lock step and with the
// wall clock.
#include "tasks/rubik/camera_input.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <tuple>

#include "base/fault.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::rubik {
namespace {

/// A face of the cube as the coordinator's camera input takes it.
class RubikCameraInput : public testing::Test {
 protected:
  void begin(ClockKind clock, bool camera = true) {
    camera_input_.reset();
    out_.reset();
    process_.reset();
    bus_ = std::make_unique<link::test::DirectBus>();
    link::NodeContext m{.session = "s", .session_id = 1, .name = "mp", .roster = {"mp"}};
    m.clock = clock;
    m.timeout = std::chrono::milliseconds(50);
    process_.emplace(*bus_, m);
    CameraSetup setup;
    setup.key = "eye";
    setup.period = 20;
    setup.latency = 35;
    camera_input_.emplace(*process_, camera ? std::optional(setup) : std::nullopt);
    out_.emplace(*bus_, process_->route("eye.cube_face"), 1);
  }
  void tell(std::int64_t frame, int last = 0) {
    cube_face_reading_t m{};
    m.step = 20 * frame;
    m.last = last;
    m.place = 2;
    out_->publish(m, frame);
  }
  /// @return step of the picture that is seen in a macrostep; -1: none
  std::int64_t seen(std::int64_t i) {
    SeenFace V;
    camera_input_->read(i, V);
    return V.there ? V.reading.step : -1;
  }
  std::unique_ptr<link::test::DirectBus> bus_;
  std::optional<link::Process> process_;
  std::optional<CameraInput> camera_input_;
  std::optional<link::Outbox<cube_face_reading_t>> out_;
};

TEST_F(RubikCameraInput, SeeTheNewestPictureThatIsVisibleAndWaitForItInLockStep) {
  begin(ClockKind::step);
  for (std::int64_t frame = 0; frame < 5; ++frame) tell(frame);
  EXPECT_EQ(seen(3), -1) << "step 30: the first one is visible from 35 on";
  EXPECT_EQ(seen(4), 0) << "step 40";
  EXPECT_EQ(seen(5), 0) << "step 50";
  EXPECT_EQ(seen(6), 20) << "step 60";
  EXPECT_EQ(seen(10), 60);
  EXPECT_THROW(std::ignore = seen(14), FaultError) << "the one of step 100 does not come";
}

TEST_F(RubikCameraInput, WithTheWallClockSeeWhatThereIs) {
  begin(ClockKind::wall);
  EXPECT_EQ(seen(10), -1);
  tell(1);
  EXPECT_EQ(seen(10), 20) << "the newest, where the exact one is missing";
  tell(3);
  EXPECT_EQ(seen(10), 60);
  EXPECT_EQ(seen(6), 20) << "the exact one, where it is there";
  tell(4, 1);
  EXPECT_EQ(seen(12), -1) << "that was the end of the receptor";
}

TEST_F(RubikCameraInput, SeeNothingWithoutACamera) {
  begin(ClockKind::step, false);
  EXPECT_EQ(seen(100), -1);
}

}  // namespace
}  // namespace mrroc::rubik
