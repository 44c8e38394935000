// The shell of a camera's receptor: one reading for every picture, seen or not, to the last one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "base/link/frame_store.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {
namespace {

link::Membership member(const std::string& name) {
  link::Membership m;
  m.session = "shell" + std::to_string(getpid());
  m.name = name;
  m.roster = {"mp", "vsp-sac"};
  return m;
}

class CameraShell : public testing::Test {
 protected:
  explicit CameraShell(int width = 640)
      : store_({.session = member("mp").session, .session_id = member("mp").session_id, .camera = "sac"},
               {.width = width, .height = 480, .channels = 1, .slots = 8}),
        bus_(hub_.open()),
        mp_(*bus_, member("mp")),
        supervisor_(*bus_, mp_.route("supervisor"), 1),
        frames_(mp_.outbox<camera_frame_t>("sac.frame")),
        readings_(mp_.inbox<camera_reading_t>("sac.board")),
        status_(*bus_, mp_.route("vsp-sac.status"), 1),
        thread_([this] {
          const auto bus = hub_.open();
          link::Process process(*bus, member("vsp-sac"));
          const Config config = Config::parse(
              "[cameras.sac]\nfx = 600\ndistortion = [-0.28, 0.09, 0.0006, -0.0004, 0]\n", "test");
          try {
            run_chessboard(process, config, {});
          } catch (const FaultError& e) {
            fault_ = e.fault().code;
            process.report_fault(e.fault());
          }
          ended_ = true;
        }) {
    mp_.on_service = [this] {
      while (const auto s = status_.take()) state_ = static_cast<link::ProcessState>(s->state);
    };
  }
  ~CameraShell() override { say(link::Phase::finished); }

  void start() {
    ASSERT_TRUE(await([this] { return state_ == link::ProcessState::ready; }));
    say(link::Phase::running);
  }
  template <class Ready>
  bool await(Ready ready) {
    return mp_.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  }
  void say(link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor_.publish(m, 0);
  }
  void take_picture(std::int64_t k, const Image& image, bool last = false) {
    camera_frame_t m{};
    m.step = 20 * k;
    m.slot = store_.write(k, m.step, 0.002 * static_cast<double>(m.step), image.view());
    m.last = last ? 1 : 0;
    frames_->publish(m, k);
  }

  link::FrameWriter store_;
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  link::Process mp_;
  link::Outbox<supervisor_t> supervisor_;
  std::unique_ptr<link::Outbox<camera_frame_t>> frames_;
  std::unique_ptr<link::Inbox<camera_reading_t>> readings_;
  link::Queue<process_status_t> status_;
  link::ProcessState state_{};
  std::atomic<bool> ended_{false};
  std::atomic<FaultCode> fault_{FaultCode::none};
  std::jthread thread_;
};

TEST_F(CameraShell, GivesOneReadingPerPictureUntilTheLastOne) {
  start();
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
  EXPECT_TRUE(await([this] { return state_ == link::ProcessState::done; }));
}

TEST_F(CameraShell, EndsWithTheSystem) {
  start();
  say(link::Phase::finished);
  EXPECT_TRUE(await([this] { return ended_.load(); }));
}

TEST_F(CameraShell, AnAnnouncedPictureThatIsNotThereIsAnError) {
  start();
  camera_frame_t m{};
  m.slot = 3;
  frames_->publish(m, 0);
  EXPECT_TRUE(await([this] { return ended_.load(); }));
  EXPECT_EQ(fault_, FaultCode::malformed_message);
}

class NarrowCameraShell : public CameraShell {
 protected:
  NarrowCameraShell() : CameraShell(320) {}
};

TEST_F(NarrowCameraShell, PicturesOfAnotherSizeThanTheModelAreRefused) {
  EXPECT_TRUE(await([this] { return ended_.load(); }));
  EXPECT_EQ(fault_, FaultCode::bad_configuration);
}

}  // namespace
}  // namespace mrroc::vsp
