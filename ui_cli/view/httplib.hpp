// The HTTP library without the name _res, which <resolv.h> takes from all that comes after it: Eigen has parameters of
// that name.
#pragma once
#include <httplib.h>
#undef _res
