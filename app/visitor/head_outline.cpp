#include "app/visitor/head_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace frustumscreen::visitor {

namespace {

constexpr int widest_gap = 2; ///< pixels that noise may remove from a row
constexpr int narrowest = 6;  ///< pixels; a narrower head is too far away to be at the table
constexpr int min_bump = 5;   ///< rows; a lower bump next to a head is hair or an ear

/// Foreground in a row; right is exclusive.
struct Run {
    int left = 0, right = 0;
    std::size_t top = 0; ///< index of the top that it belongs to
};
/// Connected rows below a place without foreground above.
struct Top {
    int row = 0;
    std::vector<Run> runs; ///< one per row
    bool ends = false;     ///< something else is next to it from there on
};

std::vector<Run> runs_of(const std::uint8_t* row, int width) {
    std::vector<Run> runs;
    for (int x = 0; x < width; ++x) {
        if (row[x] == 0) {
            continue;
        }
        if (!runs.empty() && x - runs.back().right <= widest_gap) {
            runs.back().right = x + 1;
        } else {
            runs.push_back({x, x + 1});
        }
    }
    return runs;
}

/// Among the tops above a run, the tallest continues in it. If another one is tall too, both end here.
std::size_t go_on(std::vector<Top>& tops, std::span<const std::size_t> above, const Run& run) {
    const auto rows = [&tops](std::size_t top) { return tops[top].runs.size(); };
    const std::size_t tallest = *std::max_element(
        above.begin(), above.end(), [&](std::size_t a, std::size_t b) { return rows(a) < rows(b); });
    for (const std::size_t other : above) {
        if (other != tallest) {
            tops[tallest].ends = tops[tallest].ends || rows(other) >= min_bump;
            tops[other].ends = true;
        }
    }
    if (!tops[tallest].ends) {
        tops[tallest].runs.push_back(run);
    }
    return tallest;
}

std::vector<Top> tops_of(std::span<const std::uint8_t> foreground, int width, int height) {
    std::vector<Top> tops;
    std::vector<Run> before;
    std::vector<std::size_t> above;
    for (int row = 0; row < height; ++row) {
        std::vector<Run> runs = runs_of(foreground.data() + static_cast<std::ptrdiff_t>(row) * width, width);
        for (Run& run : runs) {
            above.clear();
            for (const Run& other : before) {
                if (other.left < run.right && run.left < other.right) {
                    above.push_back(other.top);
                }
            }
            if (above.empty()) {
                run.top = tops.size();
                tops.push_back({row, {run}});
            } else {
                run.top = go_on(tops, above, run);
            }
        }
        before = std::move(runs);
    }
    return tops;
}

/// The rows from the top to where a head is widest: an ellipse 1.3 times as high as wide is widest 0.65
/// widths below its top, and nearly so from half a width on. nullopt: there is no such row, as for a
/// stretched-out arm or a wall's corner.
std::optional<HeadOutline> outline_of(const Top& top) {
    constexpr double widest_from = 0.5;
    constexpr double used_to = 0.95; // widths below the top; further down chin or hair differ
    double widest = 0.0;
    std::size_t used = 0;
    for (std::size_t k = 0; k < top.runs.size(); ++k) {
        const double depth = static_cast<double>(k) + 0.5;
        const double width = top.runs[k].right - top.runs[k].left;
        if (used == 0) {
            widest = std::fmax(widest, width);
        }
        if (used == 0 && depth >= widest_from * widest) {
            used = static_cast<std::size_t>(used_to * widest);
        }
        if (used > 0 && (k >= used || width > 1.25 * widest + 2.0)) {
            used = k;
            break;
        }
    }
    used = std::min(used, top.runs.size());
    if (widest < narrowest || static_cast<double>(used) < widest_from * widest) {
        return std::nullopt;
    }
    HeadOutline outline{{}, widest};
    for (std::size_t k = 0; k < used; ++k) {
        const double y = top.row + static_cast<double>(k) + 0.5;
        outline.edge.emplace_back(top.runs[k].left, y);
        outline.edge.emplace_back(top.runs[k].right, y);
    }
    return outline;
}

} // namespace

std::vector<HeadOutline> find_head_outlines(std::span<const std::uint8_t> foreground, int width, int height) {
    std::vector<HeadOutline> outlines;
    for (const Top& top : tops_of(foreground, width, height)) {
        if (std::optional<HeadOutline> outline = outline_of(top)) {
            outlines.push_back(std::move(*outline));
        }
    }
    return outlines;
}

} // namespace frustumscreen::visitor
