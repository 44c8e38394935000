#include "sim/mujoco/model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>

#include "sim/belt.hpp"
#include "sim/mujoco/convert.hpp"
#include "sim/mujoco/soft_contact.hpp"

namespace mrroc::sim {
namespace {

constexpr double kTableThickness = 0.05;  // [m]
/// Friction stops a slip as a time constant of 1/kSlipRate does, as long as the cone lets it.
constexpr double kSlipRate = 100;  // [1/s]
/// By how much a contact resists less along its surface than along its normal: what sticks creeps by 7e-6 m/s at 0.2 N.
constexpr double kGrip = 1e4;
/// Iterations, at the most, in which what still slips though friction can hold it is stopped: closed brakes do not creep.
constexpr int kNoSlip = 100;
constexpr double kTolerance = 1e-10;   // of MuJoCo's iterations, relative
constexpr double kHoldsFast = 0.9999;  // the largest impedance that MuJoCo takes

/// Whatever pens may touch.
struct Surface {
  std::string name;
  double friction{1};
};

std::string part(std::size_t arm, const char* what) { return "arm" + std::to_string(arm) + "." + what; }
std::string part(std::size_t arm, const char* what, std::size_t k) {
  return part(arm, what) + std::to_string(k);
}

class CellBuilder {
 public:
  CellBuilder(const WorldParameters& p, const std::vector<ArmPlan>& plans)
      : p_(p), plans_(plans), spec_(mj_makeSpec()), world_(mjs_findBody(spec_.get(), "world")) {}

  CellModel build() {
    set_options();
    const bool on_belt =
        std::ranges::any_of(p_.arms, [](const auto& arm) { return arm.type->belt.has_value(); });
    for (std::size_t k = 0; k < p_.arms.size(); ++k) {
      const ArmParameters& arm = p_.arms[k];
      const Pose T_UP = arm.T_UB * arm.paper.T_0P;
      if (!on_belt) add_table(k, T_UP);
      add_plate(k, T_UP, arm.plate);
      add_arm(k);
    }
    if (p_.artefact) add_artefact(*p_.artefact);
    for (std::size_t k = 0; k < p_.arms.size(); ++k)
      if (has_pen(k)) add_pairs(k);
    return compile();
  }

 private:
  void set_options() {
    mjOption& o = spec_->option;
    o.timestep = kStep / p_.substeps;
    set(o.gravity, Vector3(0, 0, -kGravity));
    o.integrator = mjINT_EULER;
    o.cone = mjCONE_ELLIPTIC;
    o.jacobian = mjJAC_DENSE;
    o.solver = mjSOL_NEWTON;
    o.iterations = p_.solver_iterations;
    o.noslip_iterations = kNoSlip;
    o.tolerance = o.ls_tolerance = kTolerance;
    o.noslip_tolerance = 0;
    o.ccd_tolerance = kTolerance;
    o.impratio = kGrip;
    o.disableflags |= mjDSBL_AUTORESET;
    spec_->compiler.usethread = 0;
    spec_->compiler.inertiafromgeom = mjINERTIAFROMGEOM_FALSE;
  }

  [[nodiscard]] bool has_pen(std::size_t k) const { return !p_.arms[k].type->belt; }

  mjsGeom* add_shape(mjsBody* body, const std::string& name, mjtGeom type, const Vector3& size,
                     const Pose& T) {
    mjsGeom* const geom = mjs_addGeom(body, nullptr);
    mjs_setName(geom->element, name.c_str());
    geom->type = type;
    set(geom->size, size);
    set(geom->pos, geom->quat, T);
    geom->contype = geom->conaffinity = 0;  // only pairs touch
    return geom;
  }

  void add_table(std::size_t arm, const Pose& T_UP) {
    const std::string name = part(arm, "table");
    add_shape(world_, name, mjGEOM_BOX, Vector3(kTableEdge, kTableEdge, kTableThickness) / 2,
              T_UP * Pose{Matrix3::Identity(), {0, 0, -kTableThickness / 2}});
    surfaces_.push_back(name);
  }

  void add_plate(std::size_t arm, const Pose& T_UP, const PlateParameters& plate) {
    if (plate.shape == PlateShape::none) return;
    const std::string name = part(arm, "plate");
    const Pose T_U = T_UP * Pose{Matrix3::Identity(), {0, plate.distance, plate.thickness / 2}};
    const Vector3 half = Vector3(plate.length, plate.width, plate.thickness) / 2;
    if (plate.shape == PlateShape::rectangle) {
      add_shape(world_, name, mjGEOM_BOX, half, T_U);
    } else {
      add_outline(name, plate);
      mjs_setString(add_shape(world_, name, mjGEOM_MESH, half, T_U)->meshname, name.c_str());
    }
    surfaces_.push_back(name);
  }

  void add_artefact(const ArtefactParameters& artefact) {
    for (std::size_t k = 0; k < artefact.balls.size(); ++k) {
      const std::string name = "artefact" + std::to_string(k);
      add_shape(world_, name, mjGEOM_SPHERE, Vector3(artefact.diameter / 2, 0, 0),
                {Matrix3::Identity(), artefact.balls[k]});
      surfaces_.push_back(name);
    }
  }

