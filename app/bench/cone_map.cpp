#include "app/bench/cone_map.h"

#include "firmware_host/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace frustumscreen {

namespace {

constexpr float codes = 65535.0F;

/// Least depths: level 0 the image, each next half as wide.
std::vector<Image16> highest_of(const Image16& depth) {
    std::vector<Image16> levels{depth};
    while (levels.back().width > 1) {
        const Image16& fine = levels.back();
        Image16 coarse(fine.width / 2, fine.height / 2);
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

/// One texel's cone, narrowed by what the pyramid's nodes hold.
class ConeSearch {
public:
    ConeSearch(const std::vector<Image16>& levels, bool relaxed) : levels_(levels), relaxed_(relaxed) {}

    [[nodiscard]] std::uint16_t ratio(int x, int y) {
        x_ = x;
        y_ = y;
        depth_ = levels_[0].at(x, y);
        square_ = 1.0F;
        visit(static_cast<int>(levels_.size()) - 1, 0, 0);
        return static_cast<std::uint16_t>(std::floor(std::sqrt(square_) * codes));
    }

private:
    /// Squared ratio of a cone that just reaches `depth` at `distance` texels squared.
    [[nodiscard]] float square_at(float distance, int depth) const {
        const float height =
            static_cast<float>(depth_ - depth) / codes * static_cast<float>(levels_[0].width);
        return distance / (height * height);
    }

    void visit(int level, int x, int y) { // NOLINT(misc-no-recursion)
        const int depth = levels_[static_cast<std::size_t>(level)].at(x, y);
        if (depth >= depth_) {
            return;
        }
        const int left = x << level;
        const int top = y << level;
        const int side = (1 << level) - 1;
        const int across = std::max({left - x_, x_ - left - side, 0});
        const int down = std::max({top - y_, y_ - top - side, 0});
        const float square = square_at(static_cast<float>(across * across + down * down), depth);
        if (square >= square_) {
            return;
        }
        if (level == 0) {
            if (!relaxed_ || falls_behind(x, y)) {
                square_ = square;
            }
            return;
        }
        const int half = 1 << (level - 1);
        const int near_x = x_ >= left + half ? 1 : 0; // the nearest child first
        const int near_y = y_ >= top + half ? 1 : 0;
        visit(level - 1, 2 * x + near_x, 2 * y + near_y);
        visit(level - 1, 2 * x + 1 - near_x, 2 * y + near_y);
        visit(level - 1, 2 * x + near_x, 2 * y + 1 - near_y);
        visit(level - 1, 2 * x + 1 - near_x, 2 * y + 1 - near_y);
    }

    /// One texel further out on the line from the axis the surface is lower, or the image ends.
    [[nodiscard]] bool falls_behind(int x, int y) const {
        const float across = static_cast<float>(x - x_);
        const float down = static_cast<float>(y - y_);
        const float longer = std::max(std::abs(across), std::abs(down));
        const int u = x + static_cast<int>(std::lround(across / longer));
        const int v = y + static_cast<int>(std::lround(down / longer));
        const Image16& depth = levels_[0];
        return u < 0 || v < 0 || u >= depth.width || v >= depth.height || depth.at(u, v) > depth.at(x, y);
    }

    const std::vector<Image16>& levels_;
    bool relaxed_;
    int x_ = 0;
    int y_ = 0;
    int depth_ = 0;
    float square_ = 1.0F; ///< of the ratio so far
};

Image16 cones(const Image16& depth, bool relaxed) {
    const std::vector<Image16> levels = highest_of(depth);
    Image16 ratios(depth.width, depth.height);
    parallel_for(static_cast<std::size_t>(depth.height), 4, [&](std::size_t begin, std::size_t end) {
        ConeSearch search(levels, relaxed);
        for (std::size_t y = begin; y < end; ++y) {
            for (int x = 0; x < depth.width; ++x) {
                ratios.at(x, static_cast<int>(y)) = search.ratio(x, static_cast<int>(y));
            }
        }
    });
    return ratios;
}

} // namespace

Image16 empty_cones(const Image16& depth) {
    return cones(depth, false);
}
Image16 relaxed_cones(const Image16& depth) {
    return cones(depth, true);
}

} // namespace frustumscreen
