// Shared behaviour of all receptors of cameras: the answer to each picture, its end and its failures.
#include "vsp/camera_loop.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "base/link/frame_store.hpp"
#include "base/link/memory_bus.hpp"
#include "mrroc/camera_frame_t.hpp"

namespace mrroc::vsp {
namespace {

constexpr int kWidth = 32, kHeight = 24, kSlots = 4;

CameraModel small_camera() { return {.width = kWidth, .height = kHeight}; }

link::NodeContext context_of(const std::string& name, ClockKind clock = ClockKind::step) {
  link::NodeContext m;
  m.clock = clock;
  m.session = "loop" + std::to_string(getpid());
  m.name = name;
  m.roster = {"mp", "vsp-sac"};
  return m;
}

/// One answer of the receptor.
struct Answer {
  int grey;  ///< of the picture; -1: there was none
  std::int64_t frame, step;
  double t;
  bool last;
  friend bool operator==(const Answer&, const Answer&) = default;
};
std::ostream& operator<<(std::ostream& out, const Answer& a) {
  return out << a.grey << ", frame " << a.frame << ", step " << a.step << ", t " << a.t
             << (a.last ? ", last" : "");
}

class CameraLoop : public testing::Test {
 protected:
  explicit CameraLoop(ClockKind clock = ClockKind::step)
      : bus_(hub_.open()),
        mp_(*bus_, context_of("mp")),
        supervisor_(*bus_, mp_.route("supervisor"), 1),
        frames_(mp_.outbox<camera_frame_t>("sac.frame")),
        status_(*bus_, mp_.route("vsp-sac.status"), 1),
        clock_(clock) {
    mp_.on_service = [this] {
      while (const auto s = status_.take()) last_status_ = *s;
    };
  }
  ~CameraLoop() override {
    said_ = link::Phase::finished;
    if (thread_.joinable()) {
      EXPECT_TRUE(ended());
    }
  }

  void make_store(int width = kWidth, int height = kHeight) {
    store_.emplace(
        link::FrameStoreName{
            .session = context_of("mp").session, .session_id = context_of("mp").session_id, .camera = "sac"},
        link::FrameStoreShape{.width = width, .height = height, .channels = 1, .slots = kSlots});
  }
  void begin() {
    thread_ = std::jthread([this] {
      const auto bus = hub_.open();
      link::Process process(*bus, context_of("vsp-sac", clock_));
      try {
        run_camera(
            process, camera_of(process), small_camera(),
            [this](const ImageView* picture, std::int64_t frame, std::int64_t step, double t, bool last) {
              nice_ = getpriority(PRIO_PROCESS, static_cast<id_t>(gettid()));
              answers_.push_back({picture != nullptr ? picture->at(3, 5, 0) : -1, frame, step, t, last});
              answered_ = static_cast<int>(answers_.size());
            },
            [this] { ++ends_; });
      } catch (const FaultError& e) {
        fault_ = e.fault().code;
        text_ = e.what();
      }
      ended_ = true;
    });
  }
  void start() {
    begin();
    ASSERT_TRUE(await([this] { return state() == link::ProcessState::ready; }));
    say(link::Phase::running);
  }
  link::ProcessState state() const { return static_cast<link::ProcessState>(last_status_.state); }
  template <class Ready>
  bool await(Ready ready) {
    return mp_.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  }
  bool answered(int n) {
    return await([this, n] { return answered_ >= n; });
  }
  /// Says the last word again until it is obeyed: who did not listen yet has not heard it.
  bool ended() {
    return await([this] {
      if (said_) say(*said_);
      return ended_.load();
    });
  }
  void say(link::Phase phase) {
    said_ = phase;
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor_.publish(m, 0);
  }
  int write(std::int64_t k) {
    Image image(kWidth, kHeight, 1);
    std::ranges::fill(image.data, static_cast<std::uint8_t>(100 + k));
    return store_->write(k, 20 * k, 0.04 * static_cast<double>(k), image.view());
  }
  void announce(std::int64_t k, int slot, bool last = false, std::int64_t more_steps = 0) {
    camera_frame_t m{};
    m.step = 20 * k + more_steps;
    m.slot = slot;
    m.last = last ? 1 : 0;
    frames_->publish(m, k);
  }
  void take_picture(std::int64_t k) { announce(k, write(k)); }
  static Answer good(std::int64_t k) {
    return {static_cast<int>(100 + k), k, 20 * k, 0.04 * static_cast<double>(k), false};
  }