  /// An ellipse as a polygon whose sides are off by 2 micrometres.
  void add_outline(const std::string& name, const PlateParameters& p) {
    constexpr int kCorners = 360;
    std::vector<float> corners;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * std::numbers::pi * k / kCorners;
      for (const double z : {-p.thickness / 2, p.thickness / 2})
        for (const double x : {p.length / 2 * std::cos(angle), p.width / 2 * std::sin(angle), z})
          corners.push_back(static_cast<float>(x));
    }
    mjsMesh* const mesh = mjs_addMesh(spec_.get(), nullptr);
    mjs_setName(mesh->element, name.c_str());
    mjs_setFloat(mesh->uservert, corners.data(), static_cast<int>(corners.size()));
  }

  void add_arm(std::size_t arm) {
    const Chain& chain = plans_[arm].chain;
    std::vector<mjsBody*> bodies;
    for (std::size_t k = 0; k < chain.links.size(); ++k) {
      const ChainLink& link = chain.links[k];
      const std::size_t back = static_cast<std::size_t>(link.back);
      mjsBody* const body = mjs_addBody(k < back ? world_ : bodies[k - back], nullptr);
      mjs_setName(body->element, part(arm, "link", k).c_str());
      set(body->pos, body->quat, k < back ? p_.arms[arm].T_UB * link.T_PL : link.T_PL);
      // The inertia is set when all is compiled: rotors turn faster than their links, so that a link may have more of it
      // about one axis than any body at rest.
      body->mass = link.mass;
      set(body->ipos, link.mass_centre);
      set(body->inertia, Vector3::Constant(link.inertia.maxCoeff()));
      body->explicitinertial = 1;
      if (!link.fixed) add_joint(body, part(arm, "joint", k), link);
      bodies.push_back(body);
    }
    add_tool(arm, bodies[static_cast<std::size_t>(chain.tool)]);
    add_brakes(arm);
  }

  static void add_joint(mjsBody* body, const std::string& name, const ChainLink& link) {
    mjsJoint* const joint = mjs_addJoint(body, nullptr);
    mjs_setName(joint->element, name.c_str());
    joint->type = link.prismatic ? mjJNT_SLIDE : mjJNT_HINGE;
    set(joint->axis, link.axis);
  }

  /// The tip, or a conveyor's belt, and the sensor.
  void add_tool(std::size_t arm, mjsBody* body) {
    const Chain& chain = plans_[arm].chain;
    const ArmParameters& p = p_.arms[arm];
    const Pose T_TG{Matrix3::Identity(), chain.links[static_cast<std::size_t>(chain.tool)].mass_centre};
    if (p.type->belt) {
      const std::string name = part(arm, "belt");
      add_shape(body, name, mjGEOM_BOX, belt_size(*p.type->belt) / 2,
                T_TG * chain.T_GE * belt_in_effector(*p.type, *plans_[arm].robot));
      surfaces_.push_back(name);
    } else {
      // The lowest point of the ball is the tip of the tool.
      const Pose T_E_ball{Matrix3::Identity(), {0, 0, -p.pen_radius}};
      add_shape(body, part(arm, "pen"), mjGEOM_SPHERE, Vector3(p.pen_radius, 0, 0),
                T_TG * chain.T_GE * T_E_ball);
    }
    mjsSite* const site = mjs_addSite(body, nullptr);
    const std::string name = part(arm, "sensor");
    mjs_setName(site->element, name.c_str());
    set(site->pos, site->quat, T_TG * chain.T_GS);
    for (const auto& [type, what] : {std::pair{mjSENS_FORCE, "force"}, std::pair{mjSENS_TORQUE, "torque"}}) {
      mjsSensor* const sensor = mjs_addSensor(spec_.get());
      mjs_setName(sensor->element, part(arm, what).c_str());
      sensor->type = type;
      sensor->objtype = mjOBJ_SITE;
      mjs_setString(sensor->objname, name.c_str());
    }
  }

  /// A brake is dry friction on the shaft of a motor, which is a tendon over all joints that turn it.
  void add_brakes(std::size_t arm) {
    const ArmPlan& plan = plans_[arm];
    const AxisMatrix motors_per_joints = plan.robot->motors_per_joints(plan.start);
    for (int motor = 0; motor < plan.chain.joints; ++motor) {
      mjsTendon* const shaft = mjs_addTendon(spec_.get(), nullptr);
      mjs_setName(shaft->element, part(arm, "motor", static_cast<std::size_t>(motor)).c_str());
      for (int joint = 0; joint < plan.chain.joints; ++joint)
        mjs_wrapJoint(shaft, part(arm, "joint", static_cast<std::size_t>(joint)).c_str(),
                      motors_per_joints(motor, joint));
      // What slips is to stand after one integration.
      shaft->solref_friction[0] = -1;
      shaft->solref_friction[1] = -kHoldsFast / spec_->option.timestep;
      shaft->solimp_friction[0] = shaft->solimp_friction[1] = kHoldsFast;
    }
  }

