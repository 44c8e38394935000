#include "tasks/visual_servo/servo.hpp"

#include <algorithm>

#include "base/screw.hpp"

namespace mrroc::visual_servo {
namespace {

using X = Arm::X;

// After a refusal the speeds are halved, and come back within half a second.
constexpr double kEaseFall = 0.5, kEaseRise = 0.1, kLeastEase = 0.1;

/// Rotates a covariance along the axes of C into those of a frame in which C has this orientation.
Matrix6 turned(const Matrix3& R, const Matrix6& covariance) {
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = R;
  J.bottomRightCorner<3, 3>() = R;
  return J * covariance * J.transpose();
}

/// Covariance of a reading, enlarged by that of the camera's calibration.
Matrix6 covariance_of(const Parameters& k, const CameraReading& reading) {
  Vector6 least;
  least << Vector3::Constant(k.position_floor), Vector3::Constant(k.angle_floor);
  return reading.covariance + Matrix6(least.cwiseAbs2().asDiagonal());
}

/// Covariance of xi in e exp(xi), see CameraError.
/// @param R           orientation of G in the frame along which the covariance is
/// @param covariance  of the pose of G
Matrix6 covariance_of_error(const Parameters& k, const Matrix3& R, const Matrix6& covariance) {
  const Pose T_GEd = k.T_EGd.inverse();
  const Vector3 lever = R * T_GEd.p;  // from G to the desired E
  Matrix6 J = Matrix6::Identity();
  J.topRightCorner<3, 3>() = -skew(lever);
  const Matrix6 at_E = J * covariance * J.transpose();
  return turned((R * T_GEd.R).transpose(), at_E);
}

/// Takes new sightings into the track, the older picture first.
void look(const X& x, Conclusion& c) {
  std::array<Camera, kCameras> order{Camera::sac, Camera::eih};
  const auto step = [&](Camera camera) { return x.V.camera[index(camera)].reading.step; };
  std::ranges::stable_sort(order, {}, step);
  for (const Camera camera : order) {
    const std::size_t n = index(camera);
    const std::int64_t frame = x.V.camera[n].reading.frame;
    if (!c.sees[n] || frame <= c.taken[n]) continue;
    c.track = see(x.c.k.track, c.track, sighting(x, camera), x.c.k.pacing.dt);
    c.taken[n] = frame;
  }
}

/// Displacements that the driver has been told for the present control step and the one before. With the wall clock
/// control steps may have been passed over, in which it was told nothing.
struct Commanded {
  Pose now, before;
};
Commanded commanded_already(const X& x) {
  if (x.parts) return {(*x.parts)[0], (*x.parts)[1]};
  const std::int64_t passed_over = x.i - x.c.made_in - 1;
  if (passed_over <= 0) return {x.c.under_way, x.c.before};
  return {{}, passed_over == 1 ? x.c.under_way : Pose{}};
}

/// A displacement of the control step's steps, of so many of them.
Pose part_of(const Pose& displacement, double share) { return exp_screw(log_screw(displacement), share); }

/// The displacement of E during the control step that keeps it at rest against the moving object.
Pose following(const Start& start, const Pose& T_0G, const ObjectMotion& motion, double duration) {
  const Pose T_0G_end = carried(T_0G, motion, duration);
  return start.T_0E.inverse() * (T_0G_end * T_0G.inverse()) * start.T_0E;
}

}  // namespace

int longest_age(const Parameters& k) {
  std::int64_t frames = kPosesKept;
  for (const CameraParameters& camera : k.camera)
    if (camera.used) frames = std::min(frames, (kPosesKept - k.pacing.n_s - camera.latency) / camera.period);
  return static_cast<int>(std::max<std::int64_t>(0, frames));
}

std::int64_t age_of_picture(const X& x, Camera camera) {
  const CameraImage& image = x.V.camera[index(camera)];
  return image.there ? x.e.step - image.reading.step : (x.i - x.c.begun) * x.c.k.pacing.n_s;
}

std::int64_t oldest_believed(const Parameters& k, Camera camera) {
  const CameraParameters& c = k.camera[index(camera)];
  return k.max_age * c.period + c.latency;
}

bool sees(const X& x, Camera camera) {
  const CameraImage& image = x.V.camera[index(camera)];
  return x.c.k.camera[index(camera)].used && image.there && image.reading.seen &&
         age_of_picture(x, camera) <= oldest_believed(x.c.k, camera);
}

bool remembers(const X& x) { return x.c.track.known && x.e.step - x.c.track.step <= x.c.k.track.memory; }

bool not_made(const X& x) {
  const Mishap mishap = mishap_of(x.e);
  return mishap == Mishap::refused || mishap == Mishap::failed;
}

Sighting sighting(const X& x, Camera camera) {
  const CameraImage& image = x.V.camera[index(camera)];
  const Pose& place = x.c.k.camera[index(camera)].place;
  const Pose T_0C = camera == Camera::sac ? place : image.T_0E * place;
  return {image.reading.step, T_0C * image.reading.T_CG, turned(T_0C.R, covariance_of(x.c.k, image.reading))};
}

Start start_of_command(const X& x) {
  const Commanded commanded = commanded_already(x);
  // x_ce was measured before the motion of its step, n_Q; the rest of that control step and the whole of the next one
  // are still to come.
  const int rest = x.c.k.pacing.n_s - x.c.k.pacing.n_Q + 1;
  const Pose T_0E = pose_of(x.e);
  const double share = not_made(x) ? 0 : static_cast<double>(rest) / x.c.k.pacing.n_s;
  return {x.e.step + rest + x.c.k.pacing.n_s, T_0E * part_of(commanded.before, share) * commanded.now};
}

CameraError error_of(const X& x, Camera camera, const Start& start, const ObjectMotion& motion) {
  const Parameters& k = x.c.k;
  const Sighting seen = sighting(x, camera);
  const Pose T_0G = carried(seen.T_0G, motion, static_cast<double>(start.step - seen.step) * k.pacing.dt);
  const Pose T_EG = start.T_0E.inverse() * T_0G;
  const CameraReading& reading = x.V.camera[index(camera)].reading;
  return {T_EG * k.T_EGd.inverse(), covariance_of_error(k, reading.T_CG.R, covariance_of(k, reading))};
}

CameraError error_of(const Parameters& k, const ObjectTrack& track, const Start& start,
                     const ObjectMotion& motion) {
  const Pose T_0G = carried(track.T_0G, motion, static_cast<double>(start.step - track.step) * k.pacing.dt);
  return {start.T_0E.inverse() * T_0G * k.T_EGd.inverse(),
          covariance_of_error(k, track.T_0G.R, track.P.topLeftCorner<6, 6>())};
}

Conclusion conclude(const X& x, const std::array<bool, kCameras>& uses) {
  const Parameters& k = x.c.k;
  Conclusion c{x.c.track, x.c.taken, {sees(x, Camera::sac), sees(x, Camera::eih)}, {}, {}, {}, {}};
  look(x, c);
  const bool refused = not_made(x);
  c.refused = refused ? x.c.refused + 1 : has(x.e.parts, Part::arm) ? 0 : x.c.refused;
  c.ease = refused ? std::max(kLeastEase, kEaseFall * x.c.ease) : std::min(1., x.c.ease + kEaseRise);
  const bool sac = uses[index(Camera::sac)], eih = uses[index(Camera::eih)];
  if (!sac && !eih && !remembers(x)) return c;
  const Start start = start_of_command(x);
  const ObjectMotion motion = k.feed_forward ? significant_motion(k.track, c.track) : ObjectMotion{};
  const auto error = [&](Camera camera) { return error_of(x, camera, start, motion); };
  const CameraError seen = sac && eih   ? aggregate(k.aggregation, error(Camera::sac), error(Camera::eih))
                           : sac || eih ? error(sac ? Camera::sac : Camera::eih)
                                        : error_of(k, c.track, start, motion);
  c.e = seen.e;
  const double duration = k.pacing.macrostep_s();
  const Pose T_0G = start.T_0E * c.e * k.T_EGd;
  const RegulatorParameters R_T = quieted(eased(k.regulator, c.ease), c.e, seen.covariance);
  const Pose wanted = following(start, T_0G, motion, duration) * regulate(R_T, c.e, duration);
  if (x.waiting == 0) c.T_dc = smooth(R_T, wanted, commanded_already(x).now, duration);
  return c;
}

}  // namespace mrroc::visual_servo
