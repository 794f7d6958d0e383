#include "firmware_host/display/output_properties.h"

#include <algorithm>
#include <array>
#include <optional>

namespace frustumscreen::display {

namespace {

constexpr std::string_view range = "Broadcast RGB";

struct Wanted {
    std::string_view property;
    std::string_view choice; ///< empty: the number 0
};
/// "Graphics" asks the projector not to crop, filter or smooth. Unlisted properties ("max bpc", "scaling
/// mode", "audio") change no pixel of a mode that the projector lists.
constexpr std::array<Wanted, 9> wanted{{
    {range, "Full"},
    {"underscan", "off"},
    {"left margin", ""},
    {"right margin", ""},
    {"top margin", ""},
    {"bottom margin", ""},
    {"Colorspace", "Default"},
    {"content type", "Graphics"},
    {"HDR_OUTPUT_METADATA", ""},
}};

const KmsProperty* find(std::span<const KmsProperty> all, std::string_view name) {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [name](const KmsProperty& property) { return property.name == name; });
    return found != all.end() ? &*found : nullptr;
}

std::optional<std::uint64_t> value_of(const KmsProperty& property, std::string_view choice) {
    if (choice.empty()) {
        return 0;
    }
    for (const KmsChoice& one : property.choices) {
        if (one.name == choice) {
            return one.value;
        }
    }
    return std::nullopt;
}

/// The sizes of CTA-861's formats; their codes are limited unless the projector is told otherwise. 640 x 480
/// is the exception.
bool is_television_mode(const ModeTiming& mode) {
    constexpr std::array<std::array<int, 2>, 8> sizes{{{720, 480},
                                                       {720, 576},
                                                       {1280, 720},
                                                       {1680, 720},
                                                       {1920, 1080},
                                                       {2560, 1080},
                                                       {3840, 2160},
                                                       {4096, 2160}}};
    return std::find(sizes.begin(), sizes.end(), std::array<int, 2>{mode.width, mode.height}) != sizes.end();
}

} // namespace

std::vector<PropertySetting> exact_picture(std::span<const KmsProperty> connector) {
    std::vector<PropertySetting> settings;
    for (const Wanted& one : wanted) {
        const KmsProperty* property = find(connector, one.property);
        if (property == nullptr || property->immutable) {
            continue;
        }
        const std::optional<std::uint64_t> value = value_of(*property, one.choice);
        if (value && *value != property->value) {
            settings.push_back({property->id, *value});
        }
    }
    return settings;
}

std::string_view range_in_doubt(std::span<const KmsProperty> connector, bool hdmi, const ModeTiming& mode,
                                bool set) {
    const bool settable = set && find(connector, range) != nullptr;
    if (!hdmi || settable || !is_television_mode(mode)) {
        return {};
    }
    return "its driver alone chooses HDMI's range: if black looks grey or dark parts are lost, set the "
           "projector's HDMI range to the other one";
}

} // namespace frustumscreen::display
