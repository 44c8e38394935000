#include "vsp/image_receptor.hpp"

int main(int argc, char** argv) {
  return mrroc::vsp::receptor_main(argc, argv, mrroc::vsp::chessboard_receptor());
}
