#include "app/bench/truth/truth.h"

#include "app/bench/truth/lit_source.h"
#include "app/bench/truth/traced_mesh.h"
#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace frustumscreen::bench {

namespace {

struct PixelArea {
    int left = 0, top = 0, right = 0, bottom = 0; ///< right and bottom are one past the end
};

/// The pixels spanned by the prop's corners; the whole picture if a corner is behind the projector.
PixelArea pixels_of_prop(const geometry::PropShape& prop, const TruthView& view) {
    const geometry::RigidTransform projector_from_prop = view.prop_from_projector.inverse();
    const geometry::Pinhole& pinhole = view.projector;
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const geometry::PropFace& face : prop.faces) {
        for (const glm::dvec3& corner : face.corners) {
            const std::optional<glm::dvec2> pixel = pinhole.pixel(projector_from_prop.point(corner));
            if (!pixel) {
                return {.left = 0, .top = 0, .right = pinhole.width, .bottom = pinhole.height};
            }
            low = glm::min(low, *pixel);
            high = glm::max(high, *pixel);
        }
    }
    const auto clamped = [](double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    return {.left = clamped(std::floor(low.x), pinhole.width),
            .top = clamped(std::floor(low.y), pinhole.height),
            .right = clamped(std::ceil(high.x), pinhole.width),
            .bottom = clamped(std::ceil(high.y), pinhole.height)};
}

/// Where the ray enters `box`; false if it never does for t > 0. `direction` need not be unit.
bool enters(const geometry::Box& box, const glm::dvec3& origin, const glm::dvec3& direction, double& enter) {
    double leave = std::numeric_limits<double>::infinity();
    enter = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) {
                return false;
            }
            continue;
        }
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

/// Whether the artifact is hit at the pixel or at one of the eight around it.
bool hit_around(const image::Image<std::uint8_t>& hit, int x, int y) {
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, hit.height - 1); ++row) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, hit.width - 1); ++column) {
            if (hit.at(column, row) != 0) {
                return true;
            }
        }
    }
    return false;
}

/// Lights the colours of one pixel's hits. Light is smooth, so a hit reuses a known light if it lies within a
/// texel of a typical pack and faces the same way.
class PixelLight {
public:
    explicit PixelLight(const LitSource* lit) : lit_(lit) {}
    void apply(const glm::dvec3& direction, Truth::Hit& hit) {
        if (lit_ == nullptr) {
            return;
        }
        constexpr float near_box = 1.0F / 512.0F;
        constexpr float same_way = 0.97F;
        const LitSource::Place place = lit_->place(hit.triangle, hit.u, hit.v, direction);
        const auto end = known_.begin() + count_;
        const auto known = std::find_if(known_.begin(), end, [&](const Known& each) {
            return glm::distance(each.place.at, place.at) < near_box &&
                   glm::dot(each.place.normal, place.normal) > same_way;
        });
        const float light = known != end ? known->light : lit_->light(place);
        if (known == end && count_ < std::ssize(known_)) {
            known_[static_cast<std::size_t>(count_++)] = {place, light};
        }
        hit.colour.linear = glm::min(light * glm::clamp(hit.colour.linear, 0.0F, 1.0F), glm::vec3(1.0F));
    }

private:
    struct Known {
        LitSource::Place place;
        float light = 0.0F;
    };
    const LitSource* lit_;
    std::array<Known, 8> known_;
    std::ptrdiff_t count_ = 0;
};

glm::u8vec4 code_of(const glm::vec3& linear) {
    return {image::srgb8_from_linear(linear.r), image::srgb8_from_linear(linear.g),
            image::srgb8_from_linear(linear.b), 255};
}

} // namespace

Result<Truth> Truth::build(std::shared_ptr<const bake::SourceMesh> mesh, const glm::dmat4& prop_from_artifact,
                           bake::Sides sides) {
    TRY(std::shared_ptr<const TracedMesh> traced,
        TracedMesh::build(std::move(mesh), prop_from_artifact, sides));
    return Truth(std::move(traced));
}

