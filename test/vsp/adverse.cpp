#include "test/vsp/adverse.hpp"

#include <array>
#include <functional>
#include <numbers>
#include <vector>

#include "base/target/board.hpp"
#include "base/target/tag.hpp"

namespace mrroc::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kKinds{"none",    "noise", "stripes", "cloth",   "likeness",  "covered",
                            "cut off", "two",   "glare",   "blurred", "scrambled", "clutter",
                            "uniform", "moved", "faint",   "inverted"};

}  // namespace

AdversePictures::AdversePictures(const CameraModel& camera, Object object, unsigned seed, int rays)
    : camera_(camera, rays), object_(object), random_(seed) {}

int AdversePictures::kinds() { return static_cast<int>(kKinds.size()); }

Pose AdversePictures::place(double nearest, double farthest) {
  const double d = uniform(nearest, farthest);
  return facing(d, uniform(0, 0.9), uniform(0, 2 * kPi), uniform(0, 2 * kPi), uniform(-0.25, 0.25) * d,
                uniform(-0.2, 0.2) * d);
}

AdversePictures::Texture AdversePictures::object() {
  const Board& b = kBoard;
  const Tag& t = kTag;
  const auto table = static_cast<float>(uniform(20, 220));
  return object_ == Object::chessboard ? chessboard_texture(b.columns, b.rows, b.square, b.margin, table)
                                       : tag_texture(t.id, t.edge, t.margin, table);
}

// Another board, or another tag.
AdversePictures::Texture AdversePictures::likeness() {
  if (object_ == Object::apriltag) return tag_texture(1 + pick(500), uniform(0.06, 0.15), 0.025);
  constexpr std::array<std::pair<int, int>, 14> kCounts{{{8, 6},
                                                         {10, 6},
                                                         {9, 5},
                                                         {9, 7},
                                                         {10, 7},
                                                         {8, 5},
                                                         {7, 5},
                                                         {12, 9},
                                                         {9, 9},
                                                         {6, 6},
                                                         {4, 3},
                                                         {5, 8},
                                                         {11, 6},
                                                         {9, 8}}};
  const auto [columns, rows] = kCounts[static_cast<std::size_t>(pick(static_cast<int>(kCounts.size())))];
  return chessboard_texture(columns, rows, uniform(0.015, 0.035), uniform(0.005, 0.03),
                            static_cast<float>(uniform(20, 220)));
}

// An opaque bar lies over a part of the object, at least over one inner corner or a third of the tag.
AdversePictures::Texture AdversePictures::covered(const Texture& texture) {
  const double angle = uniform(0, 2 * kPi);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double from = uniform(-0.06, 0.03);
  const double width = uniform(0.02, 0.3);
  const auto brightness = static_cast<float>(uniform(0, 255));
  return [=](double x, double y) {
    const double across = c * x + s * y - from;
    return across > 0 && across < width ? brightness : texture(x, y);
  };
}

// The object with some squares or cells of the wrong colour.
AdversePictures::Texture AdversePictures::scrambled() {
  const Texture whole = object();
  const double cell = object_ == Object::chessboard ? kBoard.square : kTag.edge / 8;
  const double shift =
      object_ == Object::chessboard ? 0.5 * cell : 0;  // rows of squares are odd, of cells even
  std::vector<char> wrong(400);
  for (char& w : wrong) w = pick(4) == 0 ? 1 : 0;
  return [=](double x, double y) {
    const int u = static_cast<int>(std::floor(x / cell)) + 10;
    const int v = static_cast<int>(std::floor((y + shift) / cell)) + 10;
    if (u < 0 || v < 0 || u >= 20 || v >= 20) return whole(x, y);
    return wrong[20 * static_cast<std::size_t>(v) + static_cast<std::size_t>(u)] != 0 ? 255 - whole(x, y)
                                                                                      : whole(x, y);
  };
}

AdversePictures::Texture AdversePictures::cloth() {
  const double a = uniform(0.008, 0.06);
  const double b = pick(2) == 0 ? a : uniform(0.008, 0.06);
  const auto light = static_cast<float>(uniform(130, 250));
  const auto dark = static_cast<float>(uniform(0, 110));
  return [=](double x, double y) {
    const int n = static_cast<int>(std::floor(x / a)) + static_cast<int>(std::floor(y / b));
    return n % 2 == 0 ? dark : light;
  };
}

AdversePictures::Texture AdversePictures::stripes() {
  const double a = uniform(0.004, 0.05);
  const double share = uniform(0.2, 0.8);
  const bool lattice = pick(2) == 0;
  return [=](double x, double y) {
    const double u = x / a - std::floor(x / a);
    const double v = y / a - std::floor(y / a);
    return u < share || (lattice && v < share) ? 225.0F : 25.0F;
  };
}

