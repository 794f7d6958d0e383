#include "app/geometry/time_curves.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::geometry {

double follow_share(double dt_s, double time_constant_s) {
    if (!(dt_s > 0.0)) {
        return 0.0;
    }
    return time_constant_s > 0.0 ? -std::expm1(-dt_s / time_constant_s) : 1.0;
}

double ramp(double elapsed_s, double length_s) {
    if (!(elapsed_s > 0.0)) {
        return 0.0;
    }
    return elapsed_s < length_s ? elapsed_s / length_s : 1.0;
}

double ease(double x) {
    x = std::clamp(x, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

} // namespace frustumscreen::geometry
