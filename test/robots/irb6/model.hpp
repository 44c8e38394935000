// The URDF files as KDL sees them.
#pragma once
#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <kdl/chain.hpp>
#include <string>

#include "base/axes.hpp"
#include "base/pose.hpp"

namespace mrroc::irb6::test {

/// @return robots/irb6/<name>.urdf, parsed; null if that fails
urdf::ModelInterfaceSharedPtr read_model(const std::string& name);

/// @param tip link at its end @return the chain from "base" to it
KDL::Chain chain_to(const urdf::ModelInterface& model, const std::string& tip);

/// @return direct kinematics of a chain
Pose forward(const KDL::Chain& chain, const AxisVector& joints);

/// @return the frame as KDL has it
KDL::Frame to_kdl(const Pose& T);

}  // namespace mrroc::irb6::test