// Rectangles of all sizes and colours over each other.
AdversePictures::Texture AdversePictures::clutter() {
  struct Box {
    double x, y, c, s, a, b;
    float brightness;
  };
  std::vector<Box> boxes;
  const int n = 30 + pick(60);
  for (int k = 0; k < n; ++k) {
    const double angle = pick(2) == 0 ? 0 : uniform(0, kPi);
    boxes.push_back({uniform(-0.4, 0.4), uniform(-0.3, 0.3), std::cos(angle), std::sin(angle),
                     uniform(0.005, 0.05), uniform(0.005, 0.05),
                     static_cast<float>(pick(2) == 0 ? uniform(0, 60) : uniform(180, 255))});
  }
  return [boxes](double x, double y) {
    float brightness = 150;
    for (const Box& b : boxes) {
      const double u = b.c * (x - b.x) + b.s * (y - b.y);
      const double v = b.c * (y - b.y) - b.s * (x - b.x);
      if (std::abs(u) < b.a && std::abs(v) < b.b) brightness = b.brightness;
    }
    return brightness;
  };
}

// Two objects beside each other. Nothing may be said to be seen: which of them would it be?
AdversePictures::Texture AdversePictures::two() {
  return [one = object()](double x, double y) { return one(x < 0 ? x + 0.17 : x - 0.17, y); };
}

AdversePictures::Texture AdversePictures::glare() {
  const double u = uniform(-0.1, 0.1);
  const double v = uniform(-0.07, 0.07);
  const double r = uniform(0.02, 0.1);
  return [one = object(), u, v, r](double x, double y) {
    const double q = std::hypot(x - u, y - v) / r;
    return one(x, y) + static_cast<float>(300 * std::exp(-q * q));
  };
}

// A long exposure while the object moves: two ghosts.
AdversePictures::Texture AdversePictures::moved() {
  const double dx = uniform(-0.02, 0.02);
  const double dy = uniform(-0.02, 0.02);
  return [one = object(), dx, dy](double x, double y) { return 0.5F * (one(x, y) + one(x + dx, y + dy)); };
}

bool AdversePictures::show_object(const std::string& kind, Shot& shot) {
  if (kind == "covered") {
    shot.texture = covered(object());
  } else if (kind == "cut off") {
    shot.T.p.x() = (pick(2) == 0 ? -1 : 1) * uniform(0.3, 0.6) * shot.T.p.z();
    shot.texture = object();
  } else if (kind == "glare") {
    shot.texture = glare();
  } else if (kind == "blurred") {
    shot.exposure.blur = uniform(2, 10);
    shot.texture = object();
  } else if (kind == "scrambled") {
    shot.texture = scrambled();
  } else if (kind == "moved") {
    shot.texture = moved();
  } else if (kind == "faint") {
    shot.exposure.gain = uniform(0.02, 0.3);
    shot.exposure.offset = uniform(0, 150);
    shot.texture = object();
  } else {
    return false;
  }
  return true;
}

void AdversePictures::show_something_else(const std::string& kind, Shot& shot) {
  shot.texture = [](double x, double y) { return static_cast<float>(130 + 200 * x + 100 * y); };
  if (kind == "noise") {
    shot.exposure.noise = uniform(20, 120);
    shot.exposure.blur = uniform(0, 3);
    if (pick(2) == 0) shot.texture = clutter();
  } else if (kind == "stripes") {
    shot.texture = stripes();
  } else if (kind == "cloth") {
    shot.texture = cloth();
  } else if (kind == "likeness") {
    shot.texture = likeness();
  } else if (kind == "two") {
    shot.texture = two();
    shot.T = facing(uniform(0.8, 1.6), uniform(0, 0.4), uniform(0, 2 * kPi), 0);
  } else if (kind == "clutter") {
    shot.texture = clutter();
  } else if (kind == "uniform") {
    const auto brightness = static_cast<float>(std::array{0, 128, 255}[static_cast<std::size_t>(pick(3))]);
    shot.texture = [brightness](double, double) { return brightness; };
    shot.exposure.noise = pick(2) == 0 ? 0 : shot.exposure.noise;
  } else if (kind == "inverted") {
    shot.texture = [one = object()](double x, double y) { return 255 - one(x, y); };
  }
}

AdversePicture AdversePictures::next() {
  AdversePicture result;
  result.kind = kKinds[static_cast<std::size_t>(number_++ % kinds())];
  Shot shot;
  shot.exposure.seed = static_cast<unsigned>(random_());
  shot.exposure.noise = uniform(0, 6);
  shot.exposure.blur = uniform(0, 1);
  shot.T = place(0.3, 1.6);
  if (show_object(result.kind, shot))
    result.T_CG = shot.T;
  else
    show_something_else(result.kind, shot);
  result.image = camera_.render(shot.T, shot.texture, shot.exposure);
  last_ = shot.T;
  return result;
}

Image AdversePictures::faultless() { return camera_.render(last_, object(), {}); }

bool is_false(const CameraReading& reading, const AdversePicture& picture) {
  if (!reading.seen) return false;
  if (!picture.T_CG) return true;
  const double angle = angle_axis_from_rotation(reading.T_CG.R.transpose() * picture.T_CG->R).norm();
  return (reading.T_CG.p - picture.T_CG->p).norm() > 0.02 * picture.T_CG->p.norm() || angle > 5 * kPi / 180;
}

}  // namespace mrroc::test
