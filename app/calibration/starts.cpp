#include "app/calibration/starts.h"

#include "app/calibration/fit.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace frustumscreen::calibration {

namespace {

/// Rows (x, 1) about the touches' middle.
Eigen::MatrixX4d places(std::span<const Touch> touches) {
    const Eigen::Vector3d middle = eigen(middle_of(touches));
    Eigen::MatrixX4d rows(static_cast<Eigen::Index>(touches.size()), 4);
    for (std::size_t k = 0; k < touches.size(); ++k) {
        rows.row(static_cast<Eigen::Index>(k))
            << (eigen(touches[k].tracker_from_sensor.translation) - middle).transpose(),
            1.0;
    }
    return rows;
}

template <typename Value> Eigen::Vector4d affine(std::span<const Touch> touches, Value value) {
    const Eigen::MatrixX4d rows = places(touches);
    Eigen::VectorXd goal(rows.rows());
    for (std::size_t k = 0; k < touches.size(); ++k) {
        goal[static_cast<Eigen::Index>(k)] = value(touches[k]);
    }
    Eigen::Vector4d found = rows.completeOrthogonalDecomposition().solve(goal);
    found[3] -= found.head<3>().dot(eigen(middle_of(touches)));
    return found;
}

/// Below this slope, heights do not depend on places.
constexpr double min_slope = 0.05;

/// The table in a start: the up direction, and the plane's offset.
struct TableStart {
    glm::dvec3 up;
    double offset_m;
};

TableStart table_start(std::span<const Touch> touches) {
    const HeightFit heights = fit_heights(touches);
    const double length = glm::length(heights.up);
    if (length > min_slope) {
        return TableStart{heights.up / length, heights.offset_m};
    }
    // All touches are at one height: the places lie in a plane, and up is the side from which the picture is
    // not mirrored.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(places(touches).leftCols<3>(), Eigen::ComputeFullV);
    const PixelFit pixels = fit_pixels(touches);
    glm::dvec3 up = glm_vector(svd.matrixV().col(2));
    up *= glm::dot(glm::cross(pixels.across_u, pixels.across_v), up) > 0.0 ? -1.0 : 1.0;
    return TableStart{up, touches[0].block_m - glm::dot(up, middle_of(touches))};
}

TouchModel straight_down(const TableStart& table, const PixelFit& pixels, const glm::dvec3& middle, int width,
                         int height, double focal) {
    const glm::dvec3 along_u =
        glm::normalize(pixels.across_u - glm::dot(pixels.across_u, table.up) * table.up);
    const glm::dvec3 down = -table.up;
    const glm::dmat3 tracker_from_j(along_u, glm::cross(down, along_u), down);
    const double scale =
        0.5 * (glm::dot(pixels.across_u, along_u) + std::abs(glm::dot(pixels.across_v, tracker_from_j[1])));
    const glm::dvec2 pixel(glm::dot(pixels.across_u, middle) + pixels.at_origin.x,
                           glm::dot(pixels.across_v, middle) + pixels.at_origin.y);
    const glm::dvec3 in_j((pixel.x - 0.5 * width) / scale, (pixel.y - 0.5 * height) / scale, focal / scale);
    TouchModel model;
    model.pinhole = {
        .width = width, .height = height, .fx = focal, .fy = focal, .cx = 0.5 * width, .cy = 0.5 * height};
    model.projector_from_tracker.rotation = glm::conjugate(glm::quat_cast(tracker_from_j));
    model.projector_from_tracker.translation = in_j - model.projector_from_tracker.rotation * middle;
    model.table_up = table.up;
    model.table_offset_m = table.offset_m;
    return model;
}

/// The camera matrix of scaled points and pixels: the equations' least singular vector.
Eigen::Matrix<double, 3, 4> camera_matrix(std::span<const Touch> touches, int width) {
    const Eigen::MatrixX4d rows = places(touches);
    const double reach = rows.leftCols<3>().rowwise().norm().mean();
    Eigen::Matrix<double, Eigen::Dynamic, 12> equations(2 * rows.rows(), 12);
    equations.setZero();
    Eigen::Matrix4d scaled_from_point = Eigen::Matrix4d::Identity();
    scaled_from_point.topRows<3>() /= reach;
    scaled_from_point.block<3, 1>(0, 3) = -eigen(middle_of(touches)) / reach;
    for (Eigen::Index k = 0; k < rows.rows(); ++k) {
        const glm::dvec2 pixel = touches[static_cast<std::size_t>(k)].pixel / static_cast<double>(width);
        Eigen::RowVector4d x = rows.row(k);
        x.head<3>() /= reach;
        equations.block<1, 4>(2 * k, 0) = x;
        equations.block<1, 4>(2 * k, 8) = -(pixel.x - 0.5) * x;
        equations.block<1, 4>(2 * k + 1, 4) = x;
        equations.block<1, 4>(2 * k + 1, 8) = -(pixel.y - 0.5) * x;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(equations, Eigen::ComputeFullV);
    const Eigen::VectorXd least = svd.matrixV().col(11);
    Eigen::Matrix<double, 3, 4> p;
    p << least.segment<4>(0).transpose(), least.segment<4>(4).transpose(), least.segment<4>(8).transpose();
    Eigen::Matrix3d pixel_from_scaled;
    pixel_from_scaled << width, 0.0, 0.5 * width, 0.0, width, 0.5 * width, 0.0, 0.0, 1.0;
    return pixel_from_scaled * p * scaled_from_point;
}

/// Projector and pose of a camera matrix; nothing if no projector above a table has that matrix.
std::optional<TouchModel> decomposed(Eigen::Matrix<double, 3, 4> p, const TableStart& table,
                                     const glm::dvec3& middle, int width, int height) {
    Eigen::Vector4d at_middle;
    at_middle << eigen(middle), 1.0;
    if (p.row(2).dot(at_middle) < 0.0) {
        p = -p;
    }
    const Eigen::Matrix3d m = p.leftCols<3>();
    if (!(m.determinant() > 0.0)) {
        return std::nullopt;
    }
    // m = intrinsics * rotation, by a reversed Cholesky factorisation: m mT = k kT with upper triangular k.
    const Eigen::Matrix3d square = m * m.transpose() / m.row(2).squaredNorm();
    const double cx = square(0, 2);
    const double cy = square(1, 2);
    const double fy = std::sqrt(square(1, 1) - cy * cy);
    const double skew = (square(0, 1) - cx * cy) / fy;
    const double fx = std::sqrt(square(0, 0) - cx * cx - skew * skew);
    const double w = width;
    if (!(fx > 0.2 * w && fx < 20.0 * w && fy > 0.2 * w && fy < 20.0 * w && std::abs(cx - 0.5 * w) < w &&
          std::abs(cy - 0.5 * height) < w)) {
        return std::nullopt;
    }
    Eigen::Matrix3d k;
    k << fx, skew, cx, 0.0, fy, cy, 0.0, 0.0, 1.0;
    const Eigen::Matrix<double, 3, 4> pose = k.inverse() * p / m.row(2).norm();
    const Eigen::Quaterniond q(Eigen::Matrix3d(pose.leftCols<3>()));
    TouchModel model;
    model.pinhole = {.width = width, .height = height, .fx = fx, .fy = fy, .cx = cx, .cy = cy};
    model.projector_from_tracker = {glm::normalize(glm::dquat(q.w(), q.x(), q.y(), q.z())),
                                    glm_vector(pose.col(3))};
    model.table_up = table.up;
    model.table_offset_m = table.offset_m;
    return model;
}

} // namespace

HeightFit fit_heights(std::span<const Touch> touches) {
    const Eigen::Vector4d found = affine(touches, [](const Touch& touch) { return touch.block_m; });
    return {glm_vector(found.head<3>()), found[3]};
}

PixelFit fit_pixels(std::span<const Touch> touches) {
    const Eigen::Vector4d u = affine(touches, [](const Touch& touch) { return touch.pixel.x; });
    const Eigen::Vector4d v = affine(touches, [](const Touch& touch) { return touch.pixel.y; });
    return {glm_vector(u.head<3>()), glm_vector(v.head<3>()), {u[3], v[3]}};
}

TouchModel start_with(std::span<const Touch> touches, int width, int height, double focal_px) {
    return straight_down(table_start(touches), fit_pixels(touches), middle_of(touches), width, height,
                         focal_px);
}

std::vector<TouchModel> starting_models(std::span<const Touch> touches, int width, int height) {
    const TableStart table = table_start(touches);
    std::vector<TouchModel> models;
    if (auto model = decomposed(camera_matrix(touches, width), table, middle_of(touches), width, height)) {
        models.push_back(*model);
    }
    const PixelFit pixels = fit_pixels(touches);
    for (const double throw_ratio : {0.6, 1.2, 2.4}) {
        models.push_back(
            straight_down(table, pixels, middle_of(touches), width, height, throw_ratio * width));
    }
    return models;
}

} // namespace frustumscreen::calibration
