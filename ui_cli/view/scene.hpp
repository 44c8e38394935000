// The objects in the cell, as the configuration of a run describes them.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/ground_area.hpp"
#include "base/pose.hpp"
#include "base/room_config.hpp"

namespace mrroc::view {

/// One arm with what is in front of it.
struct ArmScene {
  std::string name;         ///< key in the configuration, also on its channels
  std::string model;        ///< its description is robots/irb6/MODEL.urdf
  AngleAxisPose place;      ///< T_UB, its base in the world: x y z [m], angle-axis [rad]
  Pose T_0P;                ///< its sheet of paper in its base: x to the right, y away from the arm, z up
  bool belt{};              ///< it is a conveyor, on whose belt the sheets of the arms lie
  std::string gripper;      ///< "none" or "two_jaw"
  std::string fingers;      ///< "none", "one_layer" or "two_layers" of a cube
  bool palm{};              ///< the tool ends in a palm
  AngleAxisPose tool;       ///< T_WE: x y z [m], angle-axis [rad]
  std::string plate;        ///< on the sheet: "none", "rectangle" or "ellipse"
  Vector3 plate_size;       ///< along the sheet's x, y and z [m]
  double plate_distance{};  ///< of its middle from the sheet's centre along y [m]
};

/// One platform.
struct PlatformScene {
  std::string name;   ///< key in the configuration, also on its channels
  std::string model;  ///< its description is robots/MODEL/MODEL.urdf
};

/// A box that platforms push.
struct BoxScene {
  std::string name;              ///< key in the configuration, also on its channels
  std::array<double, 2> size{};  ///< along its x and y [m]
};

/// One camera.
struct CameraScene {
  std::string name;  ///< key in the configuration
  int width{};       ///< [pixel]
  int height{};      ///< [pixel]
};

/// A body that belongs to no robot.
struct BodyScene {
  std::string shape{"none"};         ///< "ball", "box", or "none": there is none
  double size{};                     ///< as it really is [m]
  std::array<double, 3> pedestal{};  ///< middle of its upper side in the world [m]
};

/// Everything that does not move by itself.
struct Scene {
  std::vector<ArmScene> arms;            ///< as robots.order has them
  std::vector<PlatformScene> platforms;  ///< as platforms.order has them
  Room room;                             ///< in which they drive; meaningless without one
  std::vector<GroundArea> ground;        ///< areas of its floor that have another friction
  std::vector<BoxScene> boxes;           ///< in it
  std::vector<CameraScene> cameras;      ///< as cameras.order has them
  std::string cube_held_by;              ///< name of an arm; empty: there is no cube
  BodyScene body;                        ///< between the arms
  std::string object;                    ///< what the cameras look for: "none", "chessboard", "apriltag", ...
  std::string object_arm;                ///< in whose base its place is told
  Vector3 object_size{Vector3::Zero()};  ///< of its plate [m]
  double object_square{};                ///< edge of a square of the chessboard, or of the tag [m]
};

/// Edge of a sheet of paper [m]. The configuration does not tell it.
inline constexpr double kSheet = 0.3;

/// @param config  of a run, complete  @throws FaultError bad_configuration
[[nodiscard]] Scene read_scene(const Config& config);

/// @param E     position of the end effector in the arm's base [m]
/// @param belt  how far the belt on which the sheet lies has moved it along y [m]
/// @return whether a pen there leaves ink: on or in the sheet. Measured positions are 0.05 mm above it at least when
///         the pen is lifted and not above it at all when it writes; the sheet gives way by less than 5 mm
[[nodiscard]] bool on_paper(const ArmScene& arm, const Vector3& E, double belt = 0);

/// The scene as a page receives it.
struct SceneFrame {
  std::string source{};                 ///< "none", "live" or "run"
  std::string task{};                   ///< may be empty
  std::string session{};                ///< empty for a run folder
  std::string folder{};                 ///< the run's, may be empty
  std::vector<std::string> pictures{};  ///< files of the folder that can be asked for
  std::string note{};                   ///< what a person should know about it, may be empty
};

/// @return JSON: the fields of both under their names; poses are six numbers, `columns` names those of an arm's track,
///         `platform_columns` those of a platform's; without a platform there is no `room`
[[nodiscard]] std::string scene_json(const Scene& scene, const SceneFrame& frame);

}  // namespace mrroc::view