bool Truth::first_hit(const glm::dvec3& origin, const glm::dvec3& direction, Hit& hit) const {
    double enter = 0.0;
    if (!enters(traced_->box(), origin, direction, enter)) {
        return false;
    }
    // The ray starts at the box to keep float's precision for the artifact.
    const glm::dvec3 start = origin + enter * direction;
    const glm::dvec3 unit = glm::normalize(direction);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(start.x);
    ray.ray.org_y = static_cast<float>(start.y);
    ray.ray.org_z = static_cast<float>(start.z);
    ray.ray.dir_x = static_cast<float>(unit.x);
    ray.ray.dir_y = static_cast<float>(unit.y);
    ray.ray.dir_z = static_cast<float>(unit.z);
    ray.ray.tnear = 0.0F;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xFFFFFFFFU;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context{};
    rtcInitIntersectContext(&context);
    rtcIntersect1(traced_->scene(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return false;
    }
    glm::dvec3 t_u_v(ray.ray.tfar, ray.hit.u, ray.hit.v);
    (void)traced_->refine(ray.hit.primID, start, unit, t_u_v); // if false, Embree's own values remain
    hit = {.triangle = ray.hit.primID,
           .u = t_u_v.y,
           .v = t_u_v.z,
           .point_m = start + t_u_v.x * unit,
           .colour = surface_colour(traced_->mesh(), ray.hit.primID, t_u_v.y, t_u_v.z)};
    return true;
}

/// Follows the projector's rays to the prop and continues along the eye's rays.
class Truth::RayCaster {
public:
    RayCaster(const Truth& truth, const geometry::PropShape& prop, const TruthView& view)
        : truth_(truth), prop_(prop), view_(view) {}

    enum class Seen { Nothing, Prop, Artifact };
    struct Sight {
        Hit hit;
        glm::dvec3 direction{0.0}; ///< from the eye
        LitPlace lit;
    };
    /// The true surface along the ray through `pixel`; Nothing if it does not light the prop.
    [[nodiscard]] Seen look(const glm::dvec2& pixel, Sight& sight) const {
        const glm::dvec3 projector = view_.prop_from_projector.translation;
        const glm::dvec3 ray = view_.prop_from_projector.direction(view_.projector.ray(pixel));
        geometry::PropHit on_prop;
        if (!geometry::intersect(prop_, projector, ray, on_prop)) {
            return Seen::Nothing;
        }
        const geometry::Plane& face = prop_.faces[static_cast<std::size_t>(on_prop.face)].plane;
        if (!(face.distance(view_.eye_m) > 0.0)) {
            return Seen::Prop;
        }
        sight.lit = {on_prop.face, projector + on_prop.t * ray, pixel};
        sight.direction = sight.lit.point_m - view_.eye_m;
        return truth_.first_hit(view_.eye_m, sight.direction, sight.hit) ? Seen::Artifact : Seen::Prop;
    }
    /// Calls `met(sight)` for each ray of the pixel's grid that meets the artifact.
    template <typename Met> void look_through(int x, int y, const glm::ivec2& rays, const Met& met) const {
        Sight sight;
        for (int ray = 0; ray < rays.x * rays.y; ++ray) {
            const glm::ivec2 cell(ray % rays.x, ray / rays.x);
            const glm::dvec2 place = (glm::dvec2(cell) + 0.5) / glm::dvec2(rays);
            if (look(glm::dvec2(x, y) + place, sight) == Seen::Artifact) {
                met(sight);
            }
        }
    }
    /// Calls `pixel(x, y)` for all pixels that may show the prop, on every core.
    template <typename Pixel> void for_each_pixel(const Pixel& pixel) const {
        const PixelArea area = pixels_of_prop(prop_, view_);
        parallel_for(static_cast<std::size_t>(std::max(area.bottom - area.top, 0)), 1,
                     [&](std::size_t begin, std::size_t) {
                         for (int x = area.left; x < area.right; ++x) {
                             pixel(x, area.top + static_cast<int>(begin));
                         }
                     });
    }

private:
    const Truth& truth_;
    const geometry::PropShape& prop_;
    const TruthView& view_;
};

TruthPicture Truth::cast(const geometry::PropShape& prop, const TruthView& view, bool sixteen_rays,
                         const LightAim* aim) const {
    const int width = view.projector.width;
    const int height = view.projector.height;
    const glm::u8vec4 black(0, 0, 0, 255);
    TruthPicture picture{.prop = {width, height},
                         .hit = {width, height},
                         .point_m = {width, height, glm::vec3(std::numeric_limits<float>::quiet_NaN())},
                         .colour = {width, height, black},
                         .colour16 = {}};
    const RayCaster caster(*this, prop, view);
    const LitSource* const lit = sixteen_rays ? lit_.get() : nullptr;
    caster.for_each_pixel([&](int x, int y) {
        RayCaster::Sight sight;
        const RayCaster::Seen seen = caster.look({x + 0.5, y + 0.5}, sight);
        picture.prop.at(x, y) = seen != RayCaster::Seen::Nothing ? 1 : 0;
        if (seen == RayCaster::Seen::Artifact) {
            PixelLight(lit).apply(sight.direction, sight.hit);
            picture.hit.at(x, y) = 1;
            picture.point_m.at(x, y) = glm::vec3(sight.hit.point_m);
            picture.colour.at(x, y) = code_of(sight.hit.colour.linear);
        }
    });
    if (!sixteen_rays) {
        return picture;
    }
    picture.colour16 = image::Image8(width, height, black);
    const std::optional<ShownLight> shown =
        aim != nullptr ? std::optional<ShownLight>(std::in_place, *aim, prop, view) : std::nullopt;
    picture.shown16 = shown ? image::Image8(width, height, black) : image::Image8();
    picture.met_by_16 = image::Image<std::uint8_t>(width, height);
    caster.for_each_pixel([&](int x, int y) {
        if (!hit_around(picture.hit, x, y)) {
            return;
        }
        PixelLight light(lit);
        glm::vec3 sum(0.0F);
        glm::vec3 shown_sum(0.0F);
        caster.look_through(x, y, {4, 4}, [&](RayCaster::Sight& met) {
            light.apply(met.direction, met.hit);
            const glm::vec3 colour = glm::clamp(met.hit.colour.linear, 0.0F, 1.0F);
            sum += colour;
            if (shown) {
                shown_sum += glm::min(static_cast<float>(shown->gain(met.lit)) * colour, 1.0F);
            }
            ++picture.met_by_16.at(x, y);
        });
        picture.colour16.at(x, y) = code_of(sum / 16.0F);
        if (shown) {
            picture.shown16.at(x, y) = code_of(shown_sum / 16.0F);
        }
    });
    return picture;
}

image::Image<float> Truth::cover(const geometry::PropShape& prop, const TruthView& view,
                                 const TruthPicture& picture, const glm::ivec2& rays) const {
    image::Image<float> cover(view.projector.width, view.projector.height);
    const RayCaster caster(*this, prop, view);
    caster.for_each_pixel([&](int x, int y) {
        const int met = picture.met_by_16.at(x, y);
        float& share = cover.at(x, y);
        if (met == 0 || met == 16) {
            share = met == 0 ? 0.0F : 1.0F;
            return;
        }
        caster.look_through(x, y, rays, [&](const RayCaster::Sight&) { share += 1.0F; });
        share /= static_cast<float>(rays.x * rays.y);
    });
    return cover;
}

} // namespace frustumscreen::bench
