/// Writes one JSON object field by field: the counterpart of JsonReader, driven by the same description.
///
/// The reader checks the limits; the writer ignores them.
/// Threads  values; any.
#pragma once

#include "firmware_host/base/json.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <cstdlib>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

/// The fewest digits that read back as an equal 32-bit number.
[[nodiscard]] inline double in_few_digits(float value) {
    const double few = std::strtod(fmt::format("{}", value).c_str(), nullptr);
    return static_cast<float>(few) == value ? few : static_cast<double>(value);
}

class JsonWriter {
public:
    using Json = nlohmann::ordered_json;

    void fixed(const char* key, const auto& value) { object_[key] = value; }
    void text(const char* key, const std::string& value) { object_[key] = value; }
    void texts(const char* key, const std::vector<std::string>& values, std::size_t /*most*/) {
        object_[key] = values;
    }
    void flag(const char* key, bool value) { object_[key] = value; }
    void flag_or(const char* key, bool value, bool left_out) {
        if (value != left_out) {
            object_[key] = value;
        }
    }
    void whole(const char* key, auto value, std::uint64_t /*most*/) { object_[key] = value; }
    void whole_or_null(const char* key, const auto& value, std::uint64_t /*most*/) {
        object_[key] = value ? Json(*value) : Json(nullptr);
    }
    void number(const char* key, float value) { object_[key] = in_few_digits(value); }
    void number(const char* key, double value) { object_[key] = value; }
    void number_or(const char* key, double value, double left_out) {
        if (value != left_out) {
            object_[key] = value;
        }
    }
    void numbers(const char* key, std::span<const double> values) {
        object_[key] = std::vector<double>(values.begin(), values.end());
    }
    void triples(const char* key, const std::vector<glm::dvec3>& values, std::size_t /*most*/) {
        Json list = Json::array();
        for (const glm::dvec3& v : values) {
            list.push_back(Json::array({v.x, v.y, v.z}));
        }
        object_[key] = std::move(list);
    }
    template <typename Choice>
    void choice(const char* key, Choice value, std::span<const std::string_view> words) {
        object_[key] = words[static_cast<std::size_t>(value)];
    }
    void name_in(const char* key, std::uint32_t index, std::span<const std::string> names,
                 std::string_view /*otherwise*/) {
        object_[key] = names[index];
    }
    void object(const char* key, const auto& describe) {
        JsonWriter inner;
        describe(inner);
        object_[key] = std::move(inner.object_);
    }
    void object_or_null(const char* key, const auto& value, const auto& describe) {
        object_[key] = nullptr;
        if (value) {
            object(key, [&](JsonWriter& inner) { describe(inner, *value); });
        }
    }
    void members_or_none(const char* key, const auto& values, std::size_t /*most*/, const auto& describe) {
        for (const auto& value : values) {
            JsonWriter item;
            describe(item, value);
            object_[key][value.name] = std::move(item.object_);
        }
    }
    void free_object(const char* key, const std::string& text) { object_[key] = nlohmann::json::parse(text); }
    void objects(const char* key, const auto& values, std::size_t /*most*/, const auto& describe) {
        Json list = Json::array();
        for (const auto& value : values) {
            JsonWriter item;
            describe(item, value);
            list.push_back(std::move(item.object_));
        }
        object_[key] = std::move(list);
    }

    [[nodiscard]] const Json& document() const { return object_; }

private:
    Json object_ = Json::object();
};

} // namespace frustumscreen::pack
