#include "app/calibration/corners.h"

#include "app/calibration/calibrated_table.h"
#include "app/calibration/dense_solvers.h"
#include "app/calibration/unknowns.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustumscreen::calibration {

namespace {

using Place = Eigen::Vector3d;

/// The places of each corner at all distances.
using Lines = std::array<std::vector<Place>, 4>;

struct Line {
    Place middle;
    Place along; ///< unit
};

/// The least-squares line through places.
Line line_through(std::span<const Place> places) {
    Place middle = Place::Zero();
    for (const Place& place : places) {
        middle += place / static_cast<double>(places.size());
    }
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (const Place& place : places) {
        square += (place - middle) * (place - middle).transpose();
    }
    return {middle, axes_of(square).vectors.col(2)};
}

/// The least-squares intersection of lines, and its condition.
struct Meeting {
    Place place;
    double condition;
};
Meeting meeting_of(std::span<const Line> lines) {
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    Place goal = Place::Zero();
    for (const Line& line : lines) {
        const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - line.along * line.along.transpose();
        square += across;
        goal += across * line.middle;
    }
    const Eigen::Vector3d values = axes_of(square).values;
    return {inverse_of(square) * goal, std::sqrt(values[2] / std::fmax(values[0], 1e-30))};
}

double min_way(std::span<const Place> places, const Place& along) {
    double low = along.dot(places[0]);
    double high = low;
    for (const Place& place : places) {
        low = std::fmin(low, along.dot(place));
        high = std::fmax(high, along.dot(place));
    }
    return high - low;
}

/// Vector from the intersection of the other three lines to a corner's line, across that line.
Place beside_others(const Lines& lines, std::size_t k) {
    std::vector<Line> others;
    for (std::size_t other = 0; other < lines.size(); ++other) {
        if (other != k) {
            others.push_back(line_through(lines[other]));
        }
    }
    const Line mine = line_through(lines[k]);
    const Place off = mine.middle - meeting_of(others).place;
    return off - off.dot(mine.along) * mine.along;
}

/// A corner whose line misses the intersection of the others by more than the ruler's error explains.
struct Misfit {
    std::size_t corner = 0;
    double off_m = 0.0;
    double chi2 = 0.0; ///< with two degrees of freedom
};

Misfit misfit_of(Lines lines, std::size_t k) {
    constexpr double step_m = 1e-5;
    const Place off = beside_others(lines, k);
    const Place along = line_through(lines[k]).along;
    Eigen::Matrix3d covariance =
        along * along.transpose(); // the offset has no part along the line, so any variance will do
    for (std::vector<Place>& places : lines) {
        for (Place& place : places) {
            for (int axis = 0; axis < 3; ++axis) {
                const double measured = place[axis];
                place[axis] = measured + step_m;
                const Place moved = (beside_others(lines, k) - off) * (usual_ruler_error_m / step_m);
                place[axis] = measured;
                covariance += moved * moved.transpose();
            }
        }
    }
    return {k, off.norm(), off.dot(inverse_of(covariance) * off)};
}

/// The corner that fits the others least; nothing if the ruler's error explains all.
std::optional<Misfit> worst_misfit(const Lines& lines) {
    constexpr double chi2_limit = 9.2; // 99 % quantile, two degrees of freedom
    Misfit worst;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const Misfit next = misfit_of(lines, k);
        worst = next.chi2 > worst.chi2 ? next : worst;
    }
    return worst.chi2 > chi2_limit ? std::optional(worst) : std::nullopt;
}

constexpr std::array<std::string_view, 4> corner_words{"top left", "top right", "bottom right",
                                                       "bottom left"};

/// Rays from the centre of projection to the corners.
struct Rays {
    Place centre;
    std::array<Place, 4> along; ///< unit
};

