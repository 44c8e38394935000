// The HTTP library without the name _res, which <resolv.h> defines as a macro: Eigen has parameters of that
// name.
#pragma once
#include <httplib.h>
#undef _res
