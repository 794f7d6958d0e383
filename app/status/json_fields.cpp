#include "app/status/json_fields.h"

#include "firmware_host/base/printable.h"

#include <cmath>

namespace frustumscreen {

namespace {

constexpr std::size_t longest_text = 300; ///< bytes; the exhibit's own sentences have 240 at most

std::string text_of(const nlohmann::json& value) {
    return printable(value.get_ref<const std::string&>(), longest_text);
}

} // namespace

const nlohmann::json* JsonFields::find(const char* key) const {
    if (!there()) {
        return nullptr;
    }
    const auto found = value_->find(key);
    return found != value_->end() ? &*found : nullptr;
}

std::string JsonFields::text(const char* key) const {
    const nlohmann::json* value = find(key);
    return value != nullptr && value->is_string() ? text_of(*value) : std::string();
}

std::optional<double> JsonFields::number(const char* key) const {
    const nlohmann::json* value = find(key);
    if (value == nullptr || !value->is_number()) {
        return std::nullopt;
    }
    const double number = value->get<double>();
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<bool> JsonFields::flag(const char* key) const {
    const nlohmann::json* value = find(key);
    return value != nullptr && value->is_boolean() ? std::optional(value->get<bool>()) : std::nullopt;
}

std::vector<JsonFields> JsonFields::list(const char* key) const {
    std::vector<JsonFields> items;
    if (const nlohmann::json* value = find(key); value != nullptr && value->is_array()) {
        for (const nlohmann::json& item : *value) {
            items.push_back(JsonFields(&item));
        }
    }
    return items;
}

std::vector<std::string> JsonFields::texts(const char* key) const {
    std::vector<std::string> texts;
    for (const JsonFields& item : list(key)) {
        if (item.value_->is_string()) {
            texts.push_back(text_of(*item.value_));
        }
    }
    return texts;
}

} // namespace frustumscreen
