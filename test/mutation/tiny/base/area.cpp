#include "base/area.hpp"

int area(int width, int height) {
  const int unused = 7;
  static_cast<void>(unused);
  return width * height;
}

int clipped(int x, int most) {
  if (x > most) return most;
  return x;
}

int sum_to(int n) {
  int sum = 0;
  for (int k = 1; k <= n; ++k) sum += k;
  return sum;
}

int side() { return kSide; }

int depth() { return kDepth; }
