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

namespace frustumscreen {

namespace {

/// 59.94, 59.81 and 60 Hz are the same wish, 50 and 60 are not.
constexpr double same_refresh_hz = 0.5;
constexpr double usual_refresh_hz = 60.0;

/// CTA-861's formats 4 and 16: projectors that take HDMI know these to the pixel.
constexpr ModeTiming hd_720{74250, 1280, 1390, 1430, 1650, 0,
                            720,   725,  730,  750,  0,    mode_hsync_positive | mode_vsync_positive,
                            false};
constexpr ModeTiming hd_1080{148500, 1920, 2008, 2052, 2200, 0,
                             1080,   1084, 1089, 1125, 0,    mode_hsync_positive | mode_vsync_positive,
                             false};

bool is_usable(const ModeTiming& mode) {
    return mode.width > 0 && mode.height > 0 && refresh_hz(mode) > 0.0 && (mode.flags & mode_stereo) == 0;
}

/// Smaller is nearer: whole pictures before half ones, then size and shape, then refresh.
auto distance(const ModeTiming& mode, const OutputWish& wish) {
    const int width = wish.width > 0 ? wish.width : wish.picture_width;
    const int height = wish.height > 0 ? wish.height : wish.picture_height;
    const double hz = wish.refresh_hz > 0.0 ? wish.refresh_hz : usual_refresh_hz;
    const bool halved = (mode.flags & (mode_interlaced | mode_doublescan)) != 0;
    const double size = width > 0 && height > 0
                            ? std::abs(std::log(static_cast<double>(mode.width) / width)) +
                                  std::abs(std::log(static_cast<double>(mode.height) / height))
                            : 0.0;
    return std::make_tuple(halved, size, std::abs(refresh_hz(mode) - hz));
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

const ConnectorSeen* choose_connector(const CardSeen& card, const OutputWish& wish) {
    const ConnectorSeen* best = nullptr;
    const auto rank = [](const ConnectorSeen& connector) {
        return (connector.plugged == Plugged::Yes ? 0 : 2) + (connector.built_in ? 1 : 0);
    };
    for (const ConnectorSeen& connector : card.connectors) {
        const bool named = wish.connector.empty() || connector.name == wish.connector;
        if (!named || connector.plugged == Plugged::No || modes_to_try(connector, wish).empty()) {
            continue;
        }
        if (best == nullptr || rank(connector) < rank(*best)) {
            best = &connector;
        }
    }
    return best;
}

std::vector<ModeTiming> modes_to_try(const ConnectorSeen& connector, const OutputWish& wish) {
    std::vector<ModeTiming> modes;
    std::copy_if(connector.modes.begin(), connector.modes.end(), std::back_inserter(modes), is_usable);
    const auto rank = [&wish](const ModeTiming& mode) {
        const bool wished = wish.width > 0 && fulfils(mode, wish);
        return std::make_tuple(!wished, !wished && !mode.preferred, distance(mode, wish));
    };
    std::stable_sort(modes.begin(), modes.end(),
                     [&rank](const ModeTiming& a, const ModeTiming& b) { return rank(a) < rank(b); });
    const bool there = !modes.empty() && fulfils(modes.front(), wish);
    if (wish.force && wish.width > 0 && !there) {
        const double hz = wish.refresh_hz > 0.0 ? wish.refresh_hz : usual_refresh_hz;
        if (const ModeTiming made = make_mode(wish.width, wish.height, hz); is_usable(made)) {
            modes.insert(modes.begin(), made);
        }
    }
    return modes;
}

bool fulfils(const ModeTiming& mode, const OutputWish& wish) {
    const bool size = wish.width == 0 || (mode.width == wish.width && mode.height == wish.height);
    const bool rate =
        wish.refresh_hz == 0.0 || std::abs(refresh_hz(mode) - wish.refresh_hz) <= same_refresh_hz;
    return size && rate && (mode.flags & (mode_interlaced | mode_doublescan)) == 0;
}

ModeTiming make_mode(int width, int height, double refresh_hz) {
    for (const ModeTiming& standard : {hd_720, hd_1080}) {
        if (standard.width == width && standard.height == height &&
            std::abs(refresh_hz - usual_refresh_hz) <= same_refresh_hz) {
            return standard;
        }
    }
    // Reduced blanking is for digital connections and defined for multiples of 60 Hz.
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

} // namespace frustumscreen
