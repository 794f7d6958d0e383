// Torches on the part of a site in windows, against rays from the torch to the regions' own triangles: a frozen window keeps the light that
// lay on the part, a live one follows the torch while the part stands in the prop.

#include "tests/render/counted_new.h"
#include "tests/render/keep_picture.h"
#include "tests/render/torch_truth.h"
#include "tests/show/site_windows_rig.h"

#include <cstdio>
#include <limits>
#include <string>

namespace frustumscreen::synthetic {
namespace {

constexpr double window_light = 0.4; // with a torch's full light below the clipping at 1
constexpr double half_opening_rad = 0.3;

/// The torch's light on a part of the site.
struct LitCounts {
    std::size_t lit = 0, dark = 0, shadow = 0, edge = 0, wrong = 0;
};

class SiteLight : public SiteWindows {
protected:
    SiteLight() { has_torch_ = true; }
    /// At a place beside the prop, pointed at the middle of its ground; table frame.
    [[nodiscard]] scene::PlacedTorch torch_at(const glm::dvec3& beside) const {
        torch::Beam beam;
        beam.opening_rad = 2.0 * half_opening_rad;
        beam.attenuation = torch::Attenuation::None;
        const glm::dvec3 ground = table_.table_from_prop.point({0.0, 0.0, 0.0});
        const glm::dvec3 z = glm::normalize(-beside);
        const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), z));
        const glm::dmat3 axes(x, glm::cross(z, x), z);
        return scene::placed(torch::white(), beam, {glm::quat_cast(axes), ground + beside}, 0.0);
    }
    /// The first place that the torch meets, prop frame: of what lies behind the window.
    [[nodiscard]] double first_way(const glm::dvec3& from, const glm::dvec3& to,
                                   const geometry::Plane& window, const world::SiteView& part,
                                   const std::array<bool, site_regions>& is_fine) const {
        const double before = window.distance(from);
        const double down = -glm::dot(window.normal, to);
        const glm::dvec3 start = before > 0.0 ? from + before / down * to : from;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t region = 0; region < site_regions && (before <= 0.0 || down > 0.0); ++region) {
            const glm::dvec3 middle = view_at(region).place_at(glm::dvec3(0.0));
            const glm::dvec3 box = double{site_rows} * (part.place_at(start / metres_per_box_) - middle);
            const ReferenceCast::Hit met = (is_fine[region] ? fine_ : coarse_).first_hit(box, to);
            if (met.found) {
                const double way = glm::length(met.point - box) * metres_per_box_ * part.zoom / site_rows;
                nearest = std::fmin(nearest, glm::distance(start, from) + way);
            }
        }
        return nearest;
    }
    /// Compares the window with rays from the torch, which stands at `prop_from_torch` in the prop that was pinned.
    [[nodiscard]] LitCounts compare_light(const scene::PinnedView& view, const world::SiteView& part,
                                          const geometry::RigidTransform& prop_from_torch) {
        const std::array<bool, site_regions> is_fine = fine_regions();
        const glm::dmat3 turn(view.window_from_prop / view.scale);
        const geometry::Plane window{.normal = glm::transpose(turn) * glm::dvec3(0.0, 0.0, 1.0),
                                     .offset = -view.window_from_prop[3].z / view.scale};
        const glm::dvec3& from = prop_from_torch.translation;
        const auto in_beam = [&](const glm::dvec3& point) {
            const glm::dvec3 at = prop_from_torch.inverse().point(point);
            return at.z > 0.0 && std::hypot(at.x, at.y) <= at.z * std::tan(half_opening_rad);
        };
        const auto is_free = [&](const Shown& at, double slack) {
            const double way = glm::distance(at.point, from);
            return first_way(from, (at.point - from) / way, window, part, is_fine) > way * (1.0 - slack);
        };
        const auto is_lit = [&](const Shown& at, double slack) {
            return at.region && in_beam(at.point) &&
                   glm::dot(at.normal, from - at.point) * glm::dot(at.normal, at.eye - at.point) > 0.0 &&
                   is_free(at, slack);
        };
        const double base = window_light * light_of_code(250.0);
        const auto agrees = [&](const glm::u8vec4& code, bool lit) {
            return std::fabs(static_cast<double>(code.r) - code_of_light(lit ? 2.0 * base : base)) <= 1.5;
        };
        const image::Image8 drawn = picture();
        LitCounts counts;
        for (int y = 0; y < drawn.height; ++y) {
            for (int x = 0; x < drawn.width; ++x) {
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const Shown own = shown_at(pixel, view, part, is_fine);
                if (!own.region) {
                    continue;
                }
                const bool lit = is_lit(own, 1e-6);
                (lit ? counts.lit : in_beam(own.point) ? counts.shadow : counts.dark) += 1;
                if (!agrees(drawn.at(x, y), lit)) {
                    ++(is_edge(
                           pixel, own, lit,
                           [&](const glm::dvec2& at) { return shown_at(at, view, part, is_fine); }, is_lit)
                           ? counts.edge
                           : counts.wrong);
                }
            }
        }
        std::printf("%zu lit, %zu in a shadow, %zu beside the beam, %zu at an edge, %zu wrong\n", counts.lit,
                    counts.shadow, counts.dark, counts.edge, counts.wrong);
        return counts;
    }
    /// Close by, something else is seen, or the light is another: its shadows are right within a pixel of the torch's picture, which
    /// is less than two of the projector's here.
    template <typename At, typename IsLit>
    [[nodiscard]] static bool is_edge(const glm::dvec2& pixel, const Shown& own, bool lit, const At& shown_at,
                                      const IsLit& is_lit) {
        for (int k = 0; k < 48; ++k) {
            const double angle = k * std::numbers::pi / 8.0;
            const double r = k < 16 ? outline_px : k < 32 ? 1.0 : 2.0;
            const Shown at = shown_at(pixel + r * glm::dvec2(std::cos(angle), std::sin(angle)));
            const bool is_outline = k < 16 && (at.region != own.region || at.in_window != own.in_window ||
                                               glm::distance(at.point, own.point) > 2e-3);
            if (is_outline || is_lit(at, 1e-6) != lit || is_lit(at, 5e-3) != lit) {
                return true;
            }
        }
        return false;
    }
    void expect_as_rays_say(const LitCounts& counts) {
        EXPECT_GT(counts.lit, 300U);
        EXPECT_GT(counts.shadow, 50U);
        EXPECT_LE(counts.wrong, (counts.lit + counts.shadow + counts.dark) / 2000);
        EXPECT_LT(counts.edge, (counts.lit + counts.shadow) / 4);
    }
    static constexpr std::size_t region = 14;
    const typography::TableRectangle rectangle_{{0.19, 0.0}, {0.12, 0.12}, 0};
};

