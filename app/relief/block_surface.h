/// How eight rays meet one block's surface.
///
/// Frames   the block's own corner in its direction's grid; cells.
/// Method   Newton's steps from the block's plane, or a march through its slab (block_items.h decides).
/// Threads  pure; any. Inlined into one function for each instruction set; other files have no use for it than cast_blocks.cpp.
#pragma once

#include "app/relief/block_relief.h"
#include "app/relief/lanes.h"

#include <algorithm>
#include <bit>

namespace frustumscreen {

/// The eight rays of a tile from one block's corner, in its grid: the eye at (u, v), the height of the eye above the block's plane,
/// and what each ray adds to them.
struct Rays {
    Floats du, dv;
    Floats fall; ///< what the height above the plane changes by along the ray
    float u, v, height;
};

/// A block, ready for its tiles.
struct Surface {
    const std::uint32_t* codes;
    Ints mask_low, mask_high;
    Floats low, step;
    bool full;                   ///< every cell is there, and whole
    std::uint64_t cut;           ///< cells
    const std::uint64_t* covers; ///< of these
};

struct Local {
    Floats u, v;
};

FRUSTUMSCREEN_INLINE Local place_on(const Rays& rays, Floats t) {
    return {rays.u + t * rays.du, rays.v + t * rays.dv};
}

constexpr float last_cell = block_cells - 0.0005F;

/// The residual at a place, and what it changes by along the ray.
struct Residual {
    Floats value, along;
};

FRUSTUMSCREEN_INLINE Residual residual_at(const Surface& surface, const Rays& rays, Local at) {
    const Floats u = least(most(at.u, Floats{}), all(last_cell));
    const Floats v = least(most(at.v, Floats{}), all(last_cell));
    const Ints column = __builtin_convertvector(u, Ints);
    const Ints row = __builtin_convertvector(v, Ints);
    const Floats fu = u - __builtin_convertvector(column, Floats);
    const Floats fv = v - __builtin_convertvector(row, Floats);
    const Ints cell = row * block_cells + column;
    Ints codes;
    for (int lane = 0; lane < lanes; ++lane) {
        codes[lane] = static_cast<std::int32_t>(surface.codes[cell[lane]]);
    }
    const Floats a = __builtin_convertvector(codes & 255, Floats);
    const Floats b = __builtin_convertvector((codes >> 8) & 255, Floats);
    const Floats c = __builtin_convertvector((codes >> 16) & 255, Floats);
    const Floats d = __builtin_convertvector((codes >> 24) & 255, Floats);
    const Floats low_slope = b - a;
    const Floats high_slope = d - c;
    const Floats low = a + fu * low_slope;
    const Floats rise = c + fu * high_slope - low;
    return {surface.low + surface.step * (low + fv * rise),
            surface.step * ((low_slope + fv * (high_slope - low_slope)) * rays.du + rise * rays.dv)};
}

/// Whether a cut cell has something at the place.
FRUSTUMSCREEN_INLINE bool is_covered(const Surface& surface, int cell, float u, float v) {
    const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(cell);
    if ((surface.cut & bit) == 0) {
        return true;
    }
    const std::uint64_t cover = surface.covers[std::popcount(surface.cut & (bit - 1))];
    const int column = static_cast<int>(8.0F * u) & 7;
    const int row = static_cast<int>(8.0F * v) & 7;
    return (cover >> static_cast<unsigned>(8 * row + column) & 1U) != 0;
}

/// Whether the place is in a cell that is there. A hit on a seam may land a little beside both.
FRUSTUMSCREEN_INLINE Ints in_cells(const Surface& surface, Local at) {
    constexpr float seam = 0.04F; // cells
    const Ints within =
        (at.u >= -seam) & (at.u <= block_cells + seam) & (at.v >= -seam) & (at.v <= block_cells + seam);
    if (surface.full) {
        return within;
    }
    const Floats u = least(most(at.u, Floats{}), all(last_cell));
    const Floats v = least(most(at.v, Floats{}), all(last_cell));
    const Ints column = __builtin_convertvector(u, Ints);
    const Ints row = __builtin_convertvector(v, Ints);
    const Ints word = row > 3 ? surface.mask_high : surface.mask_low;
    const Ints bit = (word >> ((row & 3) * block_cells + column)) & 1;
    Ints in = within & (bit != 0);
    if (surface.cut != 0) {
        const Ints cell = row * block_cells + column;
        for (int lane = 0; lane < lanes; ++lane) {
            in[lane] = in[lane] != 0 && is_covered(surface, cell[lane], u[lane], v[lane]) ? -1 : 0;
        }
    }
    return in;
}

struct Meeting {
    Floats t;
    Ints met;
};

/// From where the rays meet the block's plane.
FRUSTUMSCREEN_INLINE Meeting by_newton(const Surface& surface, const Rays& rays, Floats t, Ints live,
                                       int steps) {
    for (int k = 0; k < steps; ++k) {
        const Residual residual = residual_at(surface, rays, place_on(rays, t));
        t -= (rays.height + t * rays.fall - residual.value) / (rays.fall - residual.along);
    }
    return {t, live & in_cells(surface, place_on(rays, t))};
}

FRUSTUMSCREEN_INLINE Floats height_at(const Surface& surface, const Rays& rays, Floats t) {
    return rays.height + t * rays.fall - residual_at(surface, rays, place_on(rays, t)).value;
}

/// A piece of a ray, and the heights above the surface at its ends.
struct Step {
    Floats begin, end;
    Floats above, below;
};

/// Takes what goes in on the step, in cells that are there.
FRUSTUMSCREEN_INLINE void take_crossings(Meeting& meeting, Ints& live, const Surface& surface,
                                         const Rays& rays, const Step& step) {
    Ints crosses = live & (step.above >= 0.0F) & (step.below < 0.0F);
    if (any(crosses)) {
        const Floats at = step.begin + (step.end - step.begin) * (step.above / (step.above - step.below));
        crosses &= in_cells(surface, place_on(rays, at));
        meeting.t = crosses ? at : meeting.t;
        meeting.met |= crosses;
        live &= ~crosses;
    }
}

/// Where three heights, a step apart, say that the ray dips lowest between them: in steps from the middle one, and how low.
struct Dip {
    Floats at;
    Ints deep; ///< it may touch the surface
};

FRUSTUMSCREEN_INLINE Dip dip_of(Floats before, Floats here, Floats after) {
    constexpr float near = 0.03F; // texels: the surface is not a parabola
    const Floats at = 0.5F * (before - after) / (before - 2.0F * here + after);
    return {at, (here > 0.0F) & (here <= before) & (here < after) &
                    (here - 0.25F * (before - after) * at < near)};
}

/// In steps of about two thirds of a cell from `t` to `end`; the first crossing inwards in a cell that is there. A ray that grazes the surface may
/// go in and out within one step: where it dips, it is looked at once more.
FRUSTUMSCREEN_INLINE Meeting by_march(const Surface& surface, const Rays& rays, Floats t, Floats end,
                                      Ints live) {
    const Floats across = (end - t) * most(most(rays.du, -rays.du), most(rays.dv, -rays.dv));
    float longest = 0.0F;
    for (int lane = 0; lane < lanes; ++lane) {
        longest = live[lane] != 0 ? std::max(longest, across[lane]) : longest;
    }
    constexpr int most_steps = 32;
    const int steps = std::min(most_steps, 1 + static_cast<int>(1.6F * longest));
    const Floats step = (end - t) / static_cast<float>(steps);
    Meeting meeting{t, Ints{}};
    Floats before{};
    Floats here = height_at(surface, rays, t);
    for (int k = 0; k < steps && any(live); ++k) {
        const Floats next = t + step;
        const Floats after = height_at(surface, rays, next);
        const Dip dip = dip_of(before, here, after);
        if (k > 0 && any(live & dip.deep)) {
            const Floats lowest = t + step * dip.at;
            const Ints early = dip.at < 0.0F;
            Ints dips = live & dip.deep;
            const Ints others = live & ~dip.deep;
            take_crossings(
                meeting, dips, surface, rays,
                {early ? t - step : t, lowest, early ? before : here, height_at(surface, rays, lowest)});
            live = dips | others;
        }
        take_crossings(meeting, live, surface, rays, {t, next, here, after});
        t = next;
        before = here;
        here = after;
    }
    return meeting;
}

FRUSTUMSCREEN_INLINE void narrow(Floats& begin, Floats& end, Floats rate, float low, float high) {
    const Floats a = low / rate;
    const Floats b = high / rate;
    begin = most(begin, least(a, b));
    end = least(end, most(a, b));
}

} // namespace frustumscreen
