// main() of the receptors' programs, each of which is a node of a running system and a tool for recorded pictures.
#pragma once
#include <string>

#include "base/link/child_main.hpp"

namespace mrroc::vsp {

/// @param help      what it is, and its options for recorded pictures
/// @param recorded  is called when --source is given, with the same arguments; its errors are told
/// @return exit status
int receptor_program(int argc, char** argv, const std::string& help, const link::NodeMain& body,
                     const std::function<int(int argc, char** argv)>& recorded);

}  // namespace mrroc::vsp