  void add_pairs(std::size_t arm) {
    for (const std::string& surface : surfaces_) {
      mjsPair* const pair = mjs_addPair(spec_.get(), nullptr);
      mjs_setName(pair->element, (part(arm, "on ") + surface).c_str());
      mjs_setString(pair->geomname1, part(arm, "pen").c_str());
      mjs_setString(pair->geomname2, surface.c_str());
      pair->condim = 3;
      pair->friction[0] = pair->friction[1] = p_.arms[arm].paper.friction;
    }
  }

  CellModel compile() {
    CellModel cell;
    cell.model.reset(mj_compile(spec_.get(), nullptr));
    if (!cell.model) throw std::invalid_argument(std::string("world: MuJoCo: ") + mjs_getError(spec_.get()));
    cell.data.reset(mj_makeData(cell.model.get()));
    mjModel& m = *cell.model;
    for (std::size_t k = 0; k < p_.arms.size(); ++k) {
      cell.arms.push_back(find(m, k));
      set_inertia(m, cell.arms.back(), plans_[k].chain);
    }
    mj_setConst(&m, cell.data.get());
    mj_resetData(&m, cell.data.get());
    for (std::size_t k = 0; k < p_.arms.size(); ++k) {
      if (has_pen(k)) soften(m, k);
      std::ranges::copy(plans_[k].start, cell.data->qpos + cell.arms[k].joint);
    }
    return cell;
  }

  static void set_inertia(mjModel& m, const ArmInModel& arm, const Chain& chain) {
    for (std::size_t k = 0; k < chain.links.size(); ++k)
      std::ranges::copy(chain.links[k].inertia, m.body_inertia + 3 * arm.links[k]);
  }

  static int id(const mjModel& m, mjtObj type, const std::string& name) {
    return mj_name2id(&m, type, name.c_str());
  }

  [[nodiscard]] ArmInModel find(const mjModel& m, std::size_t arm) const {
    const Chain& chain = plans_[arm].chain;
    ArmInModel a;
    for (std::size_t k = 0; k < chain.links.size(); ++k)
      a.links.push_back(id(m, mjOBJ_BODY, part(arm, "link", k)));
    a.joint = m.jnt_dofadr[id(m, mjOBJ_JOINT, part(arm, "joint", 0))];
    a.joints = chain.joints;
    a.tool = a.links[static_cast<std::size_t>(chain.tool)];
    if (has_pen(arm)) a.pen = id(m, mjOBJ_GEOM, part(arm, "pen"));
    a.brake = id(m, mjOBJ_TENDON, part(arm, "motor", 0));
    a.force = m.sensor_adr[id(m, mjOBJ_SENSOR, part(arm, "force"))];
    a.T_GS = chain.T_GS;
    a.T_GE = chain.T_GE;
    return a;
  }

  /// The contacts of a pen get the stiffness of its paper, which depends on masses that MuJoCo has just computed.
  void soften(mjModel& m, std::size_t arm) const {
    const PaperParameters& paper = p_.arms[arm].paper;
    for (const std::string& surface : surfaces_) {
      const int pair = id(m, mjOBJ_PAIR, part(arm, "on ") + surface);
      double inverse_mass = 0;
      for (const int geom : {m.pair_geom1[pair], m.pair_geom2[pair]})
        inverse_mass += m.body_invweight0[2 * m.geom_bodyid[geom]];
      const SoftContact c = soft_contact(paper.stiffness, paper.damping_ratio, m.opt.timestep, inverse_mass);
      mjtNum* const impedance = m.pair_solimp + mjNIMP * pair;
      impedance[0] = impedance[1] = c.impedance;
      mjtNum* const normal = m.pair_solref + mjNREF * pair;
      normal[0] = -c.stiffness;
      normal[1] = -c.damping;
      mjtNum* const along = m.pair_solreffriction + mjNREF * pair;
      along[0] = 0;
      along[1] = -c.impedance * kSlipRate;
    }
  }

  const WorldParameters& p_;
  const std::vector<ArmPlan>& plans_;
  MujocoPtr<mjSpec> spec_;
  mjsBody* world_;
  std::vector<std::string> surfaces_;  // names of what pens may touch
};

}  // namespace

CellModel cell_model(const WorldParameters& parameters, const std::vector<ArmPlan>& plans) {
  const auto refuse = [](const char* what) {
    throw std::invalid_argument(std::string("world: the engine MuJoCo has no ") + what);
  };
  if (parameters.cube) refuse("cube");
  if (parameters.free_body) refuse("free body");
  for (const ArmParameters& arm : parameters.arms) {
    if (arm.gripper) refuse("fingers that touch a cube");
    if (arm.palm) refuse("palms");
  }
  return CellBuilder(parameters, plans).build();
}

}  // namespace mrroc::sim
