// Areas, for the test of the mutation tool.
#pragma once

/// @return half of it
inline int half(int x) { return x / 2; }

int area(int width, int height);
int clipped(int x, int most);
int sum_to(int n);

inline constexpr int kSide = 4;  // of what no test looks at
int side();

inline constexpr int kDepth = 2;
int depth();
