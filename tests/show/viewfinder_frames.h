/// A camera's frames and their picture in the viewfinder, for tests.
#pragma once

#include "app/show/viewfinder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace frustumscreen::show::viewfinder_frames {

inline constexpr int width = 640, height = 400;                  // of the projector's picture
inline constexpr glm::ivec2 area_px(width / 3, height * 3 / 10); // the largest part of it for a viewfinder

/// A frame whose rows and columns all differ, without code 0.
inline camera::CameraFrame frame_of(int frame_width, int frame_height, std::uint32_t seed) {
    camera::CameraFrame frame{MonotonicTime{}, seed, frame_width, frame_height, {}};
    frame.luma.resize(static_cast<std::size_t>(frame_width * frame_height));
    std::uint32_t state = seed;
    for (std::uint8_t& code : frame.luma) {
        state = state * 1664525U + 1013904223U;
        code = static_cast<std::uint8_t>(1 + (state >> 24U) % 255);
    }
    return frame;
}

using Grey = image::Image<std::uint8_t>;

/// Each pixel's code equals the mean of its square of `turned`, up to rounding; everything around is black.
inline void expect_mean_of(const Grey& turned, int by, const image::Image8& shown) {
    const glm::ivec2 size(turned.width / by, turned.height / by);
    const glm::ivec2 corner((shown.width - size.x) / 2, shown.height - size.y);
    for (int y = 0; y < shown.height; ++y) {
        for (int x = 0; x < shown.width; ++x) {
            const int u = x - corner.x;
            const int v = y - corner.y;
            const glm::u8vec4 code = shown.at(x, y);
            if (u < 0 || v < 0 || u >= size.x || v >= size.y) {
                ASSERT_EQ(code, glm::u8vec4(0, 0, 0, 255));
                continue;
            }
            int sum = 0;
            for (int j = 0; j < by; ++j) {
                for (int i = 0; i < by; ++i) {
                    sum += turned.at(by * u + i, by * v + j);
                }
            }
            ASSERT_LE(2 * std::abs(by * by * code.r - sum), by * by) << x << ' ' << y;
            ASSERT_EQ(code, glm::u8vec4(code.r, code.r, code.r, 255));
        }
    }
}

/// True if the object's own bytes contain the frame; its picture is a part of the object.
inline bool holds(const Viewfinder& viewfinder, const camera::CameraFrame& frame) {
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(&viewfinder);
    return std::search(begin, begin + sizeof(viewfinder), frame.luma.begin(), frame.luma.begin() + 8) !=
           begin + sizeof(viewfinder);
}

} // namespace frustumscreen::show::viewfinder_frames
