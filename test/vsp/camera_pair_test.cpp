// Receptors of several cameras: pictures of one number belong together.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "base/link/frame_store.hpp"
#include "base/link/memory_bus.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "vsp/camera_loop.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kWidth = 32, kHeight = 24;

/// One answer: grey values of the pictures, number, step, and whether it is the last.
struct Answer {
  std::vector<int> grey;
  std::int64_t frame, step;
  bool last;
  friend bool operator==(const Answer&, const Answer&) = default;
};

class CameraPair : public testing::Test {
 protected:
  CameraPair()
      : bus_(hub_.open()),
        mp_(*bus_, context_of("mp")),
        supervisor_(*bus_, mp_.route("supervisor"), 1),
        status_(*bus_, mp_.route("vsp-rex.status"), 1) {
    for (const char* const key : {"left", "right"}) {
      const link::FrameStoreName name{
          .session = context_of("mp").session, .session_id = context_of("mp").session_id, .camera = key};
      stores_.push_back(std::make_unique<link::FrameWriter>(
          name, link::FrameStoreShape{.width = kWidth, .height = kHeight, .channels = 1, .slots = 4}));
      frames_.push_back(mp_.outbox<camera_frame_t>(std::string(key) + ".frame"));
    }
  }
  ~CameraPair() override {
    say(link::Phase::finished);
    EXPECT_TRUE(await([this] {
      say(link::Phase::finished);
      return ended_.load();
    }));
  }

  void start(ClockKind clock) {
    thread_ = std::jthread([this, clock] {
      const auto bus = hub_.open();
      link::NodeContext context = context_of("vsp-rex");
      context.clock = clock;
      link::Process process(*bus, context);
      const std::array<WatchedCamera, 2> cameras{{{"left", model()}, {"right", model()}}};
      try {
        run_cameras(
            process, cameras,
            [this](std::span<const ImageView> pictures, std::int64_t frame, std::int64_t step, double,
                   bool last) {
              Answer answer{{}, frame, step, last};
              for (const ImageView& each : pictures) answer.grey.push_back(each.at(3, 5, 0));
              answers_.push_back(answer);
              answered_ = static_cast<int>(answers_.size());
            },
            [] {});
      } catch (const FaultError& e) {
        fault_ = e.fault().code;
      }
      ended_ = true;
    });
    ASSERT_TRUE(await([&] {
      while (const auto s = status_.take())
        if (static_cast<link::ProcessState>(s->state) == link::ProcessState::ready) return true;
      return false;
    }));
    say(link::Phase::running);
  }
  /// @param camera  0: left
  void take_picture(std::size_t camera, std::int64_t k, std::int64_t step) {
    Image image(kWidth, kHeight, 1);
    std::ranges::fill(image.data, grey(camera, k));
    camera_frame_t m{};
    m.step = step;
    m.slot = stores_[camera]->write(k, step, 0, image.view());
    frames_[camera]->publish(m, k);
  }
  /// A camera that is silent.
  void give_no_picture(std::size_t camera, std::int64_t k, std::int64_t step) {
    camera_frame_t m{};
    m.step = step;
    m.slot = -1;
    frames_[camera]->publish(m, k);
  }
  void end_pictures(std::size_t camera, std::int64_t k) {
    camera_frame_t m{};
    m.slot = -1;
    m.last = 1;
    frames_[camera]->publish(m, k);
  }
  static std::uint8_t grey(std::size_t camera, std::int64_t k) {
    return static_cast<std::uint8_t>(100 * camera + static_cast<std::size_t>(k));
  }
  static Answer good(std::int64_t k) { return {{grey(0, k), grey(1, k)}, k, 40 * k, false}; }
  bool answered(int n) {
    return await([&] { return answered_ >= n || ended_; });
  }

  static CameraModel model() { return {.width = kWidth, .height = kHeight}; }
  static link::NodeContext context_of(const std::string& name) {
    link::NodeContext m;
    m.session = "pair" + std::to_string(getpid());
    m.name = name;
    m.roster = {"mp", "vsp-rex"};
    return m;
  }
  void say(link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor_.publish(m, 0);
  }
  template <class Ready>
  bool await(Ready ready) {
    return mp_.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  }

  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  link::Process mp_;
  link::Outbox<supervisor_t> supervisor_;
  link::Queue<process_status_t> status_;
  std::vector<std::unique_ptr<link::FrameWriter>> stores_;
  std::vector<std::unique_ptr<link::Outbox<camera_frame_t>>> frames_;
  std::vector<Answer> answers_;  // to be read when answered() or ended_
  std::atomic<int> answered_{};
  std::atomic<bool> ended_{};
  FaultCode fault_{FaultCode::none};
  std::jthread thread_;
};

TEST_F(CameraPair, PicturesOfOneNumberAreAnsweredTogetherWhicheverCameraIsFirst) {
  start(ClockKind::step);
  take_picture(0, 0, 0);
  take_picture(0, 1, 40);
  take_picture(1, 0, 0);
  ASSERT_TRUE(answered(1));
  take_picture(1, 1, 40);
  ASSERT_TRUE(answered(2));
  end_pictures(0, 2);
  end_pictures(1, 2);
  ASSERT_TRUE(answered(3));
  EXPECT_EQ(answers_, (std::vector<Answer>{good(0), good(1), {{}, 2, 0, true}}));
}

TEST_F(CameraPair, WhenOneCameraGivesNoPictureThereIsNoPair) {
  start(ClockKind::step);
  take_picture(0, 0, 0);
  give_no_picture(1, 0, 0);
  give_no_picture(0, 1, 40);
  take_picture(1, 1, 40);
  take_picture(0, 2, 80);
  take_picture(1, 2, 80);
  ASSERT_TRUE(answered(3));
  EXPECT_EQ(answers_, (std::vector<Answer>{{{}, 0, 0, false}, {{}, 1, 40, false}, good(2)}));
}

TEST_F(CameraPair, PicturesOfOneNumberThatAreOfDifferentStepsAreNoPair) {
  start(ClockKind::step);
  take_picture(0, 0, 0);
  take_picture(1, 0, 40);
  ASSERT_TRUE(await([this] { return ended_.load(); }));
  EXPECT_EQ(fault_, FaultCode::malformed_message);
  EXPECT_TRUE(answers_.empty());
}

TEST_F(CameraPair, ByTheWallClockTheNewestNumberThatBothHaveIsNext) {
  for (std::int64_t k = 0; k < 3; ++k) take_picture(0, k, 40 * k);
  for (std::int64_t k = 0; k < 2; ++k) take_picture(1, k, 40 * k);
  start(ClockKind::wall);
  // Nobody had listened before; from now on both have 3.
  take_picture(1, 3, 120);
  take_picture(0, 3, 120);
  ASSERT_TRUE(answered(1));
  EXPECT_EQ(answers_.back(), good(3));
  take_picture(0, 4, 160);  // the right camera leaves this one out, and the left one the next
  take_picture(1, 5, 200);
  take_picture(0, 6, 240);
  take_picture(1, 6, 240);
  ASSERT_TRUE(answered(2));
  EXPECT_EQ(answers_.back(), good(6));
  take_picture(0, 7, 280);
  end_pictures(0, 8);
  end_pictures(1, 7);
  ASSERT_TRUE(answered(3));
  EXPECT_TRUE(answers_.back().last);
}

}  // namespace
}  // namespace mrroc::vsp