/// fx, fy, cx, cy and the rotation, from four rays: the homography from pixels to rays, decomposed by RQ like
/// a camera matrix.
std::optional<std::pair<geometry::Pinhole, Eigen::Matrix3d>> projector_of(const Rays& rays, int width,
                                                                          int height) {
    const double w = width;
    const double h = height;
    // Directions d_k = s_k ray_k are linear in (u, v, 1), so d0 - d1 + d2 - d3 = 0 determines the lengths s
    // up to scale.
    Eigen::Matrix3d three;
    three << rays.along[0], -rays.along[1], rays.along[2];
    const Eigen::Vector3d lengths = three.fullPivLu().solve(rays.along[3]);
    if (!(lengths.minCoeff() > 0.0)) {
        return std::nullopt;
    }
    const Place d0 = lengths[0] * rays.along[0];
    const Place d1 = lengths[1] * rays.along[1];
    const Place d3 = rays.along[3];
    // M from J: a pixel's direction is rotation * inverse(intrinsics) * (u, v, 1).
    Eigen::Matrix3d direction_by_pixel;
    direction_by_pixel << (d1 - d0) / w, (d3 - d0) / h, d0;
    const Eigen::Matrix3d pixel_by_direction = direction_by_pixel.inverse();
    const Eigen::Matrix3d m = pixel_by_direction / pixel_by_direction.row(2).norm();
    if (!(m.determinant() > 0.0)) {
        return std::nullopt;
    }
    const Eigen::Vector3d axis = m.row(2);
    const double cx = m.row(0).dot(axis);
    const double cy = m.row(1).dot(axis);
    const Eigen::Vector3d down = m.row(1).transpose() - cy * axis;
    const double fy = down.norm();
    const Eigen::Vector3d y = down / fy;
    const double fx = m.row(0).dot(y.cross(axis));
    Eigen::Matrix3d j_from_m;
    j_from_m << y.cross(axis).transpose(), y.transpose(), axis.transpose();
    if (!(fx > 0.0)) {
        return std::nullopt;
    }
    return std::pair{
        geometry::Pinhole{.width = width, .height = height, .fx = fx, .fy = fy, .cx = cx, .cy = cy},
        j_from_m};
}

double degrees_between(const Place& a, const Place& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

CornerCalibration refused(VerdictReason reason) {
    CornerCalibration calibration;
    calibration.reason = std::move(reason);
    return calibration;
}

std::optional<VerdictReason> refusal_of(const Lines& lines) {
    for (const std::vector<Place>& places : lines) {
        if (places.size() < 2) {
            return VerdictReason{"corners.too_few",
                                 "each of the four corners is needed at two distances or more"};
        }
        for (const Place& place : places) {
            if (place.norm() > 50.0) {
                return VerdictReason{
                    "corners.unit",
                    fmt::format(
                        "a corner is {:.0f} m away: are these millimetres or inches? Allowed are metres",
                        place.norm())};
            }
        }
    }
    return std::nullopt;
}

/// True if the ways between the distances are too short to say where the lines meet.
bool are_too_near(const Lines& lines, const std::array<Line, 4>& fitted) {
    for (std::size_t k = 0; k < 4; ++k) {
        const double way = min_way(lines[k], fitted[k].along);
        const double off = (fitted[k].middle - fitted[(k + 2) % 4].middle).norm();
        if (way < 0.05 * off) {
            return true;
        }
    }
    return false;
}

CornerCalibration refused_for(const Misfit& misfit, std::span<const MeasuredCorner> corners) {
    CornerCalibration wrong = refused(
        {"corners.misfit",
         fmt::format(
             "the {} corner does not fit the others: the line through its places passes {:.0f} mm beside "
             "where their lines meet, which a ruler's {:.0f} mm do not explain; measure this corner "
             "again at every distance",
             corner_words[misfit.corner], 1e3 * misfit.off_m, 1e3 * usual_ruler_error_m)});
    for (std::size_t row = 0; row < corners.size(); ++row) {
        if (static_cast<std::size_t>(corners[row].corner) == misfit.corner) {
            wrong.repeat.push_back(row);
        }
    }
    return wrong;
}

/// How far the places lie from their rays, and their pixels from the picture's corners.
void add_residuals(CornerCalibration& calibration, const Lines& lines, const Rays& rays,
                   const TouchModel& model, const glm::ivec2& size) {
    double count = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
        const glm::dvec2 corner = pixel_of(static_cast<PictureCorner>(k), size.x, size.y);
        for (const Place& place : lines[k]) {
            const Place from = place - rays.centre;
            const double off = (from - from.dot(rays.along[k]) * rays.along[k]).norm();
            const auto pixel = model.pixel(glm_vector(place));
            const double off_px = pixel ? glm::distance(*pixel, corner) : 1e3;
            calibration.mean_residual_m += off;
            calibration.worst_residual_m = std::fmax(calibration.worst_residual_m, off);
            calibration.mean_residual_px += off_px;
            calibration.worst_residual_px = std::fmax(calibration.worst_residual_px, off_px);
            count += 1.0;
        }
    }
    calibration.mean_residual_m /= count;
    calibration.mean_residual_px /= count;
}

} // namespace

