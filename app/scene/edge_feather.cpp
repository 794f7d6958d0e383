#include "app/scene/edge_feather.h"

#include "app/geometry/prop_edges.h"
#include "app/scene/frame_plan.h"

#include <algorithm>
#include <optional>

namespace frustumscreen::scene {

namespace {

constexpr double shared_px = 1.0;
/// An outer strip is dark over its first third and then becomes bright over one pixel.
constexpr double outer_px = 1.5;
constexpr float outer_share = -0.5F;
constexpr float hardly_dimmer = 0.99F; ///< changes no code

/// An edge of a face in the picture; the face lies where `inward` points.
struct PictureEdge {
    std::array<glm::dvec2, 2> ends_px{};
    glm::dvec2 inward{0.0}; ///< unit
};

std::optional<glm::dvec2> pixel_of(const glm::vec4& clip, const geometry::Pinhole& pinhole) {
    if (!(clip.w > 0.0F)) {
        return std::nullopt;
    }
    return (glm::dvec2(clip) / static_cast<double>(clip.w) * 0.5 + 0.5) *
           glm::dvec2(pinhole.width, pinhole.height);
}

glm::vec4 clip_of(const glm::dvec2& pixel, const geometry::Pinhole& pinhole) {
    return {glm::vec2(2.0 * pixel / glm::dvec2(pinhole.width, pinhole.height) - 1.0), 0.0F, 1.0F};
}

/// The edge from corner `k` to the next; nullopt if it is not in front of the projector or has no length.
std::optional<PictureEdge> edge_of(const FacePlan& face, std::size_t k, const geometry::Pinhole& pinhole) {
    const geometry::PerCorner<glm::vec4>& corners = face.corners_clip;
    const std::size_t next = corners.next(k);
    const std::optional<glm::dvec2> a = pixel_of(corners[k], pinhole);
    const std::optional<glm::dvec2> b = pixel_of(corners[next], pinhole);
    const std::optional<glm::dvec2> inside = pixel_of(corners[corners.next(next)], pinhole);
    if (!a || !b || !inside || !(glm::distance(*a, *b) > 0.0)) {
        return std::nullopt;
    }
    const glm::dvec2 along = glm::normalize(*b - *a);
    const glm::dvec2 aside(-along.y, along.x);
    return PictureEdge{{*a, *b}, glm::dot(aside, *inside - *a) < 0.0 ? -aside : aside};
}

/// True if the rectangle reaches into the strip.
bool touches(const PictureEdge& edge, const PixelRectangle& bounds, double width_px) {
    const glm::dvec2 low(bounds.x, bounds.y);
    const glm::dvec2 high = low + glm::dvec2(bounds.width, bounds.height);
    const glm::dvec2 nearest(edge.inward.x > 0.0 ? low.x : high.x, edge.inward.y > 0.0 ? low.y : high.y);
    return glm::dot(edge.inward, nearest - edge.ends_px[0]) < width_px;
}

std::size_t index_of(const geometry::PropFace& face, const geometry::PropShape& prop) {
    return static_cast<std::size_t>(&face - prop.faces.data());
}

/// The neighbour's gain over the face's own at the edge's ends; 1 where the neighbour is not dimmer.
glm::vec2 share_between(const FaceLight& own, const FaceLight& neighbour, const PictureEdge& edge,
                        const geometry::Pinhole& pinhole) {
    const auto share_at = [&](const glm::dvec2& pixel) {
        const double dimmer = gain(neighbour, pinhole, pixel);
        const double brighter = gain(own, pinhole, pixel);
        return brighter > dimmer ? static_cast<float>(dimmer / brighter) : 1.0F;
    };
    return {share_at(edge.ends_px[0]), share_at(edge.ends_px[1])};
}

EdgeFeather strip(std::size_t face, const PictureEdge& edge, double width_px, const glm::vec2& share,
                  const geometry::Pinhole& pinhole) {
    const auto& [a, b] = edge.ends_px;
    const glm::dvec2 aside = width_px * edge.inward;
    return {
        static_cast<int>(face),
        {clip_of(a, pinhole), clip_of(b, pinhole), clip_of(b + aside, pinhole), clip_of(a + aside, pinhole)},
        share};
}

} // namespace

void feather_edges(const geometry::PropShape& prop, const glm::dvec3& projector,
                   std::span<const std::optional<FaceLight>> lights, FramePlan& plan) {
    plan.feathers.clear();
    const geometry::Pinhole ideal = plan.projector.ideal(); // the lens bends the draws later
    for (std::size_t face = 0; face < plan.faces.size(); ++face) {
        const FacePlan& own = plan.faces[face];
        const geometry::PropFace& shape = prop.faces[static_cast<std::size_t>(own.face)];
        for (std::size_t k = 0; k < own.corners_clip.size(); ++k) {
            const std::optional<PictureEdge> edge = edge_of(own, k, ideal);
            // Bounds are in bent pixels, edges in ideal ones. Behind a lens only the scissor clips the
            // strips.
            if (!edge || (plan.projector.lens.is_plain() && !touches(*edge, own.bounds, outer_px))) {
                continue;
            }
            const geometry::PropFace* const neighbour = geometry::neighbour_of(prop, shape, k);
            if (neighbour == nullptr || !(neighbour->plane.distance(projector) > 0.0)) {
                plan.feathers.push_back(strip(face, *edge, outer_px, glm::vec2(outer_share), ideal));
            } else if (const std::optional<FaceLight>& other = lights[index_of(*neighbour, prop)]) {
                const glm::vec2 share = share_between(own.light, *other, *edge, ideal);
                if (std::min(share.x, share.y) < hardly_dimmer) {
                    plan.feathers.push_back(strip(face, *edge, shared_px, share, ideal));
                }
            }
        }
    }
}

} // namespace frustumscreen::scene
