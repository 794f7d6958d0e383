/// Objects whose boxes interlock, each placed by an affine pose, drawn as a mesh or as a relief, and the rays that tell
/// which of them a pixel shows.
#pragma once

#include "app/scene/torch_plan.h"
#include "tests/render/reference_cast.h"
#include "tests/render/relief_rig.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace frustumscreen::synthetic {

inline void add_quad(Soup& soup, const std::array<glm::dvec3, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), corners.begin(), corners.end());
    soup.indices.insert(soup.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// A box: counter-clockwise from outside.
inline void add_box(Soup& soup, const glm::dvec3& low, const glm::dvec3& high) {
    const auto at = [&](int x, int y, int z) {
        return glm::dvec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    add_quad(soup, {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)});
    add_quad(soup, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});
    add_quad(soup, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
    add_quad(soup, {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)});
    add_quad(soup, {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)});
    add_quad(soup, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
}

/// An L, in the plane of x and z, of arms of 1 and 0.3, extruded along y by 0.3.
inline Soup l_shape() {
    Soup soup;
    const std::array<glm::dvec2, 6> outline{glm::dvec2(0.0, 0.0), {1.0, 0.0}, {1.0, 0.3},
                                            {0.3, 0.3},           {0.3, 1.0}, {0.0, 1.0}};
    const auto at = [&](std::size_t k, double y) { return glm::dvec3(outline[k].x, y, outline[k].y); };
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const std::size_t next = (k + 1) % outline.size();
        add_quad(soup, {at(k, 0.3), at(next, 0.3), at(next, 0.0), at(k, 0.0)});
    }
    add_quad(soup, {at(0, 0.0), at(1, 0.0), at(2, 0.0), at(3, 0.0)});
    add_quad(soup, {at(0, 0.0), at(3, 0.0), at(4, 0.0), at(5, 0.0)});
    add_quad(soup, {at(3, 0.3), at(2, 0.3), at(1, 0.3), at(0, 0.3)});
    add_quad(soup, {at(5, 0.3), at(4, 0.3), at(3, 0.3), at(0, 0.3)});
    return soup;
}

inline Soup torus(double ring, double tube) {
    Soup soup;
    add_torus(soup, glm::dvec3(0.0), glm::dmat3(1.0), ring, tube, 40, 20);
    return soup;
}

inline Soup box(const glm::dvec3& size) {
    Soup soup;
    add_box(soup, -0.5 * size, 0.5 * size);
    return soup;
}

/// A ball of radius 1.
inline Soup ball(std::uint32_t around = 32, std::uint32_t rows = 16) {
    Soup soup;
    for (std::uint32_t row = 0; row <= rows; ++row) {
        for (std::uint32_t k = 0; k < around; ++k) {
            const double a = 2.0 * std::numbers::pi * k / around;
            const double b = std::numbers::pi * row / rows;
            soup.points.emplace_back(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b));
        }
    }
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t k = 0; k < around; ++k) {
            const std::uint32_t next = (k + 1) % around;
            const std::uint32_t p = row * around + k, p1 = row * around + next;
            const std::uint32_t q = p + around, q1 = p1 + around;
            if (row > 0) {
                soup.indices.insert(soup.indices.end(), {p, p1, q1});
            }
            if (row + 1 < rows) {
                soup.indices.insert(soup.indices.end(), {p, q1, q});
            }
        }
    }
    return soup;
}

/// A soup and its place in a world of any size.
struct WorldObject {
    Soup soup;
    glm::dmat4 world_from_soup{1.0};
};

enum class Way { Mesh, DrawnRelief, RasterizedRelief };
inline constexpr std::array<Way, 3> ways{Way::Mesh, Way::DrawnRelief, Way::RasterizedRelief};

/// The pixel's part and place by a ray; part -1: none.
struct SeenPart {
    int part = -1;
    glm::dvec3 point{0.0};  ///< prop frame
    glm::dvec3 normal{0.0}; ///< of the triangle, of any length and either sign
};

/// A world whose parts are red, green and blue.
class Interlocked {
public:
    geometry::PropShape prop;
    std::unique_ptr<display::SurfacelessDisplay> display;
    std::optional<render::Renderer> renderer;
    std::optional<render::HitPointRenderer> hit_points;
    scene::FramePlan plan;
    std::vector<scene::Part> parts;

    Interlocked(const geometry::PropShape& shape, std::vector<WorldObject> objects, int samples,
                const geometry::Lens& lens = {}, int texels = 160, bool torches = false)
        : prop(shape) {
        stand(objects);
        const geometry::Pinhole projector = table_of(lens).projector;
        display = display::SurfacelessDisplay::create(projector.width, projector.height).value();
        scene::RenderNeeds needs = scene::with_cells(needs_with_reliefs(samples, projector));
        if (torches) {
            const torch::Content plain = torch::white();
            for (const torch::Blend blend : {torch::Blend::Light, torch::Blend::Over}) {
                needs = scene::with_torch(std::move(needs), torch::parts_of(plain.stages, blend));
            }
        }
        renderer = render::Renderer::create(projector.width, projector.height, needs).value();
        hit_points = render::HitPointRenderer::create(*renderer).value();
        const double metres = scale_inside(objects);
        packs_.reserve(objects.size());
        for (std::size_t k = 0; k < objects.size(); ++k) {
            add(objects[k], k, metres, samples, texels);
        }
        std::size_t indices = 0;
        for (const pack::Pack& pack : packs_) {
            indices += pack.levels[0].indices.size();
        }
        plan = scene::make_plan(prop, indices, objects.size());
        if (torches) {
            scene::make_torch_space(plan, prop.faces.size(), indices, objects.size());
        }
        parts.resize(objects.size());
    }