glm::dvec2 pixel_of(PictureCorner corner, int width, int height) {
    const bool right = corner == PictureCorner::TopRight || corner == PictureCorner::BottomRight;
    const bool bottom = corner == PictureCorner::BottomLeft || corner == PictureCorner::BottomRight;
    return {right ? width : 0.0, bottom ? height : 0.0};
}

CornerCalibration calibrate_corners(std::span<const MeasuredCorner> corners, int width, int height) {
    Lines lines;
    for (const MeasuredCorner& corner : corners) {
        lines[static_cast<std::size_t>(corner.corner)].push_back(eigen(corner.place_m));
    }
    if (auto reason = refusal_of(lines)) {
        return refused(std::move(*reason));
    }
    std::array<Line, 4> fitted;
    std::transform(lines.begin(), lines.end(), fitted.begin(), line_through);
    if (are_too_near(lines, fitted)) {
        return refused({"corners.too_near",
                        "the two distances are too near to each other to say where the lines meet: "
                        "measure one of them on a board held much nearer to the projector"});
    }
    if (const auto misfit = worst_misfit(lines)) {
        return refused_for(*misfit, corners);
    }
    const Meeting meeting = meeting_of(fitted);
    Rays rays{meeting.place, {}};
    for (std::size_t k = 0; k < 4; ++k) {
        rays.along[k] = (fitted[k].middle - meeting.place).normalized();
    }
    const auto projector = projector_of(rays, width, height);
    if (!projector) {
        return refused({"corners.no_picture",
                        "these cannot be the corners of a picture: are two of them exchanged, or is the "
                        "picture mirrored?"});
    }
    CornerCalibration calibration;
    TouchModel model;
    model.pinhole = projector->first;
    const Eigen::Quaterniond q(projector->second);
    model.projector_from_tracker.rotation = glm::normalize(glm::dquat(q.w(), q.x(), q.y(), q.z()));
    model.projector_from_tracker.translation =
        -(model.projector_from_tracker.rotation * glm_vector(meeting.place));
    const auto table = in_table_frame(model);
    if (!table) {
        return refused({"corners.off_table", "the light of the picture's middle does not meet z = 0"});
    }
    calibration.table_from_projector = table->table_from_projector;
    calibration.measured_from_projector = model.projector_from_tracker.inverse();
    calibration.pinhole = model.pinhole;
    calibration.centre_m = glm_vector(meeting.place);
    calibration.condition = meeting.condition;
    calibration.horizontal_deg = degrees_between((rays.along[0] + rays.along[3]).normalized(),
                                                 (rays.along[1] + rays.along[2]).normalized());
    calibration.vertical_deg = degrees_between((rays.along[0] + rays.along[1]).normalized(),
                                               (rays.along[3] + rays.along[2]).normalized());
    add_residuals(calibration, lines, rays, model, {width, height});
    calibration.verdict = Verdict::Usable;
    calibration.reason = {"corners.usable",
                          fmt::format("the corners lie within {:.1f} mm of four rays through one point; a "
                                      "calibration by touch is more exact",
                                      1e3 * calibration.worst_residual_m)};
    return calibration;
}

} // namespace frustumscreen::calibration
