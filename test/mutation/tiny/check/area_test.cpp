#include "base/area.hpp"

static_assert(kDepth == 2);

int main() {
  const bool good = area(2, 3) == 6 && clipped(5, 4) == 4 && clipped(3, 4) == 3 && clipped(4, 4) == 4 &&
                    sum_to(4) == 10 && half(9) == 4;
  return good ? 0 : 1;
}
