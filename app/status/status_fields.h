/// Writes and reads a status as JSON, by its description (describe_status.h, watchdog_status.h).
///
/// StatusReader reads a document by another program, which may hold anything: a field that is missing or of another
/// type reads as nothing, and a text becomes one printable line.
///
/// Threads  pure; any. A document outlives its reader.
/// Errors   none.
#pragma once

#include "app/status/metric.h"
#include "firmware_host/base/json.h"
#include "firmware_host/base/sentence.h"
#include "firmware_host/base/time.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace frustumscreen::status {

namespace status_json_values {

using Json = nlohmann::ordered_json;
using WallTime = std::chrono::system_clock::time_point;

[[nodiscard]] Json json_of(double number, Digits digits = {});
[[nodiscard]] Json json_of(const Sentence& text, Digits = {});
[[nodiscard]] Json json_of(WallTime time, Digits = {});
[[nodiscard]] Json json_of(std::chrono::sys_seconds time, Digits = {});
[[nodiscard]] Json json_of(MonotonicTime time, Digits = {});
template <typename Value> [[nodiscard]] Json json_of(const Value& value, Digits = {}) {
    return value;
}
template <typename Value> [[nodiscard]] Json json_of(const std::optional<Value>& value, Digits digits = {}) {
    return value ? json_of(*value, digits) : Json(nullptr);
}

/// Return true if `json` is a value of this type; else they leave `value` as it is.
[[nodiscard]] bool read(const nlohmann::json& json, bool& value, Digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, double& value, Digits digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, std::string& value, Digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, Sentence& value, Digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, WallTime& value, Digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, std::chrono::sys_seconds& value, Digits = {});
[[nodiscard]] bool read(const nlohmann::json& json, MonotonicTime& value, Digits = {});
/// The texts of a list; other items are skipped.
[[nodiscard]] bool read(const nlohmann::json& json, std::vector<std::string>& values, Digits = {});
template <std::integral Whole>
requires(!std::same_as<Whole, bool>)
    [[nodiscard]] bool read(const nlohmann::json& json, Whole& value, Digits = {}) {
    using Limits = std::numeric_limits<Whole>;
    double number = 0.0;
    if (!read(json, number)) {
        return false;
    }
    value = json.is_number_unsigned()
                ? static_cast<Whole>(
                      std::min(json.get<std::uint64_t>(), static_cast<std::uint64_t>(Limits::max())))
                : static_cast<Whole>(std::clamp(number, std::max(-1e18, double(Limits::lowest())),
                                                std::min(1e18, double(Limits::max()))));
    return true;
}
template <typename Value>
[[nodiscard]] bool read(const nlohmann::json& json, std::optional<Value>& value, Digits digits = {}) {
    Value own{};
    const bool is_there = read(json, own, digits);
    value = is_there ? std::optional(std::move(own)) : std::nullopt;
    return is_there;
}
template <std::size_t Count>
[[nodiscard]] bool read(const nlohmann::json& json, std::array<double, Count>& values, Digits = {}) {
    std::array<double, Count> all{};
    for (std::size_t k = 0; k < Count; ++k) {
        if (!json.is_array() || json.size() != Count || !read(json[k], all[k])) {
            return false;
        }
    }
    values = all;
    return true;
}

} // namespace status_json_values

class StatusWriter {
public:
    void field(const char* key, const auto& value, std::string_view /*said*/ = {},
               const Metric& /*metric*/ = {}, Digits digits = {}) {
        json_[key] = status_json_values::json_of(value, digits);
    }
    void word(const char* key, const std::string& value, std::string_view /*said*/, const auto& /*all*/,
              const auto& /*word_for*/, const Metric& /*metric*/) {
        json_[key] = value;
    }
    void choice(const char* key, auto value, const auto& words) {
        json_[key] = words.at(static_cast<std::size_t>(value));
    }
    void object(const char* key, std::string_view /*said*/, const auto& describe) {
        StatusWriter inner;
        describe(inner);
        json_[key] = std::move(inner.json_);
    }
    void object_or_null(const char* key, const auto& value, std::string_view said, const Metric& /*metric*/,
                        const auto& describe) {
        json_[key] = nullptr;
        if (value) {
            object(key, said, [&](StatusWriter& inner) { describe(inner, *value); });
        }
    }
    template <typename Item>
    void objects(const char* key, const std::vector<Item>& values, std::string_view /*said*/,
                 const Metric& /*metric*/, const auto& describe) {
        status_json_values::Json list = status_json_values::Json::array();
        for (const Item& value : values) {
            StatusWriter item;
            describe(item, value);
            list.push_back(std::move(item.json_));
        }
        json_[key] = std::move(list);
    }
    template <typename Item>
    void objects(const char* key, const std::shared_ptr<const std::vector<Item>>& values,
                 std::string_view said, const Metric& metric, const auto& describe) {
        objects(key, values ? *values : std::vector<Item>(), said, metric, describe);
    }

