#include "app/calibration/rest_starts.h"

#include "app/calibration/starts.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace frustumscreen::calibration {

namespace {

/// The prop's rotation in K by a model: its X axis follows the light along the level, its Z axis is the
/// table's normal.
std::optional<Eigen::Matrix3d> prop_in_tracker(const TouchModel& model, const PlaneView& view,
                                               double block_m) {
    constexpr double reach_m = 0.03;
    const auto from = model.lit(view.pixel({-reach_m, 0.0}), block_m + view.level_m);
    const auto to = model.lit(view.pixel({reach_m, 0.0}), block_m + view.level_m);
    if (!from || !to) {
        return std::nullopt;
    }
    const Eigen::Vector3d up = eigen(model.table_up);
    const Eigen::Vector3d along = eigen(*to - *from);
    Eigen::Matrix3d turn;
    turn.col(2) = up;
    turn.col(0) = (along - along.dot(up) * up).normalized();
    turn.col(1) = up.cross(turn.col(0));
    return turn;
}

/// The rotation nearest to the sum of each rest's estimate.
glm::dquat mean_turn(const TouchModel& model, std::span<const Rest> rests,
                     std::span<const std::optional<PlaneView>> views) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < rests.size(); ++k) {
        if (views[k] && rests[k].block_m) {
            if (const auto turn = prop_in_tracker(model, *views[k], *rests[k].block_m)) {
                sum += eigen(rests[k].tracker_from_sensor.rotation).transpose() * *turn;
            }
        }
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1.0, 1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant());
    const Eigen::Quaterniond q(
        Eigen::Matrix3d(svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose()));
    return {q.w(), q.x(), q.y(), q.z()};
}

} // namespace

Touches as_touches(std::span<const Rest> rests, std::span<const std::optional<PlaneView>> views) {
    Touches touches;
    for (std::size_t k = 0; k < rests.size(); ++k) {
        if (views[k] && rests[k].block_m) {
            touches.push_back({rests[k].tracker_from_sensor, views[k]->pixel({0.0, 0.0}),
                               *rests[k].block_m + views[k]->level_m});
        }
    }
    return touches;
}

std::vector<RestModel> starting_rest_models(std::span<const Rest> rests,
                                            std::span<const std::optional<PlaneView>> views, int width,
                                            int height) {
    std::vector<RestModel> models;
    for (const TouchModel& model : starting_models(as_touches(rests, views), width, height)) {
        models.push_back({model, mean_turn(model, rests, views), 1.0});
    }
    return models;
}

} // namespace frustumscreen::calibration
