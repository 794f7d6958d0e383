#include "app/bench/truth/shown_light.h"

#include "app/geometry/prop_edges.h"
#include "app/settings/light_range.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::bench {

namespace {

/// Pixels of the real lens per pixel of the ideal one at that point; from differences of its rays.
double pixel_density(const geometry::Pinhole& pinhole, const glm::dvec2& pixel) {
    if (pinhole.lens.is_plain()) {
        return 1.0;
    }
    constexpr double step_px = 0.01;
    const glm::dvec2 right(step_px, 0.0);
    const glm::dvec2 down(0.0, step_px);
    const glm::dvec3 u = pinhole.ray(pixel + right) - pinhole.ray(pixel - right);
    const glm::dvec3 v = pinhole.ray(pixel + down) - pinhole.ray(pixel - down);
    const double ideal_px = pinhole.fx * pinhole.fy * (u.x * v.y - u.y * v.x);
    return 4.0 * step_px * step_px / ideal_px;
}

} // namespace

ShownLight::ShownLight(LightAim aim, const geometry::PropShape& prop, const TruthView& view)
    : aim_(std::move(aim)), prop_(prop), view_(view), ideal_(view.projector.ideal()) {
    edges_.resize(prop.faces.size());
    for (int face = 0; aim_.soft_edges && face < static_cast<int>(prop.faces.size()); ++face) {
        for (std::size_t corner = 0; corner < prop.faces[static_cast<std::size_t>(face)].corners.size();
             ++corner) {
            if (const std::optional<SoftEdge> edge = soft_edge(face, corner)) {
                edges_[static_cast<std::size_t>(face)].push_back(*edge);
            }
        }
    }
}

double ShownLight::even(const LitPlace& place) const {
    const auto face = static_cast<std::size_t>(place.face);
    const double received = settings::received_light(prop_.faces[face].plane, place.point_m,
                                                     view_.prop_from_projector.translation);
    const double full = aim_.reference / (received * pixel_density(view_.projector, place.pixel));
    return aim_.most[face] * std::min(1.0, full);
}

std::optional<ShownLight::SoftEdge> ShownLight::soft_edge(int face, std::size_t corner) const {
    const geometry::PropFace& own = prop_.faces[static_cast<std::size_t>(face)];
    const geometry::PerCorner<glm::dvec3>& corners = own.corners;
    const std::size_t next = corners.next(corner);
    const std::array<glm::dvec3, 2> ends{corners[corner], corners[next]};
    const geometry::RigidTransform projector_from_prop = view_.prop_from_projector.inverse();
    const auto pixel = [&](const glm::dvec3& point, const geometry::Pinhole& pinhole) {
        return pinhole.pixel(projector_from_prop.point(point));
    };
    const std::optional<glm::dvec2> a = pixel(ends[0], ideal_);
    const std::optional<glm::dvec2> b = pixel(ends[1], ideal_);
    const std::optional<glm::dvec2> inside = pixel(corners[corners.next(next)], ideal_);
    if (!a || !b || !inside) {
        return std::nullopt;
    }
    SoftEdge edge{.from_px = *a,
                  .along = glm::normalize(*b - *a),
                  .inward = {},
                  .length_px = glm::distance(*a, *b),
                  .shares = {}};
    edge.inward = {-edge.along.y, edge.along.x};
    if (glm::dot(edge.inward, *inside - *a) < 0.0) {
        edge.inward = -edge.inward;
    }
    const geometry::PropFace* const neighbour = geometry::neighbour_of(prop_, own, corner);
    if (neighbour == nullptr || !(neighbour->plane.distance(view_.prop_from_projector.translation) > 0.0)) {
        return edge;
    }
    if (!(neighbour->plane.distance(view_.eye_m) > 0.0)) {
        return std::nullopt;
    }
    const auto behind = static_cast<int>(neighbour - prop_.faces.data());
    edge.shares.emplace();
    for (std::size_t end = 0; end < 2; ++end) {
        const glm::dvec2 at = pixel(ends.at(end), view_.projector).value_or(glm::dvec2(0.0));
        edge.shares->at(end) =
            std::min(1.0, even({behind, ends.at(end), at}) / even({face, ends.at(end), at}));
    }
    return edge;
}

double ShownLight::softened(const LitPlace& place) const {
    const glm::dvec2 pixel = ideal_.pixel(view_.projector.ray(place.pixel)).value_or(place.pixel);
    double share = 1.0;
    for (const SoftEdge& edge : edges_[static_cast<std::size_t>(place.face)]) {
        const double within_px = glm::dot(edge.inward, pixel - edge.from_px);
        if (!edge.shares) { // dark for half a pixel, then rising over one pixel
            share *= std::clamp(within_px - 0.5, 0.0, 1.0);
        } else if (within_px < 1.0) {
            const double along =
                std::clamp(glm::dot(edge.along, pixel - edge.from_px) / edge.length_px, 0.0, 1.0);
            share *= std::lerp(std::lerp((*edge.shares)[0], (*edge.shares)[1], along), 1.0, within_px);
        }
    }
    return share;
}

double ShownLight::gain(const LitPlace& place) const {
    return aim_.exposure * even(place) * softened(place);
}

} // namespace frustumscreen::bench
