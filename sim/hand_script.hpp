// The pen position that the operator's hand wants, over the course of leading it.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/spatial.hpp"
#include "sim/hand.hpp"
#include "sim/hand_path.hpp"
#include "sim/hand_track.hpp"

namespace mrroc::sim {

/// The reference of the hand in sheet coordinates, z above the paper [m]. It goes through the stages
/// travel - above - lower - dwell - draw (- corner - draw) - lift for every stroke, then it holds still.
class HandScript {
 public:
  /// Holds still until a drawing begins.
  explicit HandScript(const HandParameters& parameters) : p_(parameters) {}

  /// Begins a drawing. @param strokes  in mm; empty ones are skipped
  void lead_along(const std::vector<Polyline>& strokes);
  /// Begins to lead to one point. @param point [mm] @param height [m]
  void lead_to(const Eigen::Vector2d& point, double height);
  /// Begins to lead along a track, which is not empty.
  void follow(const HandTrack& track);
  /// The reference is where the pen is, at rest. @param tip [m]
  void grasp(const Vector3& tip);
  /// Ends whatever was going on.
  void stop();
  /// Slows the course of events down to a stand-still, or lets it go on.
  void pause(bool paused) { paused_ = paused; }

  /// Advances by dt. @param tip [m] @param on_paper the pen touches @param wander change of pressure,
  /// relative
  void step(double dt, const Vector3& tip, bool on_paper, double wander);

  /// @return how far it has come
  [[nodiscard]] HandStatus status() const;
  /// @return where the pen should be [m]
  [[nodiscard]] Vector3 position() const { return {place_.x(), place_.y(), height_}; }
  /// @return how it should move [m/s]
  [[nodiscard]] Vector3 velocity() const { return {speed_.x(), speed_.y(), climb_}; }
  /// @return share of what the operator has learnt of the arm's resistance that counts: 0 along a track
  [[nodiscard]] double learnt() const { return stage_ == Stage::follow ? 0 : 1; }
  /// @return how its motion over the sheet changes [m/s^2]
  [[nodiscard]] Vector3 acceleration() const { return {change_.x(), change_.y(), 0}; }

 private:
  enum class Stage : std::uint8_t { travel, above, lower, dwell, draw, corner, lift, follow, hold };

  void begin(std::vector<std::vector<Polyline>> strokes);
  void enter(Stage stage);
  void travel_to(const Eigen::Vector2d& point, double level);
  void begin_piece();
  void end_piece();
  void end_stroke();
  void finish();
  void along_track();
  void advance(double dt, const Vector3& tip, bool on_paper);
  bool along_path(double dt);
  void move_height(double dt, double goal);
  [[nodiscard]] double height_goal(double wander) const;

  HandParameters p_;
  HandPhase phase_{HandPhase::idle};
  Stage stage_{Stage::hold};
  bool paused_{};
  double pace_{1};  // of the script's time, 0 while paused
  double since_{};  // time in the stage [s]

  std::vector<std::vector<Polyline>> strokes_;  // each in pieces between its corners [m]
  std::size_t stroke_{}, piece_{};
  double drawn_{}, total_{};  // length of the finished pieces and of all [m]

  HandTrack track_;  // empty: it leads elsewhere
  HandPath path_;
  double s_{};                                  // done of the path [m]
  Eigen::Vector2d place_{0, 0};                 // [m]
  Eigen::Vector2d speed_{0, 0}, change_{0, 0};  // [m/s], [m/s^2]
  double from_{}, level_{};                     // height of travel at its beginning and end [m]
  double target_{}, height_{}, climb_{};        // height: limited in speed, smoothed, its speed
};

}  // namespace mrroc::sim
