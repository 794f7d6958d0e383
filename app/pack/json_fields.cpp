#include "app/pack/json_fields.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>

#include <algorithm>

namespace frustumscreen::pack_format {

namespace {

using Json = nlohmann::json;

/// A value in a message: itself if it is small, its type if not.
std::string found(const Json& value) {
    if (value.is_structured()) {
        return fmt::format("{} of {}", value.is_object() ? "an object" : "a list", value.size());
    }
    return printable(value.dump(-1, ' ', true, Json::error_handler_t::replace), 40);
}

} // namespace

void Refusal::refuse(const std::string& place, std::string_view what) {
    if (!message) {
        message = place + " " + std::string(what);
    }
}

JsonFields::JsonFields(Refusal& refusal, const Json* object, std::string place)
    : refusal_(&refusal), object_(object), place_(std::move(place)) {
    if (object_ == nullptr || !object_->is_object()) {
        object_ = nullptr;
        refusal_->refuse(place_.empty() ? "the manifest" : place_, "must be an object { ... }");
    }
}

std::string JsonFields::place_of(const char* key) const {
    return place_.empty() ? std::string(key) : place_ + "." + key;
}

const Json* JsonFields::take(const char* key) {
    known_.insert(key);
    if (refusal_->message || object_ == nullptr) {
        return nullptr;
    }
    const auto value = object_->find(key);
    if (value == object_->end()) {
        refuse(key, "is missing");
        return nullptr;
    }
    return &*value;
}

const Json* JsonFields::take_list(const char* key, std::size_t most) {
    const Json* value = take(key);
    if (value == nullptr) {
        return nullptr;
    }
    if (!value->is_array() || value->size() > most) {
        refuse(key, fmt::format("is {}; allowed is a list of at most {}", found(*value), most));
        return nullptr;
    }
    return value;
}

std::string JsonFields::text(const char* key) {
    const Json* value = take(key);
    if (value == nullptr) {
        return {};
    }
    if (!value->is_string()) {
        refuse(key, fmt::format("is {}; allowed is a text", found(*value)));
        return {};
    }
    return value->get<std::string>();
}

std::vector<std::string> JsonFields::texts(const char* key, std::size_t most) {
    std::vector<std::string> result;
    const Json* list = take_list(key, most);
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        if (!(*list)[k].is_string()) {
            refuse(key, fmt::format("has {}; allowed are texts", found((*list)[k])));
            return {};
        }
        result.push_back((*list)[k].get<std::string>());
    }
    return result;
}

bool JsonFields::flag(const char* key) {
    const Json* value = take(key);
    if (value != nullptr && !value->is_boolean()) {
        refuse(key, fmt::format("is {}; allowed are true and false", found(*value)));
        return false;
    }
    return value != nullptr && value->get<bool>();
}

std::uint64_t JsonFields::whole(const char* key, std::uint64_t most) {
    const Json* value = take(key);
    if (value == nullptr) {
        return 0;
    }
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() > most) {
        refuse(key, fmt::format("is {}; allowed are whole numbers from 0 to {}", found(*value), most));
        return 0;
    }
    return value->get<std::uint64_t>();
}

double JsonFields::number(const char* key) {
    const Json* value = take(key);
    if (value == nullptr) {
        return 0.0;
    }
    if (!value->is_number()) {
        refuse(key, fmt::format("is {}; allowed is a number", found(*value)));
        return 0.0;
    }
    return value->get<double>();
}

void JsonFields::numbers(const char* key, std::span<double> values) {
    const Json* list = take_list(key, values.size());
    if (list == nullptr) {
        return;
    }
    const bool all = std::all_of(list->begin(), list->end(), [](const Json& v) { return v.is_number(); });
    if (list->size() != values.size() || !all) {
        refuse(key, fmt::format("is {}; allowed is a list of {} numbers", found(*list), values.size()));
        return;
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = (*list)[k].get<double>();
    }
}

std::vector<std::array<double, 3>> JsonFields::triples(const char* key, std::size_t most) {
    std::vector<std::array<double, 3>> result;
    const Json* list = take_list(key, most);
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        const Json& item = (*list)[k];
        if (!item.is_array() || item.size() != 3 || !item[0].is_number() || !item[1].is_number() ||
            !item[2].is_number()) {
            refuse(key, fmt::format("has {}; allowed are lists of 3 numbers", found(item)));
            return {};
        }
        result.push_back({item[0].get<double>(), item[1].get<double>(), item[2].get<double>()});
    }
    return result;
}

JsonFields JsonFields::object(const char* key) {
    const Json* value = take(key);
    return {*refusal_, value, place_of(key)};
}

std::vector<JsonFields> JsonFields::objects(const char* key, std::size_t most) {
    std::vector<JsonFields> result;
    const Json* list = take_list(key, most);
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        result.emplace_back(*refusal_, &(*list)[k], fmt::format("{}[{}]", place_of(key), k));
    }
    return result;
}

std::optional<JsonFields> JsonFields::object_or_null(const char* key) {
    const Json* value = take(key);
    if (value == nullptr || value->is_null()) {
        return std::nullopt;
    }
    return JsonFields(*refusal_, value, place_of(key));
}

void JsonFields::finish() {
    if (refusal_->message || object_ == nullptr) {
        return;
    }
    for (const auto& [key, value] : object_->items()) {
        if (!known_.contains(key)) {
            refusal_->refuse(place_of(printable(key, 40).c_str()), "is not a field of a pack's manifest");
            return;
        }
    }
}

Json parse_json(Refusal& refusal, std::string_view text) {
    std::vector<std::set<std::string>> open_objects;
    const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start) {
            open_objects.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            open_objects.pop_back();
        } else if (event == Json::parse_event_t::key &&
                   !open_objects.back().insert(parsed.get<std::string>()).second) {
            refusal.refuse(printable(parsed.get<std::string>(), 40), "stands twice in one object");
        }
        return true;
    };
    try {
        return Json::parse(text, watch);
    } catch (const Json::parse_error& error) {
        refusal.refuse("the manifest", fmt::format("is not JSON in UTF-8 (at byte {})", error.byte));
    } catch (const Json::exception&) {
        refusal.refuse("the manifest", "holds a number beyond all bounds");
    }
    return {};
}

} // namespace frustumscreen::pack_format
