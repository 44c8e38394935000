#include "vsp/cube_face/receptor.hpp"

int main(int argc, char** argv) { return mrroc::vsp::cube_face_main(argc, argv); }
