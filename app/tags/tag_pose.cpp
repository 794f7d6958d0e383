#include "app/tags/tag_pose.h"

#include "app/tags/tag_starts.h"
#include "app/tracking/pose_math.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace frustumscreen::tags {

namespace {

constexpr int unknowns = 6; ///< a shift and a rotation in the camera's axes, as PoseStep
using Vector = Eigen::Matrix<double, unknowns, 1>;
using Matrix = Eigen::Matrix<double, unknowns, unknowns>;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Number of tags to start a fit from, largest first: each further one takes time and finds no other pose.
constexpr std::size_t max_starts = 3;
/// A tag whose RMS corner error exceeds this many times its noise is wrong.
constexpr double max_sd_off = 6.0;
constexpr double min_px_off = 1.5;

struct Corner {
    glm::dvec3 prop_m;
    glm::dvec2 px;
    double later_s = 0.0; ///< time of its row, relative to that of the pose
};
struct SeenTag {
    std::array<Corner, 4> corners;
    std::array<glm::dvec2, 4> directions; ///< undistorted
    const PropTag* tag = nullptr;
};
using SeenTags = std::vector<SeenTag>;

struct Fit {
    geometry::RigidTransform pose;
    double cost = infinite;         ///< sum of squared distances, pixels^2
    Matrix normal = Matrix::Zero(); ///< normal matrix at the pose, in pixels
};

/// The camera; for a rolling shutter also the previous pose of the prop.
struct View {
    const geometry::Pinhole& camera;
    std::optional<geometry::RigidTransform> before;
    double since_s = 1.0; ///< from `before` to the unknown pose
};

/// Projects the corners of a prop that has a pose at its time, and continues its motion since the previous
/// one.
class SeenProp {
public:
    SeenProp(const geometry::RigidTransform& pose, const View& view) : pose_(pose), view_(view) {
        if (view.before) {
            step_ = tracking::step_between(*view.before, pose);
        }
    }
    [[nodiscard]] std::optional<glm::dvec2> pixel(const Corner& corner) const {
        if (!view_.before) {
            return view_.camera.pixel(pose_.point(corner.prop_m));
        }
        const double times = corner.later_s / view_.since_s;
        const geometry::RigidTransform then =
            tracking::moved(pose_, {times * step_.shift_m, times * step_.turn_rad});
        return view_.camera.pixel(then.point(corner.prop_m));
    }

private:
    geometry::RigidTransform pose_;
    const View& view_;
    tracking::PoseStep step_;
};

double cost_of(const SeenTag& tag, const SeenProp& prop) {
    double sum = 0.0;
    for (const Corner& corner : tag.corners) {
        const std::optional<glm::dvec2> px = prop.pixel(corner);
        const glm::dvec2 off = px ? *px - corner.px : glm::dvec2(infinite);
        sum += glm::dot(off, off);
    }
    return sum;
}

double cost_of(const SeenTags& tags, const geometry::RigidTransform& pose, const View& view) {
    const SeenProp prop(pose, view);
    double sum = 0.0;
    for (const SeenTag& tag : tags) {
        sum += cost_of(tag, prop);
    }
    return sum;
}

tracking::PoseStep step_of(const Vector& v) {
    return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

/// A pose and its neighbours on both sides along each unknown, for derivatives by central differences, which
/// are accurate to nine digits here.
struct Neighbours {
    static constexpr double step = 1e-6; // metres and radians
    SeenProp here;
    std::vector<SeenProp> more, less;
};

Neighbours beside(const geometry::RigidTransform& pose, const View& view) {
    Neighbours all{SeenProp(pose, view), {}, {}};
    for (int k = 0; k < unknowns; ++k) {
        const Vector ahead = Neighbours::step * Vector::Unit(k);
        all.more.emplace_back(tracking::moved(pose, step_of(ahead)), view);
        all.less.emplace_back(tracking::moved(pose, step_of(-ahead)), view);
    }
    return all;
}

/// Adds a corner's contribution to the normal equations.
void add_corner(const Corner& corner, const Neighbours& props, Matrix& normal, Vector& gradient) {
    Eigen::Matrix<double, 2, unknowns> slope = Eigen::Matrix<double, 2, unknowns>::Zero();
    for (int k = 0; k < unknowns; ++k) {
        const auto more = props.more[static_cast<std::size_t>(k)].pixel(corner);
        const auto less = props.less[static_cast<std::size_t>(k)].pixel(corner);
        if (more && less) {
            const glm::dvec2 by_step = (*more - *less) / (2.0 * Neighbours::step);
            slope.col(k) << by_step.x, by_step.y;
        }
    }
    const glm::dvec2 off = corner.px - props.here.pixel(corner).value_or(corner.px);
    gradient += slope.transpose() * Eigen::Vector2d(off.x, off.y);
    normal += slope.transpose() * slope;
}

/// Descends from `start`.
Fit refined(const SeenTags& tags, const geometry::RigidTransform& start, const View& view) {
    constexpr int max_rounds = 40;
    constexpr double min_gain = 1e-9; // of the cost: converged
    Fit fit{start, cost_of(tags, start, view)};
    double damping = 1e-3;
    bool done = !std::isfinite(fit.cost);
    for (int round = 0; round < max_rounds && !done; ++round) {
        fit.normal.setZero();
        Vector gradient = Vector::Zero();
        const Neighbours props = beside(fit.pose, view);
        for (const SeenTag& tag : tags) {
            for (const Corner& corner : tag.corners) {
                add_corner(corner, props, fit.normal, gradient);
            }
        }
        done = true;
        for (; damping < 1e6; damping *= 10.0) {
            Matrix damped = fit.normal;
            damped.diagonal() *= 1.0 + damping;
            const Eigen::LLT<Matrix> factor(damped);
            if (factor.info() != Eigen::Success) {
                continue;
            }
            const geometry::RigidTransform next = tracking::moved(fit.pose, step_of(factor.solve(gradient)));
            const double cost = cost_of(tags, next, view);
            if (cost < fit.cost) {
                done = fit.cost - cost <= min_gain * fit.cost;
                fit.pose = next;
                fit.cost = cost;
                damping *= 0.1;
                break;
            }
        }
    }
    return fit;
}

/// Squared distance of two poses in units of the corners' accuracy; below one they are equal.
double apart(const Fit& a, const Fit& b, double variance) {
    const tracking::PoseStep step = tracking::step_between(a.pose, b.pose);
    Vector v;
    v << step.shift_m.x, step.shift_m.y, step.shift_m.z, step.turn_rad.x, step.turn_rad.y, step.turn_rad.z;
    return v.dot(a.normal * v) / variance;
}

struct BestFits {
    Fit best;
    Fit second; ///< a different pose; its cost is infinite if there is none
};

BestFits fit_all(const SeenTags& tags, const View& view, double variance) {
    std::vector<Fit> fits;
    for (const SeenTag& seen : std::span(tags).first(std::min(tags.size(), max_starts))) {
        const auto start = tag_start(seen.directions, seen.tag->size_m);
        if (!start) {
            continue;
        }
        const geometry::RigidTransform& prop_from_tag = seen.tag->prop_from_tag;
        const geometry::RigidTransform tag_from_prop = prop_from_tag.inverse();
        fits.push_back(refined(tags, *start * tag_from_prop, view));
        fits.push_back(refined(tags, mirrored(*start) * tag_from_prop, view));
        // The mirror image of a fitted pose is nearer to the other pose than that of a start.
        fits.push_back(refined(tags, mirrored(fits.front().pose * prop_from_tag) * tag_from_prop, view));
    }
    std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
    BestFits found;
    found.best = fits.empty() ? Fit{} : fits.front();
    for (const Fit& fit : fits) {
        if (std::isfinite(fit.cost) && apart(found.best, fit, variance) > 1.0) {
            found.second = fit;
            break;
        }
    }
    return found;
}

SeenTags seen_tags(std::span<const FoundTag> found, std::span<const PropTag> prop,
                   const geometry::Pinhole& camera) {
    SeenTags seen;
    for (const FoundTag& tag : found) {
        const auto same_id = [&tag](const auto& other) { return other.id == tag.id; };
        const auto known = std::find_if(prop.begin(), prop.end(), same_id);
        if (known == prop.end() || std::count_if(found.begin(), found.end(), same_id) != 1) {
            continue;
        }
        SeenTag one;
        one.tag = &*known;
        const std::array<glm::dvec3, 4> corners = known->corners();
        for (std::size_t k = 0; k < corners.size(); ++k) {
            one.corners[k] = {corners[k], tag.corners_px[k], 0.0};
            one.directions[k] = glm::dvec2(camera.ray(tag.corners_px[k]));
        }
        seen.push_back(one);
    }
    const auto size = [](const SeenTag& tag) {
        return glm::distance(tag.directions[0], tag.directions[2]) +
               glm::distance(tag.directions[1], tag.directions[3]);
    };
    std::sort(seen.begin(), seen.end(),
              [&size](const SeenTag& a, const SeenTag& b) { return size(a) > size(b); });
    return seen;
}

/// Sets each corner's time by its row, and returns the time of their mean row, after the frame's first.
double set_moments(SeenTags& tags, const geometry::Pinhole& camera, double readout_s) {
    const double corners = 4.0 * static_cast<double>(tags.size());
    double moment_s = 0.0;
    for (const SeenTag& tag : tags) {
        for (const Corner& corner : tag.corners) {
            moment_s += readout_s * corner.px.y / camera.height / corners;
        }
    }
    for (SeenTag& tag : tags) {
        for (Corner& corner : tag.corners) {
            corner.later_s = readout_s * corner.px.y / camera.height - moment_s;
        }
    }
    return moment_s;
}

/// The spread of the best fit, with the contribution of the second one.
TagPose with_spread(const BestFits& fits, const SeenTags& tags, double variance) {
    const double corners = 4.0 * static_cast<double>(tags.size());
    TagPose pose{.camera_from_prop = fits.best.pose,
                 .place_sd_m = infinite,
                 .turn_sd_rad = infinite,
                 .tags = tags.size()};
    const Eigen::LLT<Matrix> factor(fits.best.normal);
    if (factor.info() != Eigen::Success) {
        return pose;
    }
    const double freedom = 2.0 * corners - static_cast<double>(unknowns);
    const double inflated = std::fmax(variance, fits.best.cost / freedom);
    const Vector variances = inflated * factor.solve(Matrix::Identity()).diagonal();
    double place = variances.head<3>().sum();
    double turn = variances.tail<3>().sum();
    if (std::isfinite(fits.second.cost)) {
        // Half of the exponent for independent noise: a corner's errors by blur, gamma and glare are
        // correlated.
        const double odds = std::exp(-0.25 * (fits.second.cost - fits.best.cost) / inflated);
        const double share = odds / (1.0 + odds);
        const tracking::PoseStep other = tracking::step_between(fits.best.pose, fits.second.pose);
        place += share * glm::dot(other.shift_m, other.shift_m);
        turn += share * glm::dot(other.turn_rad, other.turn_rad);
    }
    pose.place_sd_m = std::sqrt(place);
    pose.turn_sd_rad = std::sqrt(turn);
    return pose;
}

} // namespace

std::optional<TagPose> pose_from_tags(std::span<const FoundTag> found, std::span<const PropTag> prop,
                                      const geometry::Pinhole& camera, double corner_sd_px,
                                      const RollingShutter& shutter) {
    const double variance = corner_sd_px * corner_sd_px;
    const double max_cost = 4.0 * std::pow(std::fmax(max_sd_off * corner_sd_px, min_px_off), 2.0);
    SeenTags tags = seen_tags(found, prop, camera);
    while (!tags.empty()) {
        const double moment_s = set_moments(tags, camera, shutter.readout_s);
        View view{camera, {}, moment_s - shutter.before_s};
        if (shutter.readout_s > 0.0 && view.since_s > 0.0) {
            view.before = shutter.before;
        }
        const BestFits fits = fit_all(tags, view, variance);
        if (!std::isfinite(fits.best.cost)) {
            return std::nullopt;
        }
        const SeenProp best(fits.best.pose, view);
        const auto worst =
            std::max_element(tags.begin(), tags.end(), [&](const SeenTag& a, const SeenTag& b) {
                return cost_of(a, best) < cost_of(b, best);
            });
        if (cost_of(*worst, best) <= max_cost) {
            TagPose pose = with_spread(fits, tags, variance);
            pose.moment_s = moment_s;
            return pose;
        }
        // If two tags contradict each other, the wrong one cannot be identified.
        if (tags.size() <= 2) {
            return std::nullopt;
        }
        tags.erase(worst);
    }
    return std::nullopt;
}

} // namespace frustumscreen::tags