    /// The document's text.
    [[nodiscard]] std::string text() const {
        return json_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    }

private:
    status_json_values::Json json_ = status_json_values::Json::object();
};

class StatusReader {
public:
    /// Called for each metric whose field the document has, with one value of its label and the number for it.
    using NoteMetric = std::function<void(const Metric& metric, std::string_view of, double number)>;

    explicit StatusReader(const nlohmann::json& document, NoteMetric note = {})
        : json_(&document), note_(std::move(note)) {}

    template <typename Value>
    void field(const char* key, Value& value, std::string_view /*said*/ = {}, const Metric& metric = {},
               Digits digits = {}) {
        Value own{};
        const bool is_there = status_json_values::read(find(key), own, digits);
        value = std::move(own);
        if constexpr (std::same_as<Value, std::string>) {
            note(metric, value, 1.0); // even if it is empty
        } else if constexpr (requires { static_cast<double>(value); }) {
            note_if(is_there, metric, static_cast<double>(value));
        } else if constexpr (requires { static_cast<double>(*value); }) {
            note_if(is_there, metric, is_there ? static_cast<double>(*value) : 0.0);
        }
    }
    void word(const char* key, std::string& value, std::string_view said, const auto& all,
              const auto& word_for, const Metric& metric) {
        field(key, value, said);
        for (const auto& each : all) {
            note(metric, word_for(each), value == word_for(each) ? 1.0 : 0.0);
        }
    }
    /// The first choice if the document has none of the words.
    template <typename Choice> void choice(const char* key, Choice& value, const auto& words) {
        std::string word;
        field(key, word);
        const auto found = std::find(words.begin(), words.end(), word);
        value = static_cast<Choice>(found != words.end() ? found - words.begin() : 0);
    }
    void object(const char* key, std::string_view /*said*/, const auto& describe) {
        StatusReader inner(find(key), note_);
        describe(inner);
    }
    /// `value`: a std::optional, or a std::shared_ptr to a constant.
    template <typename Held>
    void object_or_null(const char* key, Held& value, std::string_view said, const Metric& metric,
                        const auto& describe) {
        using Own = std::remove_cvref_t<decltype(*value)>;
        value = {};
        const bool is_there = find(key).is_object();
        note(metric, metric.of, is_there ? 1.0 : 0.0);
        if (is_there) {
            Own own{};
            object(key, said, [&](StatusReader& inner) { describe(inner, own); });
            if constexpr (std::same_as<Held, std::optional<Own>>) {
                value = std::move(own);
            } else {
                value = std::make_shared<const Own>(std::move(own));
            }
        }
    }
    template <typename Item>
    void objects(const char* key, std::vector<Item>& values, std::string_view /*said*/, const Metric& metric,
                 const auto& describe) {
        values.clear();
        if (const nlohmann::json& list = find(key); list.is_array()) {
            for (const nlohmann::json& each : list) {
                StatusReader item(each, note_);
                describe(item, values.emplace_back());
            }
        }
        note(metric, metric.of, static_cast<double>(values.size()));
    }
    template <typename Item>
    void objects(const char* key, std::shared_ptr<const std::vector<Item>>& values, std::string_view said,
                 const Metric& metric, const auto& describe) {
        std::vector<Item> own;
        objects(key, own, said, metric, describe);
        values = std::make_shared<const std::vector<Item>>(std::move(own));
    }

private:
    [[nodiscard]] const nlohmann::json& find(const char* key) const;
    void note(const Metric& metric, std::string_view of, double number) const {
        if (note_ && !metric.name.empty()) {
            note_(metric, of, number * metric.scale);
        }
    }
    void note_if(bool is_there, const Metric& metric, double number) const {
        if (is_there) {
            note(metric, metric.of, number);
        }
    }

    const nlohmann::json* json_;
    NoteMetric note_;
};

} // namespace frustumscreen::status