TEST_F(SiteLight, IsKeptInAFrozenWindow) {
    start(unlimited);
    const world::SiteView part = view_at(region);
    stay(region);
    const TestTable pinned_at = table_;
    torches_ = {torch_at({-0.12, -0.2, 0.3})};
    const geometry::RigidTransform prop_from_torch =
        pinned_at.table_from_prop.inverse() * torches_.front().table_from_torch;
    pin(rectangle_, window_light);
    draw(part, region);
    torches_.clear();
    const scene::PinnedView view = pinned(rectangle_, pinned_at);
    const std::array<glm::dvec3, 2> eyes{table_.eye_m, {0.45, -0.25, 0.5}};
    for (std::size_t k = 0; k < eyes.size(); ++k) {
        table_.eye_m = eyes[k];
        for (int frame = 0; frame < 40; ++frame) { // the prop is back in miniature, and the window stays
            draw(k == 0 ? std::optional(part) : std::nullopt, std::nullopt);
        }
        keep_picture(picture(), "WINDOW_PICTURES", "site_light_" + std::to_string(k));
        expect_as_rays_say(compare_light(view, part, prop_from_torch));
    }
}

TEST_F(SiteLight, FollowsTheTorchInALiveWindowWhileThePartStandsInTheProp) {
    start(unlimited);
    const world::SiteView part = view_at(region);
    stay(region);
    const TestTable pinned_at = table_;
    pin(rectangle_, window_light, true);
    const scene::PinnedView view = pinned(rectangle_, pinned_at);
    geometry::RigidTransform prop_from_torch;
    for (const glm::dvec3& beside : {glm::dvec3(0.2, 0.05, 0.25), glm::dvec3(-0.15, -0.1, 0.3)}) {
        torches_ = {torch_at(beside)};
        prop_from_torch = pinned_at.table_from_prop.inverse() * torches_.front().table_from_torch;
        draw(part, region);
        expect_as_rays_say(compare_light(view, part, prop_from_torch));
    }
    torches_ = {torch_at({0.2, 0.05, 0.25})};
    for (int frame = 0; frame < 40; ++frame) {
        draw(std::nullopt, std::nullopt);
    }
    std::printf("in miniature: ");
    expect_as_rays_say(compare_light(view, part, prop_from_torch));
}

