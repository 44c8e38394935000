#include "base/link/child_main.hpp"
#include "robots/conveyor/conveyor.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Effector driver (EDP) of the conveyor.",
                                 mrroc::robots::driver_of({&mrroc::conveyor::type()}));
}
