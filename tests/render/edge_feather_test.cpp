// Edges shared by two faces of the prop: the light changes gradually there.

#include "tests/render/rig.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace frustumscreen::synthetic {
namespace {

constexpr double aim = 0.2;
constexpr double step_m = 1e-4;

class EdgeFeather : public ::testing::Test {
protected:
    EdgeFeather() : rig(320, 200), table(320, 200) {
        rig.pack.textures[0] = image::Image8(8, 8, {255, 255, 255, 255});
        rig.upload_again();
        table.eye_m = {0.0, -0.45, 0.5};
    }
    image::Image8 draw(bool feathered) {
        scene::plan_frame(table.prop, rig.level, table.view(scene::LightCompensation{aim}), rig.plan);
        if (!feathered) {
            rig.plan.feathers.clear();
        }
        rig.draw(render::Redraw::Everything);
        return rig.picture();
    }
    /// An edge of the top in the picture; both adjacent faces show the artifact.
    [[nodiscard]] std::array<glm::dvec2, 2> front_edge_of_top() const {
        const geometry::RigidTransform projector_from_prop =
            table.table_from_projector.inverse() * table.table_from_prop;
        std::array<glm::dvec2, 2> ends{};
        std::size_t count = 0;
        for (const glm::dvec3& corner : table.prop.faces[4].corners) {
            if (corner.y < 0.0) {
                ends.at(count++) = *table.projector.pixel(projector_from_prop.point(corner));
            }
        }
        return ends;
    }
    /// The largest change of a pixel near that edge while the edge moves across it in small steps.
    int max_change(bool feathered) {
        int most = 0;
        table.table_from_prop.translation = {0.0, 0.0, 0.0};
        image::Image8 before = draw(feathered);
        for (int k = 1; k <= 40; ++k) {
            table.table_from_prop.translation.y = k * step_m;
            const image::Image8 now = draw(feathered);
            const auto [a, b] = front_edge_of_top();
            const int x = static_cast<int>(0.5 * (a.x + b.x)); // middle of the artifact
            for (int y = static_cast<int>(a.y) - 4; y <= static_cast<int>(a.y) + 4; ++y) {
                most = std::max(most, std::abs(int{now.at(x, y).g} - int{before.at(x, y).g}));
            }
            before = now;
        }
        return most;
    }
    Rig rig;
    TestTable table;
};

TEST_F(EdgeFeather, PixelsChangeGraduallyAsAnEdgeCrosses) {
    const int sharp = max_change(false);
    const int feathered = max_change(true);
    EXPECT_GT(sharp, 25) << "the gains of front and top differ, or nothing is proved";
    EXPECT_LT(feathered, sharp / 3);
}

TEST_F(EdgeFeather, OnlyTheLastPixelOfTheBrighterFaceIsDimmed) {
    const image::Image8 sharp = draw(false);
    const image::Image8 feathered = draw(true);
    ASSERT_FALSE(rig.plan.faces.empty());
    const auto [a, b] = front_edge_of_top();
    int dimmed = 0;
    for (int y = 0; y < sharp.height; ++y) {
        for (int x = 0; x < sharp.width; ++x) {
            const int change = int{feathered.at(x, y).g} - int{sharp.at(x, y).g};
            ASSERT_LE(change, 0) << x << ' ' << y;
            if (std::min(a.x, b.x) + 2 < x && x < std::max(a.x, b.x) - 2 && change < 0) {
                ASSERT_LE(std::abs(y + 0.5 - a.y), 1.0 + 1e-3) << x << ' ' << y;
                ++dimmed;
            }
        }
    }
    EXPECT_GT(dimmed, 0);
}

TEST_F(EdgeFeather, StripsMatchTheGainOfTheNeighbouringFace) {
    draw(true);
    ASSERT_FALSE(rig.plan.feathers.empty());
    for (const frustumscreen::scene::EdgeFeather& feather : rig.plan.feathers) {
        const scene::FacePlan& own = rig.plan.faces[static_cast<std::size_t>(feather.face)];
        for (std::size_t end = 0; end < 2; ++end) {
            const glm::vec4& clip = feather.corners_clip.at(end);
            const glm::dvec2 pixel = (glm::dvec2(clip) * 0.5 + 0.5) * glm::dvec2(320, 200);
            const double share = end == 0 ? feather.share.x : feather.share.y;
            double nearest = 1e9; // to the gain of the closest neighbour
            for (const scene::FacePlan& other : rig.plan.faces) {
                if (&other != &own) {
                    nearest =
                        std::min(nearest, std::abs(share * scene::gain(own.light, table.projector, pixel) -
                                                   scene::gain(other.light, table.projector, pixel)));
                }
            }
            EXPECT_LT(nearest, 1e-4);
        }
    }
}

} // namespace
} // namespace frustumscreen::synthetic
