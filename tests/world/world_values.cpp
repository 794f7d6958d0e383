// Prints values of curves and springs that world_values.py asks for, one line for each line of standard input:
//     curve INTERPOLATION PATH KEYS TIME... VALUE... SECONDS      numbers as in behaviour.h, four for each value
//     spring STIFFNESS DAMPING X V SECONDS

#include "app/world/curve.h"
#include "app/world/spring.h"

#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

namespace {

using namespace frustumscreen;

void print_curve(std::istream& in) {
    int interpolation = 0;
    int path = 0;
    std::size_t keys = 0;
    in >> interpolation >> path >> keys;
    world::Curve curve{.interpolation = static_cast<world::Interpolation>(interpolation),
                       .times_s = std::vector<float>(keys),
                       .values = {}};
    for (float& time : curve.times_s) {
        in >> time;
    }
    const bool spline = curve.interpolation == world::Interpolation::CubicSpline;
    curve.values.resize((spline ? 3 : 1) * keys);
    for (glm::vec4& value : curve.values) {
        in >> value.x >> value.y >> value.z >> value.w;
    }
    double seconds = 0.0;
    in >> seconds;
    const glm::dvec4 value = world::value_at(curve, static_cast<world::Path>(path), seconds);
    std::printf("%.17g %.17g %.17g %.17g\n", value.x, value.y, value.z, value.w);
}

void print_spring(std::istream& in) {
    world::SpringLaw law;
    world::Motion motion;
    double seconds = 0.0;
    in >> law.stiffness_per_s2 >> law.damping_per_s >> motion.x >> motion.v >> seconds;
    motion = world::motion_after(law, motion, seconds);
    std::printf("%.17g %.17g\n", motion.x, motion.v);
}

} // namespace

int main() {
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream in(line);
        std::string what;
        in >> what;
        what == "curve" ? print_curve(in) : print_spring(in);
    }
    return 0;
}
