#include "app/settings/table_reader.h"

#include "app/settings/found_value.h"
#include "firmware_host/base/letters_apart.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace frustumscreen::settings {

namespace {

constexpr std::size_t longest_text = 4096;
constexpr std::string_view unknown_key = "settings.unknown_key";

/// Distance of a mistyped key from an existing one; a shortened key is near.
std::size_t distance(std::string_view mistyped, std::string_view key) {
    const bool shortened =
        key.substr(0, mistyped.size()) == mistyped || mistyped.substr(0, key.size()) == key;
    return shortened ? 1 : letters_apart(mistyped, key);
}

/// Names that people use for a key but that share no letters with it.
std::string_view usual_name(std::string_view key) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> names{
        {{"volume", "gain_db"}, {"loudness", "gain_db"}, {"size_m", "base_m"}}};
    const auto found =
        std::find_if(names.begin(), names.end(), [key](const auto& name) { return name.first == key; });
    return found != names.end() ? found->second : key;
}

std::uint32_t line_of(const toml::node& node) {
    return static_cast<std::uint32_t>(node.source().begin.line);
}

} // namespace

void ReadState::refuse(MessageId id, std::uint32_t line, std::string_view what) {
    if (!error) {
        error = Error{ErrorKind::BadInput, id, located(file, line, what)};
    } else if (error->id == unknown_key && id == unknown_key) { // all unknown keys are reported at once
        error->message += fmt::format("; line {}: {}", line, what);
    }
}

std::uint32_t ReadState::line_of(std::string_view key) const {
    const auto line = lines.find(key);
    return line != lines.end() ? line->second : 0;
}

std::string located(std::string_view file, std::uint32_t line, std::string_view what) {
    return line > 0 ? fmt::format("{}:{}: {}", file, line, what) : fmt::format("{}: {}", file, what);
}

TableReader::TableReader(ReadState& state, const toml::table* table, std::string name, std::uint32_t line)
    : state_(&state), table_(table), name_(std::move(name)), line_(line) {}

std::string TableReader::full_name(std::string_view key) const {
    return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

bool TableReader::has(std::string_view key) const {
    return table_ != nullptr && table_->contains(key);
}

const toml::node* TableReader::take(std::string_view key) {
    known_.emplace_back(key);
    const toml::node* node = table_ != nullptr ? table_->get(key) : nullptr;
    if (node != nullptr) {
        state_->lines[full_name(key)] = line_of(*node);
    }
    return state_->error ? nullptr : node;
}

std::uint32_t TableReader::line_of_key(std::string_view name) const {
    const std::uint32_t line = state_->line_of(name);
    return line > 0 ? line : line_;
}

void TableReader::refuse(MessageId id, std::string_view key, std::string_view what) {
    const std::string name = full_name(key);
    state_->refuse(id, line_of_key(name), name + " " + std::string(what));
}

std::string TableReader::place(std::string_view key) const {
    const std::string name = full_name(key);
    return located(state_->file, line_of_key(name), name);
}

bool TableReader::number_of(const toml::node& node, const std::string& name, double& value,
                            const Range& range) {
    double read = std::numeric_limits<double>::quiet_NaN();
    if (const auto* integer = node.as_integer()) {
        read = static_cast<double>(integer->get());
    } else if (const auto* number = node.as_floating_point()) {
        read = number->get();
    }
    if (!(read >= range.low && read <= range.high)) {
        state_->refuse("settings.number", line_of(node),
                       fmt::format("{} is {}; allowed are {}", name, found(node), words_of(range)));
        return false;
    }
    value = read;
    return true;
}

bool TableReader::text_of(const toml::node& node, const std::string& name, std::string& value) {
    const auto* text = node.as_string();
    if (text == nullptr || text->get().empty() || text->get().size() > longest_text ||
        text->get().find('\0') != std::string::npos) {
        state_->refuse("settings.long_text", line_of(node),
                       fmt::format("{} is {}; allowed is a text in quotes of 1 to {} bytes", name,
                                   found(node), longest_text));
        return false;
    }
    value = text->get();
    return true;
}

const toml::array* TableReader::list_of(std::string_view key, std::size_t least, std::size_t most,
                                        std::string_view allowed_items) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return nullptr;
    }
    const toml::array* array = node->as_array();
    if (array == nullptr || array->size() < least || array->size() > most) {
        refuse("settings.list", key,
               fmt::format("is {}; allowed is a list of {}", found(*node), allowed_items));
        return nullptr;
    }
    return array;
}

