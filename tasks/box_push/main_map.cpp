#include "tasks/box_push/config.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv,
                                 "Map agent: says where a platform is, from a motion capture system.",
                                 mrroc::box_push::run_map);
}
