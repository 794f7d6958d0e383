#include "assets_baked/bake/atlas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frustumscreen::bake {

namespace {

struct Step {
    int x;
    int y; ///< height of the skyline from x to the next step
    int width;
};

/// Finds the lowest place for a rectangle on the skyline; returns the index of its first step, or -1.
int lowest_place(const std::vector<Step>& skyline, const glm::ivec2& size, int atlas_width, int& best_y) {
    int best = -1;
    for (std::size_t first = 0; first < skyline.size(); ++first) {
        if (skyline[first].x + size.x > atlas_width) {
            break;
        }
        int y = 0;
        int covered = 0;
        for (std::size_t k = first; covered < size.x && k < skyline.size(); ++k) {
            y = std::max(y, skyline[k].y);
            covered += skyline[k].width;
        }
        if (best < 0 || y < best_y) {
            best = static_cast<int>(first);
            best_y = y;
        }
    }
    return best;
}

void raise(std::vector<Step>& skyline, int first, const glm::ivec2& size, int y) {
    const auto at = skyline.begin() + first;
    const Step placed{at->x, y + size.y, size.x};
    int remaining = size.x;
    auto last = at;
    while (last != skyline.end() && last->width <= remaining) {
        remaining -= last->width;
        ++last;
    }
    if (last != skyline.end()) {
        last->x += remaining;
        last->width -= remaining;
    }
    skyline.insert(skyline.erase(at, last), placed);
}

} // namespace

AtlasLayout pack_rectangles(const std::vector<glm::ivec2>& sizes) {
    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sizes[a].y > sizes[b].y; });
    double area = 0.0;
    int widest = 1;
    for (const glm::ivec2& size : sizes) {
        area += static_cast<double>(size.x) * size.y;
        widest = std::max(widest, size.x);
    }
    AtlasLayout layout;
    layout.width = std::max(widest, static_cast<int>(std::ceil(std::sqrt(area * 1.08) / 16.0)) * 16);
    layout.corners.resize(sizes.size());
    std::vector<Step> skyline{{0, 0, layout.width}};
    for (const std::size_t k : order) {
        int y = 0;
        const int first = lowest_place(skyline, sizes[k], layout.width, y);
        layout.corners[k] = {skyline[static_cast<std::size_t>(first)].x, y};
        raise(skyline, first, sizes[k], y);
        layout.height = std::max(layout.height, y + sizes[k].y);
    }
    layout.height = std::max(layout.height, 1);
    return layout;
}

} // namespace frustumscreen::bake
