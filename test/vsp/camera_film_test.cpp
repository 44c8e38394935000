// The film of a camera: what its strip shows of a run, and when there is no file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/annotate.hpp"
#include "vsp/camera_loop.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 32, kHeight = 24;

/// The object's axes are in its pictures.
CameraModel small_camera() {
  CameraModel camera{.width = kWidth, .height = kHeight};
  camera.fx = camera.fy = 60;
  camera.cx = 15.5;
  camera.cy = 11.5;
  return camera;
}

class CameraFilmTest : public testing::Test {
 protected:
  CameraFilmTest() : folder_(fs::temp_directory_path() / ("mrroc_film_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~CameraFilmTest() override { fs::remove_all(folder_); }
  CameraFilm film(const std::string& directory) const {
    return {"sac",
            "board",
            {{{0, 0, 0}}, {}, 0.1},
            small_camera(),
            Config::parse(directory.empty() ? "" : "[film]\ndirectory = \"" + directory + "\"\n", "test")};
  }
  static Image plain(int grey) {
    Image picture(kWidth, kHeight, 1);
    std::ranges::fill(picture.data, static_cast<std::uint8_t>(grey));
    return picture;
  }
  static CameraReading reading(std::int64_t frame, bool seen) {
    CameraReading r;
    r.frame = frame;
    r.seen = seen;
    r.T_CG = test::facing(1, 0, 0, 0);
    return r;
  }
  fs::path folder_;
};

TEST_F(CameraFilmTest, ShowsTheCameraThePicturesNumberAndTheText) {
  CameraFilm f = film(folder_.string());
  FilmStrip expected;
  for (const auto& [number, text, shown] :
       {std::tuple(3, "", "sac 3"), std::tuple(40, "0.512 m", "sac 40  0.512 m")}) {
    const CameraReading r = reading(number, number == 40);
    f.see(plain(90).view(), r, text);
    Image drawn = in_colour(plain(90).view());
    annotate(drawn, r, small_camera(), {{{0, 0, 0}}, {}, 0.1}, shown);
    expected.add(r.frame, r.seen, drawn.view());
  }
  EXPECT_FALSE(fs::exists(folder_ / "sac_board.png")) << "before it is to be written";
  f.write();
  EXPECT_EQ(read_picture(folder_ / "sac_board.png"), expected.picture());
}

TEST_F(CameraFilmTest, OfALongRunItKeepsWhatItsStripWants) {
  CameraFilm f = film(folder_.string());
  FilmStrip expected;
  for (std::int64_t k = 0; k < 150; ++k) {
    const CameraReading r = reading(k, k % 11 == 0);
    const Image picture = plain(static_cast<int>(k));
    f.see(picture.view(), r, "");
    Image drawn = in_colour(picture.view());
    annotate(drawn, r, small_camera(), {{{0, 0, 0}}, {}, 0.1}, "sac " + std::to_string(k));
    if (expected.wants(k, r.seen)) expected.add(k, r.seen, drawn.view());
  }
  f.write();
  EXPECT_EQ(read_picture(folder_ / "sac_board.png"), expected.picture());
}

TEST_F(CameraFilmTest, WithoutAFolderOrAPictureThereIsNoFile) {
  film(folder_.string()).write();
  EXPECT_TRUE(fs::is_empty(folder_));
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  CameraFilm f = film("");
  f.see(plain(90).view(), reading(0, true), "");
  f.write();
  fs::current_path(before);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(CameraFilmTest, AFolderThatIsNotThereIsAnError) {
  CameraFilm f = film((folder_ / "none").string());
  f.see(plain(90).view(), reading(0, true), "");
  EXPECT_THROW(f.write(), FaultError);
}

}  // namespace
}  // namespace mrroc::vsp
