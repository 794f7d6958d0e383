// The objects left out of a room's picture, against rays and exact arithmetic.

#include "app/scene/inner_box.h"
#include "app/scene/room_culling.h"
#include "tests/render/interlocked.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace frustumscreen::scene {
namespace {

FlatScreen small_screen() {
    return flat_screen({{{-0.6, 0.7, 0.85}, {0.6, 0.7, 0.85}, {0.6, 0.7, 0.175}, {-0.6, 0.7, 0.175}}}, 160,
                       90);
}

/// A solid box in a frame of its own.
struct Standing {
    glm::dvec3 low{0.0}, high{1.0};
    glm::dmat4 table_from_box{1.0};
    glm::dmat4 box_from_table = glm::inverse(table_from_box);

    [[nodiscard]] BoxCorners corners() const { return corners_of(low, high, table_from_box); }
    /// Where the ray enters it, in its own parameter; slabs.
    [[nodiscard]] std::optional<double> met(const glm::dvec3& from, const glm::dvec3& ray) const {
        const glm::dvec3 eye(box_from_table * glm::dvec4(from, 1.0));
        const glm::dvec3 along(box_from_table * glm::dvec4(ray, 0.0));
        double begin = 0.0;
        double end = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double one = (low[axis] - eye[axis]) / along[axis];
            const double other = (high[axis] - eye[axis]) / along[axis];
            begin = std::max(begin, std::min(one, other));
            end = std::min(end, std::max(one, other));
        }
        return begin <= end ? std::optional(begin) : std::nullopt;
    }
};

class Rooms {
public:
    explicit Rooms(unsigned seed) : random_(seed) {}

