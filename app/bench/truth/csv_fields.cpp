#include "app/bench/truth/csv_fields.h"

#include <fmt/format.h>

namespace frustumscreen::bench {

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + "\"";
}

std::string pose_fields(const BenchPose& pose) {
    const geometry::RigidTransform& prop = pose.table_from_prop;
    return fmt::format("{:.6f},{:.6f},{:.9f},{:.9f},{:.6f},{:.6f},{:.6f}", prop.translation.x,
                       prop.translation.y, prop.rotation.w, prop.rotation.z, pose.eye_m.x, pose.eye_m.y,
                       pose.eye_m.z);
}

} // namespace frustumscreen::bench
