/// What a camera sees where nobody is, pixel by pixel, and which pixels are not like that.
///
/// Model    each pixel has a usual code, a spread, and a share of the projector's light: codes that come to it for each code that comes
///          to the table's own pixels on average, since the table shows how bright the picture on it is. A pixel is foreground where
///          it differs from usual code x gain + share x the table's change by four spreads. The gain is that of the whole picture: a lamp
///          that is dimmed, a camera that exposes longer. The share is learnt by least mean squares.
/// Prop     what has more of the projector's light than a wall can get back is lit directly: the prop, which hides whoever is behind it.
///          It is never foreground, since what moves in its picture no share explains.
/// Learns   within a second at first; then as slowly as daylight changes, and not at all where the caller says that somebody is. Something
///          else that stays the same for ten seconds (a chair, a bag) is background from then on; what passes leaves no trace. Where nearly
///          all has changed at once, such as by a light that is switched, it begins anew.
/// Units    luma codes.
/// Threads  one caller. Allocates nothing once the first frame was seen.
/// Source   Wren, Azarbayejani, Darrell and Pentland, Pfinder, 1997 (one Gaussian a pixel); differs in gain and projector's light.
#pragma once

#include "app/visitor/head_zone.h"
#include "app/visitor/small_frame.h"
#include "firmware_host/base/time.h"

#include <optional>
#include <span>
#include <vector>

namespace frustumscreen {

/// Of a small frame; right and bottom are outside.
struct PixelBox {
    int left = 0, top = 0, right = 0, bottom = 0;
};

class Background {
public:
    static constexpr double daylight_s = 30.0; ///< time constant
    static constexpr double thing_s = 10.0;    ///< that something stays the same
    static constexpr float lit_share = 0.7F;   ///< of the projector's light; more has only the prop
    static constexpr Nanoseconds first_look = std::chrono::seconds(1);

    explicit Background(std::vector<Shows> shows);

    /// 255 where it is foreground, of pixels that can show a head; none while it looks for the first time.
    [[nodiscard]] std::span<const std::uint8_t> find(MonotonicTime time, const SmallFrame& frame);
    /// The frame that was found in last; `people`: where somebody is.
    void learn(const SmallFrame& frame, std::span<const PixelBox> people);
    /// What is foreground there is background from now on.
    void take_in(const SmallFrame& frame, const PixelBox& box);
    /// How often it began, the first time included.
    [[nodiscard]] int beginnings() const { return beginnings_; }

private:
    struct Pixel {
        float usual = 0.0F;
        float variance = 0.0F;
        float share = 0.0F;  ///< of the table's change
        float thing = 0.0F;  ///< how far from usual it is where something hides it
        float held_s = 0.0F; ///< since when it is that far
    };
    void measure_table(const SmallFrame& frame);
    void measure_gain(const SmallFrame& frame);
    void clean(const SmallFrame& frame);
    /// True once it was there for long enough to be background.
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
    float change_square_ = 0.0F; ///< its mean square of late
    int frames_ = 0;             ///< of the first look
    int beginnings_ = 0;
    bool knows_ = false;
};

} // namespace frustumscreen
