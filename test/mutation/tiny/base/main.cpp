#include "base/area.hpp"

static_assert(kSide == 4);

int main() { return side() - kSide; }
