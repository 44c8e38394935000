#include "sim/errors.hpp"

#include <array>

namespace mrroc::sim {
namespace {

constexpr const char* kOfLinks = "the robot's description, gravity()";  // in robots/NAME
constexpr const char* kToolWeight = "robots.ARM.tool.weight, unless given the described one";
constexpr const char* kToolPose = "robots.ARM.tool.pose, unless given the described one";
constexpr const char* kToolCentre = "robots.ARM.tool.mass_centre, unless given the described one";

Vector3 read_three(const Config& table, const std::array<const char*, 3>& keys, double most,
                   const Meaning& meaning) {
  Vector3 v;
  for (std::size_t k = 0; k < keys.size(); ++k)
    v[static_cast<Eigen::Index>(k)] = table.number(keys[k], 0, {-most, most}, meaning);
  return v;
}

/// @param mass, centre  what is believed of them
/// @return mass_scale and mass_centre_error in a table
LinkError read_mass(const Config& table, const std::string& whose, const char* mass = kOfLinks,
                    const char* centre = kOfLinks) {
  LinkError e;
  e.mass_scale = table.number("mass_scale", 1, {0.1, 10},
                              {"", "mass and inertia " + whose + " over the described ones", mass});
  e.mass_centre_error = read_shift(table.section("mass_centre_error"),
                                   "mass centre " + whose + " less the described one, in the link's frame",
                                   centre, {.shift = 0.2});
  return e;
}

LinkError read_tool_error(const Config& table) {
  LinkError e = read_mass(table, "of the tool", kToolWeight, kToolCentre);
  const Config tip = table.section("tip_error");
  e.tip_error = read_shift(tip, "tip of the tool less the described one, in W", kToolPose);
  e.tip_turn = read_turn(tip, "of the tool's tip about axes of W, from the described one", kToolPose);
  return e;
}

LinkError read_link_error(const Config& table) {
  LinkError e = read_mass(table, "of that link, besides those of every link");
  e.zero_error = table.number("zero_error", 0, {-0.1, 0.1},
                              {"rad, m", "joint of that link less what SYNCHRO makes of its encoder",
                               "robots.ARM.synchro_joints, or the places of the switches"});
  return e;
}

bool is_none(const LinkError& e) {
  return e.mass_scale == 1 && e.mass_centre_error.isZero(0) && e.zero_error == 0 && e.tip_error.isZero(0) &&
         e.tip_turn.isZero(0);
}

}  // namespace

Vector3 read_shift(const Config& table, const std::string& about, std::string_view believed,
                   const ErrorBounds& bounds) {
  return read_three(table, {"x", "y", "z"}, bounds.shift, {"m", about, believed});
}

Vector3 read_turn(const Config& table, const std::string& about, std::string_view believed,
                  const ErrorBounds& bounds) {
  return read_three(table, {"ax", "ay", "az"}, bounds.turn, {"rad", about, believed});
}

Pose read_displacement(const Config& table, const std::string& about, std::string_view believed,
                       const ErrorBounds& bounds) {
  const Vector3 shift = read_shift(table, about, believed, bounds);
  const Vector3 turn = read_turn(table, about, believed, bounds);
  Pose displacement;
  displacement.p = shift;
  if (!turn.isZero(0)) displacement.R = rotation_from_angle_axis(turn);
  return displacement;
}

bool is_none(const Pose& displacement) {
  return displacement.p.isZero(0) && displacement.R == Matrix3::Identity();
}

Pose displaced(const Pose& T, const Pose& displacement) {
  return is_none(displacement) ? T : T * displacement;
}

std::vector<LinkError> read_link_errors(const Config& arm, const std::vector<std::string>& links) {
  const LinkError all = read_mass(arm, "of every link");
  std::vector<LinkError> errors;
  for (const std::string& name : links) {
    const bool tool = name == links.back();
    const Config table = arm.section(tool ? "tool" : "links." + name);
    LinkError e = tool ? read_tool_error(table) : read_link_error(table);
    e.link = name;
    e.mass_scale *= all.mass_scale;
    e.mass_centre_error += all.mass_centre_error;
    if (!is_none(e)) errors.push_back(e);
  }
  return errors;
}

}  // namespace mrroc::sim
