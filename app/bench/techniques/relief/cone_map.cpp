#include "app/bench/techniques/relief/cone_map.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace frustumscreen::bench {

namespace {

constexpr float codes = 65535.0F;
constexpr std::uint16_t no_crest = 65535;

/// Smallest depths: level 0 is the image, each next level half as wide.
using Pyramid = std::vector<image::Image16>;

Pyramid highest_of(image::Image16 depth) {
    Pyramid levels;
    levels.push_back(std::move(depth));
    while (levels.back().width > 1) {
        const image::Image16& fine = levels.back();
        image::Image16 coarse(fine.width / 2, fine.height / 2);
        for (int y = 0; y < coarse.height; ++y) {
            for (int x = 0; x < coarse.width; ++x) {
                coarse.at(x, y) = std::min({fine.at(2 * x, 2 * y), fine.at(2 * x + 1, 2 * y),
                                            fine.at(2 * x, 2 * y + 1), fine.at(2 * x + 1, 2 * y + 1)});
            }
        }
        levels.push_back(std::move(coarse));
    }
    return levels;
}

/// The neighbour in the direction of a line from the axis to an offset: each of x and y is -1, 0 or 1.
glm::ivec2 onward(const glm::ivec2& offset) {
    const glm::ivec2 size = glm::abs(offset);
    const int longer = std::max(size.x, size.y);
    return {2 * size.x >= longer ? glm::sign(offset.x) : 0, 2 * size.y >= longer ? glm::sign(offset.y) : 0};
}

/// Index of one of nine pyramids; (0, 0) has all texels.
std::size_t pyramid_of(const glm::ivec2& direction) {
    return 3 * static_cast<std::size_t>(direction.y + 1) + static_cast<std::size_t>(direction.x + 1);
}
constexpr std::size_t all_texels = 4;

/// Keeps only texels behind which, in `direction`, the surface falls or the image ends; the others move to
/// the bottom.
image::Image16 crests(const image::Image16& depth, const glm::ivec2& direction) {
    image::Image16 result = depth;
    for (int y = 0; y < depth.height; ++y) {
        for (int x = 0; x < depth.width; ++x) {
            const int u = x + direction.x;
            const int v = y + direction.y;
            const bool in_image = u >= 0 && v >= 0 && u < depth.width && v < depth.height;
            if (in_image && depth.at(u, v) <= depth.at(x, y)) {
                result.at(x, y) = no_crest;
            }
        }
    }
    return result;
}

/// Computes one texel's cone, narrowed by the pyramids' nodes.
class ConeSearch {
public:
    /// `pyramids`: all texels, and for a relaxed cone the crests of each direction.
    explicit ConeSearch(const std::array<Pyramid, 9>& pyramids) : pyramids_(pyramids) {}

    [[nodiscard]] std::uint16_t ratio(int x, int y) {
        at_ = {x, y};
        depth_ = pyramids_[all_texels][0].at(x, y);
        square_ = 1.0F;
        visit(static_cast<int>(pyramids_[all_texels].size()) - 1, {0, 0});
        return static_cast<std::uint16_t>(std::floor(std::sqrt(square_) * codes));
    }

private:
    /// Squared ratio of the cone that just reaches a point at offset `off` and this depth.
    [[nodiscard]] float square_at(const glm::ivec2& off, int depth) const {
        const float texels = static_cast<float>(pyramids_[all_texels][0].width);
        const float height = static_cast<float>(depth_ - depth) / codes * texels;
        return static_cast<float>(off.x * off.x + off.y * off.y) / (height * height);
    }
    [[nodiscard]] bool narrows(std::size_t pyramid, int level, const glm::ivec2& node,
                               const glm::ivec2& off) const {
        const int depth = pyramids_[pyramid][static_cast<std::size_t>(level)].at(node.x, node.y);
        return depth < depth_ && square_at(off, depth) < square_;
    }

    void visit(int level, const glm::ivec2& node) {       // NOLINT(misc-no-recursion)
        const glm::ivec2 low = node * (1 << level) - at_; // offsets of the node's first and last texel
        const glm::ivec2 high = low + (1 << level) - 1;
        const glm::ivec2 off = glm::max(glm::max(low, -high), 0);
        if (!narrows(all_texels, level, node, off)) {
            return;
        }
        // A node that lies entirely in one direction can narrow the cone only by that direction's crests.
        const glm::ivec2 direction = onward(low);
        if (!pyramids_[0].empty() && direction == onward(high) && direction == onward({low.x, high.y}) &&
            direction == onward({high.x, low.y}) && !narrows(pyramid_of(direction), level, node, off)) {
            return;
        }
        if (level == 0) {
            square_ = square_at(off, pyramids_[all_texels][0].at(node.x, node.y));
            return;
        }
        const int half = 1 << (level - 1);
        const glm::ivec2 first = 2 * node;
        const glm::ivec2 near(low.x + half <= 0 ? 1 : 0, low.y + half <= 0 ? 1 : 0); // this child first
        visit(level - 1, first + near);
        visit(level - 1, first + glm::ivec2(1 - near.x, near.y));
        visit(level - 1, first + glm::ivec2(near.x, 1 - near.y));
        visit(level - 1, first + 1 - near);
    }

    const std::array<Pyramid, 9>& pyramids_;
    glm::ivec2 at_{0};
    int depth_ = 0;
    float square_ = 1.0F; ///< of the ratio so far
};

image::Image16 cones(const image::Image16& depth, bool relaxed) {
    std::array<Pyramid, 9> pyramids;
    for (int k = 0; k < 9; ++k) {
        const glm::ivec2 direction(k % 3 - 1, k / 3 - 1);
        if (pyramid_of(direction) == all_texels) {
            pyramids[all_texels] = highest_of(depth);
        } else if (relaxed) {
            pyramids[pyramid_of(direction)] = highest_of(crests(depth, direction));
        }
    }
    image::Image16 ratios(depth.width, depth.height);
    parallel_for(static_cast<std::size_t>(depth.height), 4, [&](std::size_t begin, std::size_t end) {
        ConeSearch search(pyramids);
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < depth.width; ++x) {
                ratios.at(x, static_cast<int>(y)) = search.ratio(x, static_cast<int>(y));
            }
        }
    });
    return ratios;
}

} // namespace

image::Image16 empty_cones(const image::Image16& depth) {
    return cones(depth, false);
}
image::Image16 relaxed_cones(const image::Image16& depth) {
    return cones(depth, true);
}

} // namespace frustumscreen::bench
