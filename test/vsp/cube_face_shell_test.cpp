// The process of the cube's receptor: one reading for every picture to the last one, and where places come from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "base/link/frame_store.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert_cube_face.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "vsp/cube_face/receptor.hpp"

namespace mrroc::vsp {
namespace {

constexpr const char* kConfig = R"(
[cameras.cube]
pose = [0.1, 0.2, 1.5, 3.141592653589793, 0, 0]
fx = 1000
[cube_face.places.front]
pose = [0.1, 0.2, 1, 0, 0, 0]
[cube_face.places.above]
pose = [0.1, 0.2, 1.1, 0, 0, 0]
)";

link::Membership member(const std::string& name) {
  link::Membership m;
  m.session = "cube" + std::to_string(getpid());
  m.name = name;
  m.roster = {"mp", "vsp-cube"};
  return m;
}

/// White stickers on black, as a camera sees them that looks down from 1.5 m to 1 m.
Image white_face() {
  Image picture(640, 480, 3);
  const double scale = 1000 / 0.5;  // [pixel/m]
  for (int k = 0; k < kStickers; ++k) {
    const double u = 319.5 + scale * kCubeFace.middle(k).x();
    const double v = 239.5 + scale * kCubeFace.middle(k).y();
    const int half = static_cast<int>(scale * kCubeFace.sticker / 2);
    for (int y = -half; y <= half; ++y)
      std::fill_n(picture.row(static_cast<int>(v) + y) + 3 * (static_cast<int>(u) - half), 3 * (2 * half + 1),
                  180);
  }
  return picture;
}

TEST(CubeFaceShell, PlacesAreGivenInTheFrameOfTheCamerasOwnPose) {
  const Config config = Config::parse(kConfig, "test");
  EXPECT_EQ(cube_face_places(config), (std::vector<std::string>{"above", "front"}));
  const Image picture = white_face();
  const CubeFaceReading reading = make_cube_face_sensor(config, "cube").detect(picture.view(), 0, 0);
  EXPECT_TRUE(reading.seen);
  EXPECT_EQ(reading.place, 1);
  EXPECT_NEAR(reading.T_CG.p.z(), 0.5, 0.005);
}

TEST(CubeFaceShell, GivesOneReadingPerPictureUntilTheLastOne) {
  link::FrameWriter store(
      {.session = member("mp").session, .session_id = member("mp").session_id, .camera = "cube"},
      {.width = 640, .height = 480, .channels = 3, .slots = 8});
  link::MemoryHub hub;
  const auto bus = hub.open();
  link::Process mp(*bus, member("mp"));
  link::Outbox<supervisor_t> supervisor(*bus, mp.route("supervisor"), 1);
  const auto frames = mp.outbox<camera_frame_t>("cube.frame");
  const auto readings = mp.inbox<cube_face_reading_t>("cube.cube_face");
  link::Queue<process_status_t> status(*bus, mp.route("vsp-cube.status"), 1);
  link::ProcessState state{};
  mp.on_service = [&] {
    while (const auto s = status.take()) state = static_cast<link::ProcessState>(s->state);
  };
  const auto say = [&supervisor](link::Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    supervisor.publish(m, 0);
  };
  const auto await = [&mp](auto ready) {
    return mp.await(ready, link::Process::Clock::now() + std::chrono::seconds(20));
  };
  const std::jthread receptor([&hub] {
    const auto own = hub.open();
    link::Process process(*own, member("vsp-cube"));
    run_cube_face(process, Config::parse(kConfig, "test"), {});
  });

  EXPECT_TRUE(await([&] { return state == link::ProcessState::ready; }));
  say(link::Phase::running);
  constexpr std::int64_t kPictures = 6;
  for (std::int64_t k = 0; k < kPictures; ++k) {
    const bool there = k % 2 == 0;
    camera_frame_t m{};
    m.step = 20 * k;
    m.last = k + 1 == kPictures ? 1 : 0;
    const Image picture = there ? white_face() : Image(640, 480, 3);
    m.slot = store.write(k, m.step, 0, picture.view());
    frames->publish(m, k);
    EXPECT_TRUE(await([&] { return readings->at(k) != nullptr; })) << k;
    if (readings->at(k) == nullptr) break;
    const CubeFaceReading r = from_message(*readings->at(k));
    EXPECT_EQ(r.frame, k);
    EXPECT_EQ(r.step, 20 * k);
    EXPECT_EQ(r.seen, there) << k;
    EXPECT_EQ(readings->at(k)->last, m.last);
  }
  EXPECT_TRUE(await([&] { return state == link::ProcessState::done; }));
  say(link::Phase::finished);
}

}  // namespace
}  // namespace mrroc::vsp
