// The process of a platform's visual odometry.
#pragma once
#include "base/link/child_main.hpp"

namespace mrroc::vsp {

/// Body of the process "vsp-odometry-KEY" with KEY of [odometry.KEY]: for every pair of pictures one reading on "KEY.odometry", also
/// when no motion was found, until the cameras' last pair or the end of the system. Pictures are announced on "LEFT.frame"
/// and "RIGHT.frame" and lie in the cameras' frame stores. With `film.directory` in the configuration it leaves KEY_odometry.png there.
/// @throws FaultError bad_usage: its name; bad_configuration, malformed_message as read_stereo() and run_cameras()
void run_odometry(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// main() of the receptor's program: with --source on recorded pairs, else as a node of a running system.
/// @return exit status
int odometry_main(int argc, char** argv);

}  // namespace mrroc::vsp
