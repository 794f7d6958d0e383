#include "firmware_host/display/kms_properties.h"

#include <memory>
#include <utility>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen::display {

KmsProperties::KmsProperties(int card, std::uint32_t object, std::uint32_t kind) : object_(object) {
    const std::unique_ptr<drmModeObjectProperties, decltype(&drmModeFreeObjectProperties)> list(
        drmModeObjectGetProperties(card, object, kind), drmModeFreeObjectProperties);
    if (!list) {
        return;
    }
    for (std::uint32_t k = 0; k < list->count_props; ++k) {
        const std::unique_ptr<drmModePropertyRes, decltype(&drmModeFreeProperty)> property(
            drmModeGetProperty(card, list->props[k]), drmModeFreeProperty);
        if (!property) {
            continue;
        }
        KmsProperty one{.id = property->prop_id,
                        .value = list->prop_values[k],
                        .immutable = (property->flags & DRM_MODE_PROP_IMMUTABLE) != 0,
                        .name = property->name,
                        .choices = {}};
        for (int c = 0; (property->flags & DRM_MODE_PROP_ENUM) != 0 && c < property->count_enums; ++c) {
            one.choices.push_back({property->enums[c].name, property->enums[c].value});
        }
        all_.push_back(std::move(one));
    }
}

const KmsProperty* KmsProperties::find(std::string_view name) const& {
    for (const KmsProperty& property : all_) {
        if (property.name == name) {
            return &property;
        }
    }
    return nullptr;
}

std::uint64_t KmsProperties::value(std::string_view name) const {
    const KmsProperty* property = find(name);
    return property != nullptr ? property->value : 0;
}

} // namespace frustumscreen::display
