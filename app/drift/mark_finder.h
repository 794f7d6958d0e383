/// Finds a drift mark in a camera's picture: from the mean of the frames with the mark, minus the mean of
/// those before and after. If the picture itself changed meanwhile (a hand, a shadow), nothing is found.
///
/// Frame    pixels of the camera; the centre of the top left one is (0.5, 0.5).
/// Units    luma codes, and differences of them.
/// Threads  one caller: the camera's own thread. The sums are allocated at the first frame of a size and
///          kept.
/// Errors   none: nothing is found.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::drift {

/// A rectangle of pixels: columns and rows [low, high).
struct PixelWindow {
    glm::ivec2 low{0}, high{0};
};

struct FoundMark {
    glm::dvec2 pixel{0.0};  ///< its centroid of light
    double height = 0.0;    ///< codes above the surroundings
    double radius_px = 0.0; ///< of the area brighter than half of that
};

enum class MarkPhase : std::uint8_t { Before, Lit, After };

class MarkFinder {
public:
    static constexpr int max_frames = 250; ///< per phase; further frames are ignored

    /// Forgets the frames of the previous mark.
    void begin() { counts_ = {}; }
    /// The dark frames after the previous mark become those before the next one.
    void begin_after_mark();
    /// `luma[height][width]`; a frame of another size than the phase's first is ignored.
    void add(MarkPhase phase, std::span<const std::uint8_t> luma, int width, int height);
    /// Searches the whole picture, or near the last place. nullopt: the mark is not seen, or something else
    /// changed there.
    [[nodiscard]] std::optional<FoundMark> find(const std::optional<PixelWindow>& near);
    /// The mean of the frames before the mark, to find tags in; empty: there are none.
    void dark_picture(std::vector<std::uint8_t>& luma) const;
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

private:
    void take_difference(const PixelWindow& window);
    [[nodiscard]] bool gather(std::size_t peak, const glm::ivec2& size);
    [[nodiscard]] std::optional<FoundMark> measure(std::size_t peak, const glm::ivec2& size);

    struct Counts {
        int before = 0, lit = 0, after = 0;
    };
    int width_ = 0, height_ = 0;
    Counts counts_;
    std::vector<std::uint16_t> before_, lit_, after_; ///< sums of frames
    // Values of a window, row by row:
    std::vector<float> light_, change_, means_, change_means_;
    std::vector<float> rows_, scratch_;
    std::vector<std::uint8_t> taken_;
    std::vector<std::size_t> part_; ///< the mark's pixels
};

} // namespace frustumscreen::drift
