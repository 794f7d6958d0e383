/// The properties of one KMS object (connector, CRTC, plane): their numbers by name, and their values at
/// construction.
///
/// Threads  values.
/// Errors   none: a property that the driver lacks is not found.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::display {

/// One of the allowed values of an enumeration.
struct KmsChoice {
    std::string name;
    std::uint64_t value = 0;
};

struct KmsProperty {
    std::uint32_t id = 0;
    std::uint64_t value = 0;
    bool immutable = false;
    std::string name;
    std::vector<KmsChoice> choices; ///< of an enumeration
};

class KmsProperties {
public:
    /// `kind`: DRM_MODE_OBJECT_CONNECTOR, ..._CRTC, ..._PLANE.
    KmsProperties(int card, std::uint32_t object, std::uint32_t kind);

    [[nodiscard]] std::uint32_t object() const { return object_; }
    [[nodiscard]] std::span<const KmsProperty> all() const { return all_; }
    [[nodiscard]] const KmsProperty* find(std::string_view name) const&;
    const KmsProperty* find(std::string_view name) const&& = delete; ///< it would not outlive the call
    /// 0 if the object lacks the property.
    [[nodiscard]] std::uint64_t value(std::string_view name) const;

private:
    std::uint32_t object_;
    std::vector<KmsProperty> all_;
};

} // namespace frustumscreen::display