  std::optional<link::FrameWriter> store_;
  link::MemoryHub hub_;
  std::unique_ptr<link::Bus> bus_;
  link::Process mp_;
  link::Outbox<supervisor_t> supervisor_;
  std::unique_ptr<link::Outbox<camera_frame_t>> frames_;
  link::Queue<process_status_t> status_;
  ClockKind clock_;
  process_status_t last_status_{};
  std::vector<Answer> answers_;  // to be read when answered() or ended()
  std::atomic<int> answered_{}, ends_{}, nice_{};
  std::atomic<bool> ended_{false};
  FaultCode fault_{FaultCode::none};
  std::string text_;
  std::optional<link::Phase> said_;
  std::jthread thread_;
};

class HurriedCameraLoop : public CameraLoop {
 protected:
  HurriedCameraLoop() : CameraLoop(ClockKind::wall) {}
};

TEST(CameraName, IsWhatStandsBehindTheProcesssPrefix) {
  link::MemoryHub hub;
  const auto bus = hub.open();
  const auto name = [&bus](const std::string& process) {
    return camera_of(link::Process(*bus, context_of(process)));
  };
  EXPECT_EQ(name("vsp-sac"), "sac");
  EXPECT_EQ(name("vsp-a"), "a");
  for (const char* const wrong : {"vsp-", "sac", "vsp", "my-vsp-sac"}) try {
      (void)name(wrong);
      ADD_FAILURE() << wrong;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
      EXPECT_NE(std::string(e.what()).find(std::string("is called vsp-CAMERA, not ") + wrong),
                std::string::npos)
          << e.what();
    }
}

TEST_F(CameraLoop, EveryPictureIsAnsweredInItsOrderAndTheLastAnnouncementWithoutOne) {
  make_store();
  start();
  for (std::int64_t k = 0; k < 3; ++k) take_picture(k);
  ASSERT_TRUE(answered(3));
  EXPECT_EQ(ends_, 0);
  announce(3, 0, true);
  ASSERT_TRUE(await([this] { return state() == link::ProcessState::done; }));
  EXPECT_EQ(answers_, (std::vector<Answer>{good(0), good(1), good(2), {-1, 3, 60, 0, true}}));
  EXPECT_EQ(ends_, 1);
  EXPECT_EQ(last_status_.skipped, 0);
  EXPECT_EQ(last_status_.macrostep, 2);
  EXPECT_EQ(last_status_.step, 40);
  EXPECT_FALSE(ended_) << "somebody may need an answer repeated";
  say(link::Phase::finished);
  EXPECT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::none) << text_;
}

TEST_F(CameraLoop, InLockStepAPictureThatWasWrittenOverIsAnError) {
  make_store();
  start();
  const int slot = write(0);
  for (std::int64_t k = 1; k <= kSlots; ++k) write(k);
  announce(0, slot);
  ASSERT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::malformed_message);
  EXPECT_NE(text_.find("picture 0 was written over before it was read"), std::string::npos) << text_;
  EXPECT_TRUE(answers_.empty());
}

TEST_F(HurriedCameraLoop, ByTheWallClockAPictureThatWasWrittenOverIsAnsweredWithoutIt) {
  make_store();
  start();
  const int slot = write(0);
  for (std::int64_t k = 1; k <= kSlots; ++k) write(k);
  announce(0, slot);
  ASSERT_TRUE(answered(1));
  take_picture(kSlots + 1);
  ASSERT_TRUE(answered(2));
  EXPECT_EQ(answers_, (std::vector<Answer>{{-1, 0, 0, 0, false}, good(kSlots + 1)}));
  announce(kSlots + 2, 0, true);
  ASSERT_TRUE(await([this] { return state() == link::ProcessState::done; }));
  EXPECT_EQ(last_status_.skipped, 1 + kSlots) << "the lost one, and those that were never announced";
}

