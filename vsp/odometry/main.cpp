#include "vsp/odometry/receptor.hpp"

int main(int argc, char** argv) { return mrroc::vsp::odometry_main(argc, argv); }