void TableReader::number(std::string_view key, double& value, const Range& range,
                         std::string_view /*sentence*/) {
    if (const toml::node* node = take(key)) {
        number_of(*node, full_name(key), value, range);
    }
}

void TableReader::flag(std::string_view key, bool& value, std::string_view /*sentence*/) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return;
    }
    if (const auto* flag = node->as_boolean()) {
        value = flag->get();
    } else {
        refuse("settings.flag", key, fmt::format("is {}; allowed are true and false", found(*node)));
    }
}

void TableReader::integer(std::string_view key, int& value, int low, int high,
                          std::string_view /*sentence*/) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return;
    }
    const auto* integer = node->as_integer();
    if (integer == nullptr || integer->get() < low || integer->get() > high) {
        refuse("settings.whole", key,
               fmt::format("is {}; allowed are the whole numbers {} to {}", found(*node), low, high));
        return;
    }
    value = static_cast<int>(integer->get());
}

void TableReader::integer(std::string_view key, std::uint64_t& value, std::string_view /*sentence*/) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return;
    }
    const auto* integer = node->as_integer();
    if (integer == nullptr || integer->get() < 0) {
        refuse("settings.whole_number", key,
               fmt::format("is {}; allowed are the whole numbers from 0 to {}", found(*node),
                           std::numeric_limits<std::int64_t>::max()));
        return;
    }
    value = static_cast<std::uint64_t>(integer->get());
}

void TableReader::text(std::string_view key, std::string& value, std::string_view /*sentence*/) {
    if (const toml::node* node = take(key)) {
        text_of(*node, full_name(key), value);
    }
}

void TableReader::any_text(std::string_view key, std::string& value) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return;
    }
    if (const auto* text = node->as_string()) {
        value = text->get();
    } else {
        refuse("settings.text", key, fmt::format("is {}; allowed is a text in quotes", found(*node)));
    }
}

void TableReader::named_texts(std::string_view key, std::vector<std::pair<std::string, std::string>>& values,
                              std::size_t most) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return;
    }
    const toml::table* table = node->as_table();
    if (table == nullptr || table->size() > most) {
        refuse("settings.texts", key,
               fmt::format("is {}; allowed is a table {{ ... }} of at most {} texts", found(*node), most));
        return;
    }
    for (const auto& [name, item] : *table) {
        const auto* text = item.as_string();
        if (text == nullptr) {
            state_->refuse("settings.text_of_table", line_of(item),
                           fmt::format("{}.{} is {}; allowed is a text in quotes", full_name(key),
                                       printable(name.str(), 60), found(item)));
            return;
        }
        values.emplace_back(name.str(), text->get());
    }
}

void TableReader::texts(std::string_view key, std::vector<std::string>& values, std::size_t most,
                        std::string_view /*sentence*/) {
    const toml::array* array =
        list_of(key, 0, most, fmt::format("at most {} texts, in brackets: {} = [\"...\"]", most, key));
    if (array == nullptr) {
        return;
    }
    std::vector<std::string> read(array->size());
    for (std::size_t i = 0; i < array->size(); ++i) {
        if (!text_of(*array->get(i), fmt::format("{}[{}]", full_name(key), i), read[i])) {
            return;
        }
    }
    values = std::move(read);
}

