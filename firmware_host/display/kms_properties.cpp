#include "firmware_host/display/kms_properties.h"

#include <memory>

extern "C" {
#include <xf86drm.h>
#include <xf86drmMode.h>
}

namespace frustumscreen {

KmsProperties::KmsProperties(int card, std::uint32_t object, std::uint32_t kind) : object_(object) {
    const std::unique_ptr<drmModeObjectProperties, decltype(&drmModeFreeObjectProperties)> list(
        drmModeObjectGetProperties(card, object, kind), drmModeFreeObjectProperties);
    if (!list) {
        return;
    }
    for (std::uint32_t k = 0; k < list->count_props; ++k) {
        const std::unique_ptr<drmModePropertyRes, decltype(&drmModeFreeProperty)> property(
            drmModeGetProperty(card, list->props[k]), drmModeFreeProperty);
        if (property) {
            all_.push_back({property->prop_id, list->prop_values[k],
                            (property->flags & DRM_MODE_PROP_IMMUTABLE) != 0, property->name});
        }
    }
}

const KmsProperty* KmsProperties::find(std::string_view name) const {
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

} // namespace frustumscreen