TEST_F(HurriedCameraLoop, TheNextPictureIsTheOneAfterTheLastOne) {
  make_store();
  start();
  EXPECT_TRUE(answers_.empty());
  for (std::int64_t k = 0; k < 6; ++k) {
    take_picture(k);
    ASSERT_TRUE(answered(static_cast<int>(k) + 1));
  }
  for (std::int64_t k = 0; k < 6; ++k) EXPECT_EQ(answers_[static_cast<std::size_t>(k)], good(k));
  announce(6, 0, true);
  ASSERT_TRUE(await([this] { return state() == link::ProcessState::done; }));
  EXPECT_EQ(last_status_.skipped, 0);
}

TEST_F(HurriedCameraLoop, StandsBackBehindWhoMustBeInTimeButNotBehindWhoDraws) {
  make_store();
  start();
  take_picture(0);
  ASSERT_TRUE(answered(1));
  constexpr int kRenderer = 5;  // sim/camera/camera_worker.cpp
  EXPECT_GT(nice_, 0);
  // Without privileges nobody becomes less nice than it is.
  EXPECT_LT(nice_, std::max(kRenderer, getpriority(PRIO_PROCESS, 0) + 1));
}

TEST_F(CameraLoop, InLockStepItStandsBackBehindNobody) {
  make_store();
  start();
  take_picture(0);
  ASSERT_TRUE(answered(1));
  EXPECT_EQ(nice_, getpriority(PRIO_PROCESS, 0));
}

TEST_F(CameraLoop, ASlotThatDoesNotExistIsAnError) {
  make_store();
  start();
  announce(0, kSlots);
  ASSERT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::malformed_message);
  EXPECT_NE(text_.find("the frame store has no picture 0"), std::string::npos) << text_;
}

TEST_F(CameraLoop, APictureOfAnotherStepThanAnnouncedIsAnError) {
  make_store();
  start();
  take_picture(0);
  announce(1, write(1), false, 1);
  ASSERT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::malformed_message);
  EXPECT_NE(text_.find("picture 1 is of another step than announced"), std::string::npos) << text_;
}

TEST_F(CameraLoop, PicturesOfAnotherSizeThanTheModelAreRefusedInEitherDirection) {
  make_store(kWidth, kHeight + 1);
  begin();
  ASSERT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::bad_configuration);
  EXPECT_NE(text_.find("the pictures of camera sac are 32 x 25, its model says 32 x 24"), std::string::npos)
      << text_;
  EXPECT_EQ(ends_, 0);
}

TEST_F(CameraLoop, ItWaitsForAStoreThatIsNotMadeYet) {
  begin();
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // longer than a second
  EXPECT_FALSE(ended_);
  make_store();
  EXPECT_TRUE(await([this] { return state() == link::ProcessState::ready; })) << text_;
}

TEST_F(CameraLoop, WithoutAStoreTheCameraIsSilentWhenTheSystemEnds) {
  begin();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  say(link::Phase::finished);
  ASSERT_TRUE(ended());
  EXPECT_EQ(fault_, FaultCode::hardware_silent);
  EXPECT_NE(text_.find("camera sac has no store of frames"), std::string::npos) << text_;
}

TEST_F(CameraLoop, ASystemThatEndsBeforeItHasBegunLeavesNothing) {
  make_store();
  begin();
  ASSERT_TRUE(await([this] { return state() == link::ProcessState::ready; }));
  say(link::Phase::finished);
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends_, 0);
  EXPECT_TRUE(answers_.empty());
  EXPECT_EQ(fault_, FaultCode::none);
}

TEST_F(CameraLoop, ASystemThatEndsInBetweenEndsIt) {
  make_store();
  start();
  take_picture(0);
  ASSERT_TRUE(answered(1));
  say(link::Phase::finished);
  ASSERT_TRUE(ended());
  EXPECT_EQ(ends_, 1);
  EXPECT_EQ(answers_, std::vector<Answer>{good(0)});
}

}  // namespace
}  // namespace mrroc::vsp
