#include "firmware_host/display/kms_mode.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <tuple>

extern "C" {
#include <libxcvt/libxcvt.h>
}

namespace frustumscreen::display {

namespace {

/// 59.94, 59.81 and 60 Hz count as one rate; 50 and 60 do not.
constexpr double same_refresh_hz = 0.5;
constexpr double usual_refresh_hz = 60.0; ///< of a mode made here without a requested rate

/// CTA-861's formats 4 and 16; projectors with HDMI expect exactly these timings.
constexpr ModeTiming hd_720{.clock_khz = 74250,
                            .width = 1280,
                            .hsync_start = 1390,
                            .hsync_end = 1430,
                            .htotal = 1650,
                            .hskew = 0,
                            .height = 720,
                            .vsync_start = 725,
                            .vsync_end = 730,
                            .vtotal = 750,
                            .vscan = 0,
                            .flags = mode_hsync_positive | mode_vsync_positive,
                            .preferred = false};
constexpr ModeTiming hd_1080{.clock_khz = 148500,
                             .width = 1920,
                             .hsync_start = 2008,
                             .hsync_end = 2052,
                             .htotal = 2200,
                             .hskew = 0,
                             .height = 1080,
                             .vsync_start = 1084,
                             .vsync_end = 1089,
                             .vtotal = 1125,
                             .vscan = 0,
                             .flags = mode_hsync_positive | mode_vsync_positive,
                             .preferred = false};

/// The best of these is chosen; a mode in HDMI's 3D follows from it.
bool is_usable(const ModeTiming& mode) {
    return mode.width > 0 && mode.height > 0 && refresh_hz(mode) > 0.0 && (mode.flags & mode_stereo) == 0;
}

bool is_halved(const ModeTiming& mode) {
    return (mode.flags & (mode_interlaced | mode_doublescan)) != 0;
}

double off_rate(const ModeTiming& mode, const OutputRequest& request) {
    return std::abs(refresh_hz(mode) - (request.refresh_hz > 0.0 ? request.refresh_hz : request.picture_hz));
}

/// Smaller is nearer: progressive modes before interlaced or double-scanned ones, then size and shape, then
/// refresh.
auto distance(const ModeTiming& mode, const OutputRequest& request) {
    const int width = request.width > 0 ? request.width : request.picture_width;
    const int height = request.height > 0 ? request.height : request.picture_height;
    const double size = width > 0 && height > 0
                            ? std::abs(std::log(static_cast<double>(mode.width) / width)) +
                                  std::abs(std::log(static_cast<double>(mode.height) / height))
                            : 0.0;
    return std::make_tuple(is_halved(mode), size, off_rate(mode, request));
}

/// Smaller is better, with a requested mode: that mode, the preferred one, the nearest.
auto rank_asked(const ModeTiming& mode, const OutputRequest& request) {
    const bool asked = fulfils(mode, request);
    return std::make_tuple(!asked, !asked && !mode.preferred, distance(mode, request));
}

/// Smaller is better, without a requested mode: one that is fast enough, the picture's size at its rate (the preferred one
/// first), its size at another rate, the preferred mode, the nearest.
auto rank_unasked(const ModeTiming& mode, const OutputRequest& request) {
    const bool fits =
        mode.width == request.picture_width && mode.height == request.picture_height && !is_halved(mode);
    const bool in_time = fits && off_rate(mode, request) <= 2.0 * same_refresh_hz;
    const bool flickers = request.fast && refresh_hz(mode) < min_in_turn_hz;
    return std::make_tuple(flickers, !fits, !in_time, !mode.preferred, distance(mode, request));
}

/// The flag of HDMI's 3D for this layout; 0: there is none.
std::uint32_t stereo_flag(EyeLayout eyes) {
    switch (eyes) {
    case EyeLayout::SideBySide:
        return mode_side_by_side;
    case EyeLayout::TopBottom:
        return mode_top_bottom;
    case EyeLayout::One:
    case EyeLayout::InTurn:
        break;
    }
    return 0;
}

/// Puts before each mode its twin, if the connector lists it: the mode of the same timing that tells the projector
/// the layout of the eyes' pictures.
std::vector<ModeTiming> with_twins(const std::vector<ModeTiming>& plain,
                                   const std::vector<ModeTiming>& listed, EyeLayout eyes) {
    std::vector<ModeTiming> modes;
    for (const ModeTiming& mode : plain) {
        ModeTiming twin = mode;
        twin.flags |= stereo_flag(eyes);
        const auto found = std::find_if(listed.begin(), listed.end(), [&twin](ModeTiming one) {
            one.preferred = twin.preferred;
            return one == twin;
        });
        if (found != listed.end()) {
            modes.push_back(*found);
        }
        modes.push_back(mode);
    }
    return modes;
}

int rank_of(const ConnectorSeen& connector) {
    const int certainty = connector.plugged == Plugged::Yes ? 0 : connector.plugged == Plugged::No ? 4 : 2;
    return certainty + (connector.built_in ? 1 : 0);
}

} // namespace

double refresh_hz(const ModeTiming& mode) {
    const double pixels = static_cast<double>(mode.htotal) * mode.vtotal;
    if (mode.clock_khz == 0 || pixels <= 0.0) {
        return 0.0;
    }
    double hz = 1000.0 * mode.clock_khz / pixels;
    hz *= (mode.flags & mode_interlaced) != 0 ? 2.0 : 1.0;
    hz /= (mode.flags & mode_doublescan) != 0 ? 2.0 : 1.0;
    return mode.vscan > 1 ? hz / mode.vscan : hz;
}

bool is_lit_blindly(const ConnectorSeen& connector, const OutputRequest& request) {
    return connector.plugged == Plugged::No && request.force && request.width > 0 &&
           connector.name == request.connector;
}

const ConnectorSeen* choose_connector(const CardSeen& card, const OutputRequest& request) {
    const ConnectorSeen* best = nullptr;
    for (const ConnectorSeen& connector : card.connectors) {
        const bool named = request.connector.empty() || connector.name == request.connector;
        const bool there = connector.plugged != Plugged::No || is_lit_blindly(connector, request);
        if (named && there && !modes_to_try(connector, request).empty() &&
            (best == nullptr || rank_of(connector) < rank_of(*best))) {
            best = &connector;
        }
    }
    return best;
}

CardRank rank_of(const CardSeen& card, const OutputRequest& request) {
    const ConnectorSeen* best = choose_connector(card, request);
    if (best != nullptr && best->plugged == Plugged::Yes) {
        return best->built_in ? CardRank::Panel : CardRank::Projector;
    }
    const bool could_be =
        request.connector.empty() ||
        std::any_of(card.connectors.begin(), card.connectors.end(),
                    [&request](const ConnectorSeen& seen) { return seen.name == request.connector; });
    return could_be ? CardRank::NothingCertain : CardRank::WithoutTheConnectorNamed;
}

std::vector<ModeTiming> modes_to_try(const ConnectorSeen& connector, const OutputRequest& request) {
    std::vector<ModeTiming> modes;
    std::copy_if(connector.modes.begin(), connector.modes.end(), std::back_inserter(modes), is_usable);
    std::stable_sort(modes.begin(), modes.end(), [&request](const ModeTiming& a, const ModeTiming& b) {
        return request.width > 0 ? rank_asked(a, request) < rank_asked(b, request)
                                 : rank_unasked(a, request) < rank_unasked(b, request);
    });
    const bool there = !modes.empty() && fulfils(modes.front(), request);
    if (request.force && request.width > 0 && !there) {
        const double hz = request.refresh_hz > 0.0 ? request.refresh_hz : usual_refresh_hz;
        if (const ModeTiming made = make_mode(request.width, request.height, hz); is_usable(made)) {
            modes.insert(modes.begin(), made);
        }
    }
    return stereo_flag(request.eyes) != 0 ? with_twins(modes, connector.modes, request.eyes) : modes;
}

bool fulfils(const ModeTiming& mode, const OutputRequest& request) {
    const bool size = request.width == 0 || (mode.width == request.width && mode.height == request.height);
    const bool rate =
        request.refresh_hz == 0.0 || std::abs(refresh_hz(mode) - request.refresh_hz) <= same_refresh_hz;
    return size && rate && !is_halved(mode);
}

ModeTiming make_mode(int width, int height, double refresh_hz) {
    for (const ModeTiming& standard : {hd_720, hd_1080}) {
        if (standard.width == width && standard.height == height &&
            std::abs(refresh_hz - usual_refresh_hz) <= same_refresh_hz) {
            return standard;
        }
    }
    // Reduced blanking is for digital connections, and defined only for multiples of 60 Hz.
    const bool reduced = std::abs(refresh_hz - usual_refresh_hz) <= same_refresh_hz;
    const std::unique_ptr<libxcvt_mode_info, decltype(&std::free)> made(
        libxcvt_gen_mode_info(width, height, static_cast<float>(refresh_hz), reduced, false), std::free);
    ModeTiming mode;
    if (made == nullptr) {
        return mode;
    }
    mode.clock_khz = static_cast<std::uint32_t>(made->dot_clock);
    mode.width = static_cast<std::uint16_t>(made->hdisplay);
    mode.hsync_start = made->hsync_start;
    mode.hsync_end = made->hsync_end;
    mode.htotal = made->htotal;
    mode.height = static_cast<std::uint16_t>(made->vdisplay);
    mode.vsync_start = made->vsync_start;
    mode.vsync_end = made->vsync_end;
    mode.vtotal = made->vtotal;
    const auto flags = static_cast<std::uint32_t>(made->mode_flags);
    mode.flags =
        flags & (mode_hsync_positive | mode_hsync_negative | mode_vsync_positive | mode_vsync_negative);
    return mode;
}

void add_usual_modes(CardSeen& card) {
    for (ConnectorSeen& connector : card.connectors) {
        if (connector.plugged == Plugged::Yes && connector.modes.empty()) {
            connector.modes = {hd_720, hd_1080, make_mode(1024, 768, usual_refresh_hz)};
            connector.modes.front().preferred = true;
        }
    }
}

} // namespace frustumscreen::display