    [[nodiscard]] double within(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    [[nodiscard]] Standing standing(double min_m, double max_m) {
        const glm::dvec3 size(within(min_m, max_m), within(min_m, max_m), within(min_m, max_m));
        const glm::dmat4 moved =
            glm::translate(glm::dmat4(1.0), {within(-3.0, 3.0), within(-1.5, 6.0), within(-0.5, 1.5)});
        return {-0.5 * size, 0.5 * size,
                glm::rotate(moved, within(0.0, 6.3),
                            glm::normalize(glm::dvec3(within(-1, 1), within(-1, 1), 1.0)))};
    }
    [[nodiscard]] glm::dvec3 eye() { return {within(-1.5, 1.5), within(-2.5, 0.5), within(0.0, 1.6)}; }

private:
    std::mt19937 random_;
};

TEST(RoomCulling, LeavesOutNothingThatARayMeetsFirst) {
    const FlatScreen screen = small_screen();
    RoomCulling culling(screen);
    std::size_t hidden = 0;
    std::size_t outside = 0;
    for (unsigned pose = 0; pose < 200; ++pose) {
        Rooms rooms(pose);
        std::vector<Standing> objects;
        for (int k = 0; k < 40; ++k) {
            objects.push_back(rooms.standing(k < 8 ? 0.5 : 0.05, k < 8 ? 2.0 : 0.3));
        }
        const glm::dvec3 eye = rooms.eye();
        culling.begin(eye);
        std::vector<bool> left_out(objects.size());
        for (const Standing& object : objects) {
            if (!object.met(eye, {0.0, 0.0, 0.0}) && culling.in_view(object.corners())) {
                culling.add_solid(object.corners());
            }
        }
        for (std::size_t k = 0; k < objects.size(); ++k) {
            const bool seen = culling.in_view(objects[k].corners());
            outside += seen ? 0 : 1;
            hidden += seen && culling.is_hidden(objects[k].corners()) ? 1 : 0;
            left_out[k] = !seen || culling.is_hidden(objects[k].corners());
            const glm::dvec3 middle(objects[k].table_from_box[3]);
            EXPECT_TRUE(!seen ||
                        culling.in_view(middle, 0.5 * glm::distance(objects[k].low, objects[k].high)));
        }
        const auto& corners = screen.surface.corners;
        for (int y = static_cast<int>(pose % 2); y < 90; y += 2) {
            for (int x = static_cast<int>(pose / 2 % 2); x < 160; x += 2) {
                const glm::dvec3 at = corners[3] + (x + 0.5) / 160.0 * (corners[2] - corners[3]) +
                                      (y + 0.5) / 90.0 * (corners[0] - corners[3]);
                double nearest = std::numeric_limits<double>::infinity();
                std::size_t first = objects.size();
                for (std::size_t k = 0; k < objects.size(); ++k) {
                    const std::optional<double> met = objects[k].met(eye, at - eye);
                    if (met && *met < nearest) {
                        nearest = *met;
                        first = k;
                    }
                }
                ASSERT_TRUE(first == objects.size() || !left_out[first])
                    << "pose " << pose << ", object " << first << ", pixel " << x << ", " << y;
            }
        }
    }
    EXPECT_GT(hidden, 200U) << "or the test tries nothing";
    EXPECT_GT(outside, 1000U);
}

TEST(RoomCulling, AWallHidesWhatStandsBehindItAndNothingElse) {
    RoomCulling culling(small_screen());
    const glm::dvec3 eye(0.0, -0.8, 0.7);
    culling.begin(eye);
    const Standing wall{{-5.0, 1.0, -2.0}, {0.0, 1.1, 5.0}, glm::dmat4(1.0)}; // the left half
    culling.add_solid(wall.corners());
    const auto at = [](double x, double y) {
        return Standing{{x - 0.1, y - 0.1, 0.4}, {x + 0.1, y + 0.1, 0.6}, glm::dmat4(1.0)}.corners();
    };
    EXPECT_TRUE(culling.is_hidden(at(-0.4, 2.0)));
    EXPECT_FALSE(culling.is_hidden(at(0.4, 2.0)));
    EXPECT_FALSE(culling.is_hidden(at(0.0, 2.0))) << "across the wall's edge";
    EXPECT_FALSE(culling.is_hidden(at(-0.4, 0.5))) << "before it";
    EXPECT_FALSE(culling.is_hidden(wall.corners())) << "a solid does not hide its own object";
    EXPECT_FALSE(culling.in_view(at(0.0, -2.0))) << "behind the eye";
    EXPECT_FALSE(culling.in_view(at(3.0, 1.0))) << "beside the pyramid";
    EXPECT_TRUE(culling.in_view(at(0.0, 0.2))) << "before the screen";
    culling.begin({0.0, 2.0, 0.7});
    EXPECT_FALSE(culling.in_view(at(0.0, 1.0))) << "an eye behind the screen sees nothing";
}

std::vector<glm::vec3> points_of(const synthetic::Soup& soup) {
    std::vector<glm::vec3> points;
    std::transform(soup.points.begin(), soup.points.end(), std::back_inserter(points),
                   [](const glm::dvec3& point) { return glm::vec3(point); });
    return points;
}

double volume_of(const BoxCorners& box) {
    return std::abs(glm::dot(box[1] - box[0], glm::cross(box[2] - box[0], box[4] - box[0])));
}

TEST(InnerBox, FillsMostOfABoxAtAnyRotation) {
    for (const double turn : {0.0, 15.0, 45.0}) {
        synthetic::Soup soup;
        synthetic::add_box(soup, {-1.0, -0.05, 0.0}, {1.0, 0.05, 0.7});
        const glm::dmat3 turned(glm::rotate(glm::dmat4(1.0), glm::radians(turn), glm::dvec3(0.0, 0.0, 1.0)));
        std::for_each(soup.points.begin(), soup.points.end(),
                      [&](glm::dvec3& point) { point = turned * point; });
        const std::optional<BoxCorners> box = inner_box(points_of(soup), soup.indices);
        ASSERT_TRUE(box) << turn;
        EXPECT_GT(volume_of(*box), 0.75 * 2.0 * 0.1 * 0.7) << turn;
        for (const glm::dvec3& corner : *box) {
            const glm::dvec3 own = glm::transpose(turned) * corner;
            EXPECT_LT(std::abs(own.x), 1.0);
            EXPECT_LT(std::abs(own.y), 0.05);
            EXPECT_GT(own.z, 0.0);
            EXPECT_LT(own.z, 0.7);
        }
    }
}

TEST(InnerBox, LiesInsideTheTubeOfARing) {
    const synthetic::Soup soup = synthetic::torus(1.0, 0.4);
    const std::optional<BoxCorners> box = inner_box(points_of(soup), soup.indices);
    ASSERT_TRUE(box);
    Rooms random(7);
    for (int k = 0; k < 1000; ++k) {
        const glm::dvec3 share(random.within(0, 1), random.within(0, 1), random.within(0, 1));
        const glm::dvec3 at = (*box)[0] + share.x * ((*box)[1] - (*box)[0]) +
                              share.y * ((*box)[2] - (*box)[0]) + share.z * ((*box)[4] - (*box)[0]);
        EXPECT_LT(std::hypot(std::hypot(at.x, at.y) - 1.0, at.z), 0.4) << "in the hole, or outside";
    }
}

TEST(InnerBox, LiesInTheFloorOfAHollowSolid) {
    synthetic::Soup soup;
    synthetic::add_box(soup, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    synthetic::Soup cavity;
    synthetic::add_box(cavity, {0.1, 0.1, 0.2}, {0.9, 0.9, 0.9});
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), cavity.points.begin(), cavity.points.end());
    for (std::size_t k = 0; k < cavity.indices.size(); k += 3) { // seen from inside
        soup.indices.insert(soup.indices.end(), {first + cavity.indices[k], first + cavity.indices[k + 2],
                                                 first + cavity.indices[k + 1]});
    }
    const std::optional<BoxCorners> box = inner_box(points_of(soup), soup.indices);
    ASSERT_TRUE(box);
    for (const glm::dvec3& corner : *box) {
        EXPECT_LT(corner.z, 0.2) << "the floor is the thickest";
    }
}

TEST(InnerBox, IsMissingForOpenOrInvertedMeshes) {
    synthetic::Soup soup;
    synthetic::add_box(soup, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    std::vector<std::uint32_t> open(soup.indices.begin(), soup.indices.end() - 3);
    EXPECT_FALSE(inner_box(points_of(soup), open));
    std::reverse(soup.indices.begin(), soup.indices.end());
    EXPECT_FALSE(inner_box(points_of(soup), soup.indices));
    EXPECT_FALSE(inner_box({}, {}));
}

} // namespace
} // namespace frustumscreen::scene
