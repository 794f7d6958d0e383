#include "app/status/status_fields.h"

#include "firmware_host/base/local_time.h"
#include "firmware_host/base/printable.h"

#include <cmath>
#include <ctime>

namespace frustumscreen::status::status_json_values {

namespace {

constexpr std::size_t longest_text = 300; ///< bytes; the exhibit's own sentences have 240 at most
constexpr double largest_time_ns = 4e18;  ///< the difference of two such times does not overflow

} // namespace

Json json_of(double number, Digits digits) {
    return std::round(number * digits.scale * digits.steps) / digits.steps;
}

Json json_of(const Sentence& text, Digits) {
    return text.view();
}

Json json_of(WallTime time, Digits) {
    return utc_text(time);
}

Json json_of(std::chrono::sys_seconds time, Digits) {
    return local_time_text(time);
}

Json json_of(MonotonicTime time, Digits) {
    return time.time_since_epoch().count();
}

bool read(const nlohmann::json& json, bool& value, Digits) {
    value = json.is_boolean() ? json.get<bool>() : value;
    return json.is_boolean();
}

bool read(const nlohmann::json& json, double& value, Digits digits) {
    const double number = json.is_number() ? json.get<double>() / digits.scale : NAN;
    value = std::isfinite(number) ? number : value;
    return std::isfinite(number);
}

bool read(const nlohmann::json& json, std::string& value, Digits) {
    if (json.is_string()) {
        value = printable(json.get_ref<const std::string&>(), longest_text);
    }
    return json.is_string();
}

bool read(const nlohmann::json& json, Sentence& value, Digits) {
    std::string text;
    const bool is_text = read(json, text);
    value = is_text ? Sentence(text) : value;
    return is_text;
}

bool read(const nlohmann::json& json, std::chrono::sys_seconds& value, Digits) {
    std::string text;
    std::tm time{};
    if (!read(json, text) || ::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S%z", &time) == nullptr) {
        return false;
    }
    const std::chrono::seconds offset(time.tm_gmtoff);
    value = std::chrono::sys_seconds(std::chrono::seconds(::timegm(&time))) - offset;
    return true;
}

bool read(const nlohmann::json& json, WallTime& value, Digits) {
    std::chrono::sys_seconds seconds;
    const bool is_time = read(json, seconds);
    value = is_time ? WallTime(seconds) : value;
    return is_time;
}

bool read(const nlohmann::json& json, MonotonicTime& value, Digits) {
    double number = 0.0;
    if (!read(json, number) || std::abs(number) > largest_time_ns) {
        return false;
    }
    value = MonotonicTime(Nanoseconds(json.is_number_integer() ? json.get<Nanoseconds::rep>()
                                                               : static_cast<Nanoseconds::rep>(number)));
    return true;
}

bool read(const nlohmann::json& json, std::vector<std::string>& values, Digits) {
    values.clear();
    if (json.is_array()) {
        for (const nlohmann::json& each : json) {
            if (std::string text; read(each, text)) {
                values.push_back(std::move(text));
            }
        }
    }
    return json.is_array();
}

} // namespace frustumscreen::status::status_json_values

namespace frustumscreen::status {

const nlohmann::json& StatusReader::find(const char* key) const {
    static const nlohmann::json nothing;
    const auto found = json_->is_object() ? json_->find(key) : json_->end();
    return found != json_->end() ? *found : nothing;
}

} // namespace frustumscreen::status
