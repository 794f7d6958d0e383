/// A camera's view without visitors, pixel by pixel, and the pixels that differ from it.
///
/// Model    each pixel has a usual code, a spread, and a share of the projector's light: its change in codes
///          per code of the mean change of the table's own pixels, which show the brightness of the picture
///          on the table. A pixel is foreground if it differs from usual code x gain + share x the table's
///          change by four spreads. The gain is that of the whole picture: a dimmed lamp, a longer exposure.
///          The share is learnt by least mean squares.
/// Prop     pixels with a larger share than a wall can reflect are lit directly: the prop, which hides
///          persons behind it. They are never foreground, since no share explains the movements in its
///          picture.
/// Learns   within a second at first; then as slowly as daylight changes, and not at all where the caller
///          reports a person. Another object that stays unchanged for ten seconds (a chair, a bag) becomes
///          background; passing objects leave no trace. If nearly all pixels change at once, for example by
///          switching a light, learning restarts.
/// Units    luma codes.
/// Threads  one caller. Allocates nothing after the first frame.
/// Source   Wren, Azarbayejani, Darrell and Pentland, Pfinder, 1997 (one Gaussian per pixel); differs in the
///          gain and the projector's light.
#pragma once

#include "app/visitor/head_zone.h"
#include "app/visitor/small_frame.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen::visitor {

/// A box in a small frame; right and bottom are exclusive.
struct PixelBox {
    int left = 0, top = 0, right = 0, bottom = 0;
};

class Background {
public:
    static constexpr double daylight_s = 30.0; ///< time constant
    static constexpr double thing_s = 10.0;    ///< after which an unchanged object becomes background
    static constexpr float lit_share = 0.7F;   ///< of the projector's light; only the prop has more
    static constexpr Nanoseconds first_look = std::chrono::seconds(1);

    explicit Background(std::vector<Shows> shows);

    /// 255 for foreground, for pixels that can show a head; no foreground during the first look.
    [[nodiscard]] std::span<const std::uint8_t> find(MonotonicTime time, const SmallFrame& frame);
    /// Learns from the last frame passed to `find`; `people`: boxes of persons.
    void learn(const SmallFrame& frame, std::span<const PixelBox> people);
    /// Makes the foreground in `box` background from now on.
    void take_in(const SmallFrame& frame, const PixelBox& box);
    /// Number of starts, the first one included.
    [[nodiscard]] int beginnings() const { return beginnings_; }

private:
    struct Pixel {
        float usual = 0.0F;
        float variance = 0.0F;
        float share = 0.0F;  ///< of the table's change
        float thing = 0.0F;  ///< difference of an object that hides the background
        float held_s = 0.0F; ///< time for which the object has been unchanged
    };
    void measure_table(const SmallFrame& frame);
    void measure_gain(const SmallFrame& frame);
    void clean(const SmallFrame& frame);
    /// Returns true once the object was there for long enough to become background.
    [[nodiscard]] bool hold(Pixel& pixel, float error) const;
    void begin(MonotonicTime time);
    [[nodiscard]] float off(std::size_t at, float luma) const {
        return luma - gain_ * model_[at].usual - model_[at].share * change_;
    }

    std::vector<Shows> shows_;
    std::vector<std::uint32_t> heads_, table_; ///< indices of pixels
    std::vector<Pixel> model_;
    std::vector<std::uint8_t> raw_, foreground_, occupied_;
    std::vector<float> ratios_;
    std::optional<MonotonicTime> begun_, last_;
    std::optional<MonotonicTime> all_changed_since_;
    double dt_s_ = 0.0;
    float gain_ = 1.0F;
    float table_usual_ = 0.0F;
    float change_ = 0.0F;        ///< of the table's mean from its usual one
    float change_square_ = 0.0F; ///< recent mean of its square
    int frames_ = 0;             ///< of the first look
    int beginnings_ = 0;
    bool knows_ = false;
};

} // namespace frustumscreen::visitor
