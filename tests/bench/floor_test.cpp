#include "app/bench/techniques/floor.h"
#include "app/bench/techniques/peer_gl.h"
#include "app/render/read_back.h"
#include "firmware_host/gl/gl_handle.h"
#include "tests/bench/drawn_near.h"
#include "tests/bench/ring.h"

#include <GLES2/gl2ext.h>
#include <gtest/gtest.h>

#include <array>

namespace frustumscreen::bench {
namespace {

class Floor : public DrawnNear {
protected:
    [[nodiscard]] std::unique_ptr<Technique> floor(FloorFilter filter) const {
        return make_floor(kiosk_, filter).value();
    }
    std::vector<BenchPose> poses_ = draw_poses(kiosk_.settings, kiosk_.prop, 6, 5).value();
    Truth truth_ = Truth::build(ring(), glm::dmat4(1.0)).value();
};

constexpr std::array filters = {FloorFilter::Trilinear, FloorFilter::OneLevel};

/// Averaging in linear light would fail this: black and white would give 188.
TEST_F(Floor, AveragesCodesAndLightsOnlyTheProp) {
    for (const FloorFilter filter : filters) {
        const std::unique_ptr<Technique> technique = floor(filter);
        for (const BenchPose& pose : poses_) {
            technique->draw(pose);
            const image::Image8 drawn =
                render::read_colour(kiosk_.framebuffer, kiosk_.width(), kiosk_.height());
            const TruthPicture truth = ray_cast(truth_, pose);
            double sum = 0.0;
            int lit = 0;
            int beside = 0;
            for (std::size_t k = 0; k < drawn.texels.size(); ++k) {
                const int code = drawn.texels[k].r;
                beside += code != 0 && truth.prop.texels[k] == 0 ? 1 : 0;
                sum += code;
                lit += code != 0 ? 1 : 0;
            }
            EXPECT_LE(beside, 2); // pixel centres on an edge
            ASSERT_GT(lit, 5000);
            EXPECT_NEAR(sum / lit, 127.5, 4.0) << technique->name();
        }
    }
}

TEST_F(Floor, EachVisibleFaceIsTwoTrianglesDrawnOnce) {
    for (const FloorFilter filter : filters) {
        const std::unique_ptr<Technique> technique = floor(filter);
        for (const BenchPose& pose : poses_) {
            GLuint query = 0;
            glGenQueries(1, &query);
            glBeginQuery(GL_PRIMITIVES_GENERATED_EXT, query);
            technique->draw(pose);
            glEndQuery(GL_PRIMITIVES_GENERATED_EXT);
            GLuint triangles = 0;
            glGetQueryObjectuiv(query, GL_QUERY_RESULT, &triangles);
            glDeleteQueries(1, &query);
            EXPECT_EQ(triangles, 2 * peer_view(kiosk_, pose).faces.size());
        }
    }
}

} // namespace
} // namespace frustumscreen::bench
