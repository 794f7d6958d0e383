#include "tests/simulators/table/bent_field.h"

#include "app/calibration/unknowns.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cmath>

namespace frustumscreen::simulators {

namespace {

/// The field at `at` of dipoles along the three axes at the origin, one per column.
Eigen::Matrix3d dipole(const Eigen::Vector3d& at) {
    const Eigen::Vector3d n = at.normalized();
    return (3.0 * n * n.transpose() - Eigen::Matrix3d::Identity()) / std::pow(at.norm(), 3.0);
}

} // namespace

geometry::RigidTransform Metal::reported(const geometry::RigidTransform& tracker_from_sensor) const {
    const Eigen::Vector3d at = calibration::eigen(tracker_from_sensor.translation);
    const Eigen::Vector3d metal = calibration::eigen(in_tracker_m);
    const Eigen::Matrix3d sum = dipole(at) + strength_m3 * dipole(at - metal) * dipole(metal);
    const Eigen::Matrix3d measured = calibration::eigen(tracker_from_sensor.rotation).transpose() * sum;
    // For the source's field alone, the square has the eigenvalues 4, 1, 1 divided by the sixth power of the
    // distance; the first eigenvector points along the position.
    const Eigen::Matrix3d square = measured.transpose() * measured;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(square);
    Eigen::Vector3d place = parts.eigenvectors().col(2) * std::pow(6.0 / square.trace(), 1.0 / 6.0);
    place = place.dot(at) < 0.0 ? Eigen::Vector3d(-place) : place; // the hemisphere is known
    const Eigen::JacobiSVD<Eigen::Matrix3d> turn(measured * dipole(place).inverse(),
                                                 Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d tracker_from = turn.matrixV() * turn.matrixU().transpose();
    const Eigen::Quaterniond q(tracker_from);
    return {glm::normalize(glm::dquat(q.w(), q.x(), q.y(), q.z())), calibration::glm_vector(place)};
}

BentTable bent_table(std::uint64_t seed, double bend_m) {
    SeededNumbers numbers(50000 + seed);
    BentTable bent;
    bent.table = some_table(seed);
    geometry::RigidTransform& table_from_tracker = bent.table.truth.table_from_tracker;
    const double side = numbers.between(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    table_from_tracker.translation = {numbers.between(-0.3, 0.3), side * numbers.between(0.6, 0.8),
                                      numbers.between(-0.1, 0.3)};
    const glm::dvec3 metal(numbers.between(-0.6, 0.6), numbers.between(-0.4, 0.4),
                           numbers.between(-1.0, -0.5));
    bent.metal.in_tracker_m = table_from_tracker.inverse().point(metal);
    const auto largest_bend = [&] {
        double largest = 0.0;
        for (const double height : {0.0, 0.12}) {
            for (int k = 0; k < 35; ++k) {
                const glm::dvec2 pixel(bent.table.truth.pinhole.width * (k % 7) / 6.0,
                                       bent.table.truth.pinhole.height * (k / 7) / 4.0);
                geometry::RigidTransform pose;
                pose.translation =
                    table_from_tracker.inverse().point(true_light(bent.table.truth, pixel, height));
                largest = std::fmax(largest,
                                    glm::distance(pose.translation, bent.metal.reported(pose).translation));
            }
        }
        return largest;
    };
    bent.metal.strength_m3 = -1e-4;
    for (int k = 0; k < 6; ++k) { // the bend is nearly proportional to the strength
        bent.metal.strength_m3 *= bend_m / largest_bend();
    }
    return bent;
}

} // namespace frustumscreen::simulators