    void choose(std::span<const Way> chosen) {
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            parts[k] = {levels_[k][static_cast<std::size_t>(chosen[k])], std::nullopt};
        }
    }
    image::Image8 picture(const scene::PlanView& view) { return picture(view, parts); }
    image::Image8 picture(const scene::PlanView& view, std::span<const scene::Part> shown) {
        scene::plan_frame(prop, shown, view, plan);
        EXPECT_TRUE(
            renderer->draw(plan, {display->framebuffer(), display->buffer_age()}, render::Redraw::Everything)
                .drawn);
        EXPECT_TRUE(display->present(MonotonicTime{}));
        return render::read_colour(display->framebuffer(), display->width(), display->height());
    }
    [[nodiscard]] image::ImageFloat places() { return hit_points->draw(plan, renderer->store()); }

    /// The first part that the pixel's ray meets. `only`: as if the world had one part alone.
    [[nodiscard]] SeenPart seen(const TestTable& table, const glm::dvec2& pixel,
                                std::optional<int> only = std::nullopt) const {
        const std::optional<ReferenceCast::Ray> ray = ReferenceCast::ray_of(table, pixel);
        return ray ? first_on(ray->eye, ray->lit - ray->eye, only) : SeenPart{};
    }
    /// The first part that a ray of the prop's frame meets.
    [[nodiscard]] SeenPart first_on(const glm::dvec3& from, const glm::dvec3& direction,
                                    std::optional<int> only = std::nullopt) const {
        SeenPart first;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < casts_.size(); ++k) {
            if (only && *only != static_cast<int>(k)) {
                continue;
            }
            const glm::dmat4& placed_from_prop = placed_from_prop_[k];
            const ReferenceCast::Hit hit =
                casts_[k].first_hit(glm::dvec3(placed_from_prop * glm::dvec4(from, 1.0)),
                                    glm::dmat3(placed_from_prop) * direction);
            const glm::dvec3 point(levels_[k][0].prop_from_placed * glm::dvec4(hit.point, 1.0));
            if (hit.found && glm::distance(point, from) < nearest) {
                nearest = glm::distance(point, from);
                first = {static_cast<int>(k), point,
                         glm::transpose(glm::dmat3(placed_from_prop)) * hit.normal};
            }
        }
        return first;
    }

private:
    /// world_from_box: the box frame of the object's pack.
    static glm::dmat4 world_from_box(const WorldObject& object, double& longest) {
        const geometry::Box box = box_around(object.soup);
        const glm::dvec3 extent = box.high - box.low;
        longest = std::max({extent.x, extent.y, extent.z});
        const glm::dvec3 foot(0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y), box.low.z);
        return glm::scale(glm::translate(object.world_from_soup, foot), glm::dvec3(longest));
    }
    /// Moves the world onto the floor.
    static void stand(std::vector<WorldObject>& objects) {
        double lowest = std::numeric_limits<double>::infinity();
        for (const WorldObject& object : objects) {
            for (const glm::dvec3& point : object.soup.points) {
                lowest = std::min(lowest, (object.world_from_soup * glm::dvec4(point, 1.0)).z);
            }
        }
        for (WorldObject& object : objects) {
            object.world_from_soup =
                glm::translate(glm::dmat4(1.0), {0.0, 0.0, 0.01 - lowest}) * object.world_from_soup;
        }
    }
    /// At which every point of the world stays inside the prop.
    [[nodiscard]] double scale_inside(const std::vector<WorldObject>& objects) const {
        std::vector<glm::dvec3> points;
        for (const WorldObject& object : objects) {
            for (const glm::dvec3& point : object.soup.points) {
                points.emplace_back(object.world_from_soup * glm::dvec4(point, 1.0));
            }
        }
        return 0.999 * geometry::largest_scale_inside(prop, points);
    }
    void add(const WorldObject& object, std::size_t k, double metres, int samples, int texels) {
        pack::Pack& pack = packs_.emplace_back(pack_of(object.soup));
        glm::u8vec4 colour(0, 0, 0, 255);
        colour[static_cast<int>(k % 3)] = 255;
        std::fill(pack.textures[0].texels.begin(), pack.textures[0].texels.end(), colour);
        double longest = 1.0;
        const glm::dmat4 world = world_from_box(object, longest);
        const double metres_per_box = metres * longest;
        const std::shared_ptr<const relief::BlockRelief> relief = relief_of(pack, texels, true);
        std::array<scene::PlacedLevel, 3> level{
            scene::placed(pack, 0, metres_per_box, renderer->store().upload(pack, 0).value()),
            scene::placed(pack, relief, metres_per_box, renderer->store().upload(relief).value()),
            scene::placed(pack, relief, metres_per_box, renderer->store().keep(relief))};
        level[1].on_gpu = true;
        for (scene::PlacedLevel& each : level) {
            each.samples = samples;
            each.prop_from_placed = glm::scale(glm::dmat4(1.0), glm::dvec3(metres)) * world *
                                    glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / metres_per_box));
        }
        levels_.push_back(level);
        casts_.emplace_back(pack, metres_per_box);
        placed_from_prop_.push_back(glm::affineInverse(level[0].prop_from_placed));
    }

    std::vector<pack::Pack> packs_;
    std::vector<ReferenceCast> casts_;
    std::vector<glm::dmat4> placed_from_prop_;
    std::vector<std::array<scene::PlacedLevel, 3>> levels_; ///< in the order of Way
};

} // namespace frustumscreen::synthetic
