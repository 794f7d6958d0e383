/// Chooses a connector and a mode from the connectors that a graphics card reports.
///
/// Stereo   for two eyes' pictures in one, the mode of the same timing that tells the projector so (HDMI's 3D) comes before
///          the plain one; without stereo none of HDMI's 3D modes is ever chosen. Frame packing, two whole pictures in one
///          frame, is not used: no layout has a picture of its height.
/// Units    pixels, lines, kilohertz, hertz.
/// Threads  values; any.
/// Source   struct drm_mode_modeinfo of the kernel's KMS; VESA CVT 1.2 for timings made here; CTA-861 for the
///          two that digital projectors expect exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace frustumscreen::display {

/// One mode's timing; the fields have the kernel's meaning.
struct ModeTiming {
    std::uint32_t clock_khz = 0;
    std::uint16_t width = 0;
    std::uint16_t hsync_start = 0;
    std::uint16_t hsync_end = 0;
    std::uint16_t htotal = 0;
    std::uint16_t hskew = 0;
    std::uint16_t height = 0;
    std::uint16_t vsync_start = 0;
    std::uint16_t vsync_end = 0;
    std::uint16_t vtotal = 0;
    std::uint16_t vscan = 0;
    std::uint32_t flags = 0;
    bool preferred = false;

    [[nodiscard]] bool operator==(const ModeTiming&) const = default;
};
inline constexpr std::uint32_t mode_hsync_positive = 1U << 0U;
inline constexpr std::uint32_t mode_hsync_negative = 1U << 1U;
inline constexpr std::uint32_t mode_vsync_positive = 1U << 2U;
inline constexpr std::uint32_t mode_vsync_negative = 1U << 3U;
inline constexpr std::uint32_t mode_interlaced = 1U << 4U;
inline constexpr std::uint32_t mode_doublescan = 1U << 5U;
inline constexpr std::uint32_t mode_stereo = 0x1FU << 14U; ///< mask of HDMI's 3D layouts; 0: a plain mode
inline constexpr std::uint32_t mode_top_bottom = 7U << 14U;
inline constexpr std::uint32_t mode_side_by_side = 8U << 14U; ///< each half has half of the columns

/// Pictures a second; 0 for an invalid timing.
[[nodiscard]] double refresh_hz(const ModeTiming& mode);

enum class Plugged : std::uint8_t { No, Yes, Unknown };

struct ConnectorSeen {
    std::uint32_t id = 0;
    std::string name; ///< the kernel's name, such as "HDMI-A-1"
    Plugged plugged = Plugged::No;
    bool built_in = false; ///< a panel of the machine itself
    bool link_bad = false; ///< the kernel asks for the mode to be set again
    std::vector<ModeTiming> modes;

    [[nodiscard]] bool operator==(const ConnectorSeen&) const = default;
};

/// Back: the card was gone and has returned. Elsewhere: no output can be lit, and another card has a
/// projector. Both require a restart of the program.
enum class CardState : std::uint8_t { There, Gone, Back, Elsewhere };

struct CardSeen {
    CardState state = CardState::There;
    std::vector<ConnectorSeen> connectors;

    [[nodiscard]] bool operator==(const CardSeen&) const = default;
};

/// Contents of the exhibit's picture.
enum class EyeLayout : std::uint8_t {
    One,        ///< one picture for both eyes, or two that differ in colour
    SideBySide, ///< the left eye's picture in the left half, the right eye's in the right half
    TopBottom,  ///< the left eye's picture in the upper half, the right eye's in the lower half
    InTurn, ///< two pictures of the screen's size, the left eye's above the right eye's; a refresh shows one of them
};
/// Pictures of the screen's size in the exhibit's picture, above each other.
[[nodiscard]] constexpr int stacked(EyeLayout eyes) {
    return eyes == EyeLayout::InTurn ? 2 : 1;
}
/// Below this rate, one picture for each eye in turn flickers.
inline constexpr double min_in_turn_hz = 100.0;

/// The settings of the output.
struct OutputRequest {
    std::string connector; ///< empty = any that has a projector
    int width = 0;         ///< of the mode; 0 = the picture's, otherwise the projector's preferred one
    int height = 0;
    double refresh_hz = 0.0; ///< 0 = any
    bool force = false;      ///< use the mode even if the projector does not list it, and light the named
                             ///< connector even if it reports that nothing is connected
    int picture_width = 0;   ///< on the screen; the nearest size wins if nothing else decides; 0 = any
    int picture_height = 0;
    double picture_hz = 60.0; ///< of the screen
    EyeLayout eyes = EyeLayout::One;
    bool fast = false; ///< without a requested mode, one of at least `min_in_turn_hz` goes before all others
};

/// Whether this connector is lit by force although it reports that nothing is connected.
[[nodiscard]] bool is_lit_blindly(const ConnectorSeen& connector, const OutputRequest& request);

/// The connector to light; nullptr: no projector is there. Preference: certainly connected before unknown,
/// then external before a built-in panel, then the first.
[[nodiscard]] const ConnectorSeen* choose_connector(const CardSeen& card, const OutputRequest& request);

/// Ranks the cards of a machine: the lowest rank wins; among equals, the first.
enum class CardRank : std::uint8_t { Projector, Panel, NothingCertain, WithoutTheConnectorNamed };
[[nodiscard]] CardRank rank_of(const CardSeen& card, const OutputRequest& request);

/// The modes to try, best first: the requested one; without a request, those of the picture's own size, then
/// the preferred one; then the rest by nearness. Before each, its twin in HDMI's 3D, if the request's layout has one.
[[nodiscard]] std::vector<ModeTiming> modes_to_try(const ConnectorSeen& connector,
                                                   const OutputRequest& request);

/// Whether `mode` satisfies the request.
[[nodiscard]] bool fulfils(const ModeTiming& mode, const OutputRequest& request);

/// Makes a timing that the projector's EDID lacks; its clock is 0 if none can be made.
[[nodiscard]] ModeTiming make_mode(int width, int height, double refresh_hz);

/// Adds commonly accepted modes to each connected projector that lists none because its EDID is missing.
void add_usual_modes(CardSeen& card);

} // namespace frustumscreen::display
