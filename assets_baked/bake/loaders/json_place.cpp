#include "assets_baked/bake/loaders/json_place.h"

#include "assets_baked/bake/loaders/refusal.h"
#include "firmware_host/base/json.h"

#include <cmath>

namespace frustumscreen::bake {

void JsonPlace::refuse_type(const char* expected) const {
    const std::string_view place = path_.empty() ? std::string_view("the document") : std::string_view(path_);
    if (value_->is_structured()) {
        refuse_damage("{}: {} is expected, not an {}", place, expected, value_->type_name());
    }
    using Handler = nlohmann::json::error_handler_t;
    const std::string found = value_->dump(-1, ' ', true, Handler::replace);
    refuse_damage("{}: {} is expected, not {}", place, expected, found.substr(0, 40));
}

std::optional<JsonPlace> JsonPlace::find(std::string_view key) const {
    if (!value_->is_object()) {
        refuse_type("an object");
    }
    const auto member = value_->find(key);
    if (member == value_->end()) {
        return std::nullopt;
    }
    std::string path = path_;
    path += path.empty() ? "" : ".";
    path += key;
    return JsonPlace(*member, std::move(path));
}

JsonPlace JsonPlace::at(std::string_view key) const {
    std::optional<JsonPlace> member = find(key);
    if (!member) {
        refuse_damage("{}: \"{}\" is missing", path_.empty() ? "the document" : path_.c_str(), key);
    }
    return *std::move(member);
}

std::vector<std::string> JsonPlace::keys() const {
    if (!value_->is_object()) {
        refuse_type("an object");
    }
    std::vector<std::string> names;
    for (const auto& item : value_->items()) {
        names.push_back(item.key());
    }
    return names;
}

std::set<std::string> JsonPlace::extensions_inside() const {
    std::set<std::string> names;
    std::vector<const nlohmann::json*> left{value_}; // the document may be nested too deeply for a recursion
    while (!left.empty()) {
        const nlohmann::json& value = *left.back();
        left.pop_back();
        if (value.is_array()) {
            for (const nlohmann::json& element : value) {
                left.push_back(&element);
            }
        }
        if (!value.is_object()) {
            continue;
        }
        for (const auto& [key, member] : value.items()) {
            if (key == "extras") {
                continue; // a program's own data
            }
            if (key == "extensions" && member.is_object()) {
                for (const auto& extension : member.items()) {
                    names.insert(extension.key());
                }
            }
            left.push_back(&member);
        }
    }
    return names;
}

std::size_t JsonPlace::size() const {
    if (!value_->is_array()) {
        refuse_type("an array");
    }
    return value_->size();
}

JsonPlace JsonPlace::operator[](std::size_t i) const {
    return {(*value_)[i], path_ + "[" + std::to_string(i) + "]"};
}

std::uint64_t JsonPlace::whole(std::uint64_t least, std::uint64_t most) const {
    // Some exporters write 4.0 for 4.
    const double value = value_->is_number() ? value_->get<double>() : -0.5;
    if (value != std::floor(value)) {
        refuse_type("a whole number");
    }
    if (value < static_cast<double>(least) || value > static_cast<double>(most)) {
        refuse_damage("{}: {} is out of range, {} to {} is allowed", path_, value, least, most);
    }
    return static_cast<std::uint64_t>(value);
}

std::size_t JsonPlace::index_into(std::size_t size) const {
    const std::uint64_t index = whole();
    if (index >= size) {
        refuse_contradiction("{}: {} is out of range, the file has {}", path_, index, size);
    }
    return static_cast<std::size_t>(index);
}

double JsonPlace::number() const {
    if (!value_->is_number()) {
        refuse_type("a number");
    }
    const double value = value_->get<double>();
    if (!std::isfinite(value)) {
        refuse_damage("{}: the number is not finite", path_);
    }
    return value;
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
    if (count != 0 && size() != count) {
        refuse_damage("{}: {} numbers are expected, there are {}", path_, count, size());
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < size(); ++i) {
        values.push_back((*this)[i].number());
    }
    return values;
}

std::string JsonPlace::text() const {
    if (!value_->is_string()) {
        refuse_type("a string");
    }
    return value_->get<std::string>();
}

bool JsonPlace::truth() const {
    if (!value_->is_boolean()) {
        refuse_type("true or false");
    }
    return value_->get<bool>();
}

std::uint64_t JsonPlace::whole_or(std::string_view key, std::uint64_t fallback, std::uint64_t most) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? member->whole(0, most) : fallback;
}

double JsonPlace::number_or(std::string_view key, double fallback) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? member->number() : fallback;
}

std::string JsonPlace::text_or(std::string_view key, std::string_view fallback) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? member->text() : std::string(fallback);
}

bool JsonPlace::truth_or(std::string_view key, bool fallback) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? member->truth() : fallback;
}

std::optional<std::size_t> JsonPlace::index_or_none(std::string_view key, std::size_t size) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? std::optional(member->index_into(size)) : std::nullopt;
}

std::size_t JsonPlace::size_of(std::string_view key) const {
    const std::optional<JsonPlace> member = find(key);
    return member ? member->size() : 0;
}

} // namespace frustumscreen::bake
