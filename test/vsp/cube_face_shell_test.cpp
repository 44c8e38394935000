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

link::NodeContext context_of(const std::string& name) {
  link::NodeContext m;
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

CubeFaceReading read_with(const std::string& line) {
  const Config config = Config::parse("[cube_face]\n" + line + "\n" + kConfig, "test");
  static const Image picture = white_face();
  return make_cube_face_sensor(config, "cube").detect(picture.view(), 0, 0);
}

TEST(CubeFaceShell, ThresholdsOfTheConfigurationHaveBounds) {
  struct Key {
    const char* name;
    double low, high;
  };
  for (const Key& key :
       {Key{"place_error", 1e-4, 0.008}, Key{"angle_error", 1e-3, 0.2}, Key{"contrast", 1, 100},
        Key{"rms", 0.01, 10}, Key{"edge_share", 0.1, 1}, Key{"glare_share", 0, 0.67}, Key{"dark", 1, 200},
        Key{"veil", 0, 1}, Key{"confidence", 0.5, 1}}) {
    const auto make = [&key](double value) {
      (void)make_cube_face_sensor(Config::parse("[cube_face]\n" + std::string(key.name) + " = " +
                                                    std::to_string(value) + "\n" + kConfig,
                                                "test"),
                                  "cube");
    };
    EXPECT_NO_THROW(make(key.low)) << key.name;
    EXPECT_NO_THROW(make(key.high)) << key.name;
    EXPECT_THROW(make(key.low - 0.02 * std::max(key.low, 0.005)), ConfigError) << key.name;
    EXPECT_THROW(make(1.01 * key.high), ConfigError) << key.name;
  }
}

TEST(CubeFaceShell, EveryThresholdOfTheConfigurationDoesItsWork) {
  EXPECT_TRUE(read_with("").valid);
  const auto flaw = [](const std::string& line) { return read_with(line).stickers[4].flaw; };
  EXPECT_EQ(flaw("dark = 179"), StickerFlaw::none);
  EXPECT_EQ(flaw("dark = 181"), StickerFlaw::dark);
  EXPECT_FALSE(read_with("rms = 0.01").seen) << "pixels are not that small";
  EXPECT_FALSE(read_with("confidence = 1.0").valid);
  EXPECT_TRUE(read_with("confidence = 0.5").valid);
  // The lower place of the two is 0.1 m away from the other one: with little error allowed the face is there or nowhere.
  EXPECT_EQ(read_with("place_error = 0.002\nangle_error = 0.02").place, 1);
}

TEST(CubeFaceShell, GivesOneReadingPerPictureUntilTheLastOneOfThePlaceThatIsAskedFor) {
  link::FrameWriter store(
      {.session = context_of("mp").session, .session_id = context_of("mp").session_id, .camera = "cube"},
      {.width = 640, .height = 480, .channels = 3, .slots = 8});
  link::MemoryHub hub;
  const auto bus = hub.open();
  link::Process mp(*bus, context_of("mp"));
  link::Outbox<supervisor_t> supervisor(*bus, mp.route("supervisor"), 1);
  const auto frames = mp.outbox<camera_frame_t>("cube.frame");
  const auto readings = mp.inbox<cube_face_reading_t>("cube.cube_face");
  const auto settings = mp.outbox<cube_face_setting_t>("cube.cube_face.setting");
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
    link::Process process(*own, context_of("vsp-cube"));
    run_cube_face(process, Config::parse(kConfig, "test"), {});
  });

  EXPECT_TRUE(await([&] { return state == link::ProcessState::ready; }));
  say(link::Phase::running);
  constexpr std::int64_t kPictures = 6;
  for (std::int64_t k = 0; k < kPictures; ++k) {
    const bool shown = k % 2 == 0;
    const bool there = shown && 2 * k < 8;  // from macrostep 8 on another place is looked at
    camera_frame_t m{};
    m.step = 20 * k;
    m.last = k + 1 == kPictures ? 1 : 0;
    const Image picture = shown ? white_face() : Image(640, 480, 3);
    m.slot = store.write(k, m.step, 0, picture.view());
    frames->publish(m, k);
    // The settings of the macrosteps until then come later than the picture.
    for (std::int64_t i = std::max<std::int64_t>(1, 2 * k - 1); i <= 2 * k; ++i)
      settings->publish(to_message(CubeFaceSetting{.face = 0, .place = i < 8 ? -1 : 0}), i);
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