/// The torch is pointed past the prop.
TEST_F(SiteLight, IgnoresATorchThatMissesTheProp) {
    start(unlimited);
    stay(region);
    scene::PlacedTorch torch = torch_at({-0.12, -0.2, 0.3});
    torch.table_from_torch.rotation = {1.0, 0.0, 0.0, 0.0}; // upwards
    torches_ = {torch};
    presentation_.torches.house_light = 0.5;
    pin(rectangle_, window_light);
    draw(view_at(region), region);
    const image::Image8 beside = picture();
    torches_.clear();
    draw(view_at(region), region);
    EXPECT_EQ(picture().texels, beside.texels);
}

TEST_F(SiteLight, DrawingAllocatesNothing) {
    if (!allocations_are_counted) {
        GTEST_SKIP() << "allocations are not counted under a sanitizer";
    }
    start(unlimited);
    const world::SiteView part = view_at(region);
    stay(region);
    torches_ = {torch_at({-0.12, -0.2, 0.3})};
    pin(rectangle_, window_light, true);
    stay(region);
    for (int frame = 0; frame < 10; ++frame) {
        torches_.front().table_from_torch.translation.x += 1e-3;
        const long before = allocations_so_far();
        draw(part, region);
        EXPECT_EQ(allocations_so_far() - before, 0);
    }
}

/// A region whose page comes while its window lies there changes to it pixel by pixel.
TEST_F(SiteWindows, FadeARegionToItsFinerLevel) {
    start(unlimited);
    const std::size_t region = 14;
    const world::SiteView part = view_at(region);
    const TestTable pinned_at = table_;
    const typography::TableRectangle rectangle{{0.19, 0.0}, {0.12, 0.12}, 0};
    draw(part, std::nullopt);
    pin(rectangle);
    draw(part, std::nullopt);
    ASSERT_FALSE(fine_regions()[region]) << "the window begins with its proxy";
    const scene::PinnedView view = pinned(rectangle, pinned_at);
    std::vector<image::Image8> pictures{picture()};
    for (int frame = 0; frame < 60; ++frame) {
        draw(part, std::nullopt);
        pictures.push_back(picture());
    }
    const std::array<bool, site_regions> is_fine = fine_regions();
    ASSERT_TRUE(is_fine[region]);
    EXPECT_FALSE(windows_->fades());
    std::size_t all = 0; // pixels of the region that the finer level changes
    std::vector<std::size_t> changed(pictures.size());
    for (int y = 0; y < table_.projector.height; ++y) {
        for (int x = 0; x < table_.projector.width; ++x) {
            const Shown shown = shown_at({x + 0.5, y + 0.5}, view, part, is_fine);
            const std::array codes{pictures.front().at(x, y), pictures.back().at(x, y)};
            if (!shown.in_window || codes[0] == codes[1] ||
                (codes[0].b != region_blue(region) && codes[1].b != region_blue(region))) {
                continue;
            }
            ++all;
            for (std::size_t k = 1; k < pictures.size(); ++k) {
                changed[k] += pictures[k].at(x, y) != pictures[k - 1].at(x, y) ? 1U : 0U;
            }
        }
    }
    const std::size_t most = *std::max_element(changed.begin(), changed.end());
    std::printf("%zu pixels change, at most %zu of them in a frame\n", all, most);
    ASSERT_GT(all, 30U);
    EXPECT_LT(most, all / 4) << "a frame is a twentieth of the fade";
}

} // namespace
} // namespace frustumscreen::synthetic
