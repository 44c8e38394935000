// The shell of a camera's receptor: one reading for every picture, seen or not, to the last one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <string>

#include "base/link/frame_store.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "test/base/link/led.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {
namespace {

class CameraShell : public testing::Test, protected link::test::Led {
 protected:
  explicit CameraShell(int width = 640, ClockKind clock = ClockKind::step)
      : Led("vsp-sac", clock, "shell" + std::to_string(getpid())),
        store_({.session = mp.context().session, .session_id = mp.context().session_id, .camera = "sac"},
               {.width = width, .height = 480, .channels = 1, .slots = 8}),
        frames_(mp.outbox<camera_frame_t>("sac.frame")),
        readings_(mp.inbox<camera_reading_t>("sac.board")) {
    begin([this](link::Process& process) {
      const Config config =
          Config::parse("[cameras.sac]\nfx = 600\ndistortion = [-0.28, 0.09, 0.0006, -0.0004, 0]\n", "test");
      try {
        run_receptor(chessboard_receptor(), process, config);
      } catch (const FaultError& e) {
        fault_ = e.fault().code;
        process.report_fault(e.fault());
      }
    });
  }
  ~CameraShell() override { end(); }

  void take_picture(std::int64_t k, const Image& image, bool last = false) {
    camera_frame_t m{};
    m.step = 20 * k;
    m.slot = store_.write(k, m.step, 0.002 * static_cast<double>(m.step), image.view());
    m.last = last ? 1 : 0;
    frames_->publish(m, k);
  }

  link::FrameWriter store_;
  std::unique_ptr<link::Outbox<camera_frame_t>> frames_;
  std::unique_ptr<link::Inbox<camera_reading_t>> readings_;
  std::atomic<FaultCode> fault_{FaultCode::none};
};

TEST_F(CameraShell, GivesOneReadingPerPictureUntilTheLastOne) {
  ASSERT_TRUE(run());
  const test::PlaneCamera camera(test::web_camera(), 1);
  constexpr std::int64_t kPictures = 12;
  for (std::int64_t k = 0; k < kPictures; ++k) {
    const bool there = k % 3 != 2;
    const Pose T = test::facing(0.6, 0.2, 0.3, 0.1 * static_cast<double>(k));
    take_picture(k,
                 there ? camera.render(T, test::chessboard_texture(9, 6, 0.025, 0.025)) : Image(640, 480, 1),
                 k + 1 == kPictures);
    ASSERT_TRUE(await([&] { return readings_->at(k) != nullptr; })) << k;
    const camera_reading_t& m = *readings_->at(k);
    const CameraReading r = from_message(m);
    EXPECT_EQ(r.frame, k);
    EXPECT_EQ(r.step, 20 * k);
    EXPECT_EQ(r.seen, there) << k;
    EXPECT_EQ(m.last != 0, k + 1 == kPictures);
    EXPECT_TRUE(!there || (r.T_CG.p - T.p).norm() < 0.003) << k;
  }
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::done; }));
}

class HurriedCameraShell : public CameraShell {
 protected:
  HurriedCameraShell() : CameraShell(640, ClockKind::wall) {}
};

TEST_F(HurriedCameraShell, ByTheWallClockTheNewestPictureIsLookedAtAndOlderOnesArePassedOver) {
  ASSERT_TRUE(await([this] { return state() == link::ProcessState::ready; }));
  const Image nothing(640, 480, 1);
  for (const std::int64_t k : {0, 1, 2, 5}) take_picture(k, nothing);  // 3 and 4 were left out
  say(link::Phase::running);
  ASSERT_TRUE(await([this] { return readings_->at(5) != nullptr; }));
  EXPECT_EQ(readings_->at(5)->step, 100);
  for (const std::int64_t k : {0, 1, 2, 3, 4}) EXPECT_EQ(readings_->at(k), nullptr) << k;
  take_picture(9, nothing);
  ASSERT_TRUE(await([this] { return readings_->at(9) != nullptr; })) << "it goes on with what comes next";
}

TEST_F(CameraShell, EndsWithTheSystem) {
  ASSERT_TRUE(run());
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended(); }));
}

TEST_F(CameraShell, AnAnnouncedPictureThatIsNotThereIsAnError) {
  ASSERT_TRUE(run());
  camera_frame_t m{};
  m.slot = 3;
  frames_->publish(m, 0);
  EXPECT_TRUE(await([this] { return ended(); }));
  EXPECT_EQ(fault_, FaultCode::malformed_message);
}

class NarrowCameraShell : public CameraShell {
 protected:
  NarrowCameraShell() : CameraShell(320) {}
};

TEST_F(NarrowCameraShell, PicturesOfAnotherSizeThanTheModelAreRefused) {
  EXPECT_TRUE(await([this] { return ended(); }));
  EXPECT_EQ(fault_, FaultCode::bad_configuration);
}

}  // namespace
}  // namespace mrroc::vsp
