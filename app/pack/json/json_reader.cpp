#include "app/pack/json/json_reader.h"

#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace frustumscreen::pack {

namespace {

using Json = nlohmann::json;

/// A value in a message: itself if it is small, otherwise its type.
std::string found(const Json& value) {
    if (value.is_structured()) {
        return fmt::format("{} of {}", value.is_object() ? "an object" : "a list", value.size());
    }
    return printable(value.dump(-1, ' ', true, Json::error_handler_t::replace), 40);
}

} // namespace

void Refusal::refuse(MessageId id, const std::string& place, std::string_view what) {
    if (!error) {
        error = Error{ErrorKind::BadInput, id, fmt::format("{} {}", place, what)};
    }
}

JsonReader::JsonReader(Refusal& refusal, const Json* object, std::string place)
    : refusal_(&refusal), object_(object), place_(std::move(place)) {
    if (object_ == nullptr || !object_->is_object()) {
        object_ = nullptr;
        refusal_->refuse("json.no_object", place_.empty() ? refusal_->document : place_,
                         "must be an object { ... }");
    }
}

std::string JsonReader::place_of(const char* key) const {
    return place_.empty() ? std::string(key) : place_ + "." + key;
}

std::string JsonReader::place_of(const char* key, std::size_t item) const {
    return fmt::format("{}[{}]", place_of(key), item);
}

const Json* JsonReader::take(const char* key) {
    known_.insert(key);
    if (refusal_->error || object_ == nullptr) {
        return nullptr;
    }
    const auto value = object_->find(key);
    if (value == object_->end()) {
        refuse("json.missing", key, "is missing");
        return nullptr;
    }
    return &*value;
}

const Json* JsonReader::take_list(const char* key, std::size_t most) {
    const Json* value = take(key);
    if (value == nullptr) {
        return nullptr;
    }
    if (!value->is_array() || value->size() > most) {
        refuse("json.list", key, fmt::format("is {}; allowed is a list of at most {}", found(*value), most));
        return nullptr;
    }
    return value;
}

const Json* JsonReader::take_members(const char* key, std::size_t most) {
    known_.insert(key);
    if (refusal_->error || object_ == nullptr || !object_->contains(key)) {
        return nullptr;
    }
    const Json* value = take(key);
    if (!value->is_object() || value->size() > most) {
        refuse("json.object_size", key,
               fmt::format("is {}; allowed is an object of at most {}", found(*value), most));
        return nullptr;
    }
    return value;
}

std::string JsonReader::printable_name(const std::string& name) {
    return printable(name, 40);
}

void JsonReader::free_object(const char* key, std::string& text) {
    const Json* value = take(key);
    if (value == nullptr) {
        return;
    }
    if (!value->is_object()) {
        refuse("json.object", key, fmt::format("is {}; allowed is an object {{ ... }}", found(*value)));
        return;
    }
    text = value->dump();
}

void JsonReader::text(const char* key, std::string& value) {
    const Json* read = take(key);
    if (read == nullptr) {
        return;
    }
    if (!read->is_string()) {
        refuse("json.text", key, fmt::format("is {}; allowed is a text", found(*read)));
        return;
    }
    value = read->get<std::string>();
}

void JsonReader::texts(const char* key, std::vector<std::string>& values, std::size_t most) {
    const Json* list = take_list(key, most);
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        if (!(*list)[k].is_string()) {
            refuse("json.texts", key, fmt::format("has {}; allowed are texts", found((*list)[k])));
            return;
        }
        values.push_back((*list)[k].get<std::string>());
    }
}

void JsonReader::flag(const char* key, bool& value) {
    const Json* read = take(key);
    if (read == nullptr) {
        return;
    }
    if (!read->is_boolean()) {
        refuse("json.flag", key, fmt::format("is {}; allowed are true and false", found(*read)));
        return;
    }
    value = read->get<bool>();
}

void JsonReader::flag_or(const char* key, bool& value, bool left_out) {
    known_.insert(key);
    value = left_out;
    if (!refusal_->error && object_ != nullptr && object_->contains(key)) {
        flag(key, value);
    }
}

std::uint64_t JsonReader::whole_of(const char* key, std::uint64_t most) {
    const Json* read = take(key);
    if (read == nullptr) {
        return 0;
    }
    if (!read->is_number_unsigned() || read->get<std::uint64_t>() > most) {
        refuse("json.whole", key,
               fmt::format("is {}; allowed are whole numbers from 0 to {}", found(*read), most));
        return 0;
    }
    return read->get<std::uint64_t>();
}

void JsonReader::number(const char* key, float& value) {
    double read = static_cast<double>(value);
    number(key, read);
    value = static_cast<float>(read);
}

