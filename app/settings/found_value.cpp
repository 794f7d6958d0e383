#include "app/settings/found_value.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

namespace frustumscreen::settings {

std::string found(const toml::node& node) {
    if (const auto* text = node.as_string()) {
        return fmt::format("the text \"{}\"", printable(text->get(), 40));
    }
    if (const auto* integer = node.as_integer()) {
        return fmt::format("{}", integer->get());
    }
    if (const auto* number = node.as_floating_point()) {
        return fmt::format("{}", number->get());
    }
    if (const auto* boolean = node.as_boolean()) {
        return boolean->get() ? "true" : "false";
    }
    if (const auto* array = node.as_array()) {
        return fmt::format("a list of {}", array->size());
    }
    return node.is_table() ? "a table" : "a date or a time";
}

} // namespace frustumscreen::settings