void TableReader::path(std::string_view key, std::filesystem::path& value, std::string_view /*sentence*/) {
    std::string written;
    text(key, written);
    if (!written.empty()) {
        value = (state_->folder / written).lexically_normal();
    }
}

void TableReader::paths(std::string_view key, std::vector<std::filesystem::path>& values, std::size_t most,
                        std::string_view /*sentence*/) {
    std::vector<std::string> written;
    texts(key, written, most);
    for (const std::string& each : written) {
        values.push_back((state_->folder / each).lexically_normal());
    }
}

void TableReader::one_way(std::string_view key, std::initializer_list<std::string_view> others,
                          std::string_view words) {
    const bool beside =
        std::any_of(others.begin(), others.end(), [&](std::string_view other) { return has(other); });
    require("settings.two_ways", !(has(key) && beside), key,
            fmt::format("stands beside {}; allowed is one of the two ways", words));
}

void TableReader::refuse_text(std::string_view key, std::string_view found, std::string_view allowed) {
    refuse("settings.meaning", key,
           fmt::format("is the text \"{}\"; allowed are {}", printable(found, 40), allowed));
}

std::size_t TableReader::word_of(std::string_view key, std::size_t usual,
                                 std::span<const std::string_view> words) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return usual;
    }
    const auto* text = node->as_string();
    const auto word = text != nullptr ? std::find(words.begin(), words.end(), text->get()) : words.end();
    if (word == words.end()) {
        refuse("settings.choice", key,
               fmt::format("is {}; allowed are \"{}\"", found(*node), fmt::join(words, "\", \"")));
        return usual;
    }
    return static_cast<std::size_t>(word - words.begin());
}

TableReader TableReader::table_of(std::string_view key) {
    const toml::node* node = take(key);
    const toml::table* table = node != nullptr ? node->as_table() : nullptr;
    if (node != nullptr && table == nullptr) {
        refuse("settings.table", key,
               fmt::format("is {}; allowed is a table, [{}]", found(*node), full_name(key)));
    }
    return {*state_, table, full_name(key), node != nullptr ? line_of(*node) : 0};
}

std::vector<TableReader> TableReader::tables_of(std::string_view key, std::size_t most) {
    std::vector<TableReader> readers;
    const toml::array* array = list_of(key, 0, most, fmt::format("at most {} tables {{ ... }}", most));
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
        const toml::node& node = *array->get(i);
        const std::string name = fmt::format("{}[{}]", full_name(key), i);
        if (!node.is_table()) {
            state_->refuse("settings.table_of_list", line_of(node),
                           fmt::format("{} is {}; allowed is a table {{ ... }}", name, found(node)));
        }
        readers.emplace_back(*state_, node.as_table(), name, line_of(node));
    }
    return readers;
}

void TableReader::finish() {
    if (table_ == nullptr || (state_->error && state_->error->id != unknown_key)) {
        return;
    }
    constexpr std::size_t max_told = 5;
    std::vector<const toml::key*> left_over;
    for (const auto& [key, node] : *table_) {
        if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) {
            left_over.push_back(&key);
        }
    }
    std::sort(left_over.begin(), left_over.end(), [](const toml::key* a, const toml::key* b) {
        return a->source().begin.line < b->source().begin.line;
    });
    left_over.resize(std::min(left_over.size(), max_told));
    for (const toml::key* const each : left_over) {
        const std::string key = printable(each->str(), 40);
        const std::string_view meant = usual_name(key);
        const auto nearest =
            std::min_element(known_.begin(), known_.end(), [&](const std::string& a, const std::string& b) {
                return distance(meant, a) < distance(meant, b);
            });
        const std::string advice = nearest != known_.end()
                                       ? fmt::format("; the nearest allowed key is {}", full_name(*nearest))
                                       : std::string();
        state_->refuse("settings.unknown_key", static_cast<std::uint32_t>(each->source().begin.line),
                       fmt::format("{} is not a known key{}", full_name(key), advice));
    }
}

} // namespace frustumscreen::settings
