#include "app/calibration/rest_model.h"

#include <Eigen/Geometry>

namespace frustumscreen::calibration {

RestModel changed(const RestModel& base, const glm::dvec3& middle, const RestChanges& change) {
    const ChangedRestModel<double> now(base, middle, change.data());
    const Eigen::Quaterniond q(now.turn);
    return {changed(base.touch, middle, Changes(change.head<unknown_count>())),
            glm::normalize(glm::dquat(q.w(), q.x(), q.y(), q.z())), now.print};
}

} // namespace frustumscreen::calibration