void JsonReader::number(const char* key, double& value) {
    const Json* read = take(key);
    if (read == nullptr) {
        return;
    }
    if (!read->is_number()) {
        refuse("json.number", key, fmt::format("is {}; allowed is a number", found(*read)));
        return;
    }
    value = read->get<double>();
}

void JsonReader::number_or(const char* key, double& value, double left_out) {
    known_.insert(key);
    value = left_out;
    if (!refusal_->error && object_ != nullptr && object_->contains(key)) {
        const Json& read = (*object_)[key];
        if (!read.is_number()) {
            refuse("json.number_left_out", key, fmt::format("is {}; allowed is a number", found(read)));
            return;
        }
        value = read.get<double>();
    }
}

void JsonReader::numbers(const char* key, std::span<double> values) {
    const Json* list = take_list(key, values.size());
    if (list == nullptr) {
        return;
    }
    const bool all = std::all_of(list->begin(), list->end(), [](const Json& v) { return v.is_number(); });
    if (list->size() != values.size() || !all) {
        refuse("json.numbers", key,
               fmt::format("is {}; allowed is a list of {} numbers", found(*list), values.size()));
        return;
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = (*list)[k].get<double>();
    }
}

void JsonReader::triples(const char* key, std::vector<glm::dvec3>& values, std::size_t most) {
    const Json* list = take_list(key, most);
    for (std::size_t k = 0; list != nullptr && k < list->size(); ++k) {
        const Json& item = (*list)[k];
        if (!item.is_array() || item.size() != 3 || !item[0].is_number() || !item[1].is_number() ||
            !item[2].is_number()) {
            refuse("json.triples", key, fmt::format("has {}; allowed are lists of 3 numbers", found(item)));
            return;
        }
        values.emplace_back(item[0].get<double>(), item[1].get<double>(), item[2].get<double>());
    }
}

std::size_t JsonReader::word_of(const char* key, std::span<const std::string_view> words) {
    std::string word;
    text(key, word);
    const auto known = std::find(words.begin(), words.end(), word);
    if (known == words.end()) {
        refuse("json.choice", key,
               fmt::format("is '{}'; allowed are {}", printable(word, 40), fmt::join(words, " and ")));
        return 0;
    }
    return static_cast<std::size_t>(known - words.begin());
}

void JsonReader::name_in(const char* key, std::uint32_t& index, std::span<const std::string> names,
                         std::string_view otherwise) {
    std::string name;
    text(key, name);
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
        refuse("json.name", key, fmt::format("is '{}', {}", printable(name, 40), otherwise));
        return;
    }
    index = static_cast<std::uint32_t>(known - names.begin());
}

void JsonReader::finish() {
    if (refusal_->error || object_ == nullptr) {
        return;
    }
    for (const auto& [key, value] : object_->items()) {
        if (!known_.contains(key)) {
            refusal_->refuse("json.unknown_field", place_of(printable(key, 40).c_str()),
                             "is not a field of " + refusal_->document);
            return;
        }
    }
}

Json parse_json(Refusal& refusal, std::string_view text, std::size_t max_depth) {
    std::vector<std::set<std::string>> open_objects;
    std::size_t values = 0;
    const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if (refusal.error) {
            return false; // discard everything
        }
        const bool ends = event == Json::parse_event_t::object_end || event == Json::parse_event_t::array_end;
        values += ends ? 0 : 1;
        if (values > max_manifest_values) {
            refusal.refuse("json.too_many_values", refusal.document,
                           fmt::format("holds more than {} values; allowed are fewer", max_manifest_values));
            return false;
        }
        const bool begins =
            event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (begins && depth >= static_cast<int>(max_depth)) {
            refusal.refuse("json.too_deep", refusal.document,
                           fmt::format("has more than {} objects and lists inside each other", max_depth));
            return false;
        }
        if (event == Json::parse_event_t::object_start) {
            open_objects.emplace_back();
        } else if (event == Json::parse_event_t::object_end) {
            open_objects.pop_back();
        } else if (event == Json::parse_event_t::key) {
            std::set<std::string>& names = open_objects.back();
            if (!names.insert(parsed.get<std::string>()).second) {
                refusal.refuse("json.name_twice", printable(parsed.get<std::string>(), 40),
                               "occurs twice in one object");
            } else if (names.size() > max_object_names) {
                refusal.refuse(
                    "json.too_many_names", refusal.document,
                    fmt::format("has an object of more than {} names; allowed are fewer", max_object_names));
            }
        }
        return true;
    };
    try {
        return Json::parse(text, watch);
    } catch (const Json::parse_error& error) {
        refusal.refuse("json.syntax", refusal.document,
                       fmt::format("is not JSON in UTF-8 (at byte {})", error.byte));
    } catch (const Json::exception&) {
        refusal.refuse("json.too_large_number", refusal.document, "holds a number that is too large");
    }
    return {};
}

} // namespace frustumscreen::pack
