/// Where in a camera's picture a mark of light lies that the projector shows for a moment: from the mean of frames with it, less the
/// mean of those before and after. Where the picture changed by itself meanwhile (a hand, a shadow) nothing is found.
///
/// Frame    pixels of the camera, the centre of the top left one is (0.5, 0.5).
/// Units    luma codes; differences of them.
/// Threads  one caller: the camera's own thread. Sums are made at the first frame of a size and kept.
/// Errors   none: nothing is found.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

/// A rectangle of pixels: columns and rows [low, high).
struct PixelWindow {
    glm::ivec2 low{0}, high{0};
};

struct FoundMark {
    glm::dvec2 pixel{0.0};  ///< its centre of light
    double height = 0.0;    ///< codes above what is around it
    double radius_px = 0.0; ///< within which it is brighter than half of that
};

enum class MarkPhase : std::uint8_t { Before, Lit, After };

class MarkFinder {
public:
    static constexpr int most_frames = 250; ///< in a phase; more are left out

    /// Forgets the frames of the mark before.
    void begin() { counts_ = {}; }
    /// Those that were dark after the mark before are dark before the next one.
    void begin_after_mark();
    /// `luma[height][width]`; a frame of another size than the phase's first is left out.
    void add(MarkPhase phase, std::span<const std::uint8_t> luma, int width, int height);
    /// In the whole picture, or near where it was. Nothing: it is not seen, or something else changed there.
    [[nodiscard]] std::optional<FoundMark> find(const std::optional<PixelWindow>& near);
    /// The mean of the frames before the mark, for what else lies on the table; empty: there are none.
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
    // Of a window, row by row:
    std::vector<float> light_, change_, means_, change_means_;
    std::vector<float> rows_, room_;
    std::vector<std::uint8_t> taken_;
    std::vector<std::size_t> part_; ///< the mark's pixels
};

} // namespace frustumscreen
