#include "base/link/child_main.hpp"
#include "robots/rex/platform_type.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return link::child_main(argc, argv, "Effector driver of the platform Rex.",
                          robots::platform_driver_of({&rex::type()}));
}
