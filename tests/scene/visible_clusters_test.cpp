#include "app/scene/visible_clusters.h"

#include <gtest/gtest.h>

namespace frustumscreen {
namespace {

PackCluster ball(std::uint32_t first, const glm::vec3& centre, float radius) {
    PackCluster cluster;
    cluster.first_index = first;
    cluster.index_count = 30;
    cluster.centre = centre;
    cluster.radius = radius;
    return cluster;
}

TEST(VisibleClusters, NeighboursAreDrawnWithOneCall) {
    FaceVolume volume;
    volume.add({2.0, 0.0, 0.0, 0.0}); // x >= 0
    const std::vector<PackCluster> clusters{ball(0, {1, 0, 0}, 0.1F), ball(30, {2, 0, 0}, 0.1F),
                                            ball(60, {-1, 0, 0}, 0.1F), ball(90, {-1, 0, 0}, 1.5F)};
    std::vector<IndexRange> ranges{{7, 3}}; // another face's range is not joined on to
    append_visible(volume, clusters, ranges);
    EXPECT_EQ(ranges, (std::vector<IndexRange>{{7, 3}, {0, 60}, {90, 30}}));
}

TEST(VisibleClusters, ATouchingClusterStays) {
    FaceVolume volume;
    volume.add({0.0, 0.0, 4.0, -2.0}); // z >= 0.5
    std::vector<IndexRange> ranges;
    append_visible(volume, std::vector<PackCluster>{ball(0, {0, 0, 0.3F}, 0.2F)}, ranges);
    EXPECT_EQ(ranges.size(), 1U);
    ranges.clear();
    append_visible(volume, std::vector<PackCluster>{ball(0, {0, 0, 0.29F}, 0.2F)}, ranges);
    EXPECT_TRUE(ranges.empty());
}

TEST(VisibleClusters, ABackFacingConeIsLeftOut) {
    PackCluster cluster = ball(0, {0, 0, 0}, 0.1F);
    cluster.cone_axis = {0, 0, 1};
    cluster.cone_cutoff = 0.5F;
    FaceVolume volume;
    std::vector<IndexRange> ranges;
    volume.eye = {0, 0, -2}; // behind: apex - eye runs along the axis
    append_visible(volume, std::vector<PackCluster>{cluster}, ranges);
    EXPECT_TRUE(ranges.empty());
    volume.eye = {0, 0, 2};
    append_visible(volume, std::vector<PackCluster>{cluster}, ranges);
    EXPECT_EQ(ranges.size(), 1U);
}

TEST(VisibleClusters, ADegenerateHalfSpaceHidesNothing) {
    FaceVolume volume;
    volume.add({0.0, 0.0, 0.0, -1.0});
    volume.add({std::nan(""), 0.0, 0.0, -1.0});
    EXPECT_EQ(volume.count, 0U);
}

} // namespace
} // namespace frustumscreen
