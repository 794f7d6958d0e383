/// Reads one TOML table key by key: every key that is asked for is consumed, and any key left over is refused.
/// Walks describe_settings.h and ignores its sentences.
///
/// Errors   the first one of a file is kept in `ReadState`, as one line: file, line, key, what was found,
///          what is allowed. After an error every call leaves its value unchanged, so callers need not check
///          each call.
/// Threads  one caller.
#pragma once

#include "app/geometry/transform.h"
#include "app/settings/range.h"
#include "firmware_host/base/result.h"

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen::settings {

/// Line of every key that was read, by its dotted name; a key missing in the file has none.
using KeyLines = std::map<std::string, std::uint32_t, std::less<>>;

struct ReadState {
    std::string file;
    std::filesystem::path folder; ///< relative paths start here
    KeyLines lines;
    std::optional<Error> error;

    void refuse(MessageId id, std::uint32_t line, std::string_view what);
    /// 0: the file does not have this key.
    [[nodiscard]] std::uint32_t line_of(std::string_view key) const;
};

/// `file:line: what`, or `file: what` if the line is 0.
[[nodiscard]] std::string located(std::string_view file, std::uint32_t line, std::string_view what);

class TableReader {
public:
    /// `table` may be null: every key is then left out. `name` is empty for the whole file.
    TableReader(ReadState& state, const toml::table* table, std::string name, std::uint32_t line = 0);

    static constexpr bool reads = true;

    [[nodiscard]] bool has(std::string_view key) const;
    void number(std::string_view key, double& value, const Range& range, std::string_view sentence = {});
    void vector(std::string_view key, glm::dvec3& value, const Range& range, std::string_view sentence = {});
    /// Two numbers.
    void pair(std::string_view key, glm::dvec2& value, const Range& range);
    /// As many points as `values` has.
    void points(std::string_view key, std::span<glm::dvec3> values, const Range& range,
                std::string_view sentence = {});
    void input(std::string_view key, double& value, const Range& range, std::string_view /*sentence*/) {
        number(key, value, range);
    }
    void input(std::string_view key, glm::dvec3& value, const Range& range, std::string_view /*sentence*/) {
        vector(key, value, range);
    }
    /// 16 numbers, column-major.
    void rigid(std::string_view key, geometry::RigidTransform& value, const Range& range,
               std::string_view sentence);
    void flag(std::string_view key, bool& value, std::string_view sentence);
    void integer(std::string_view key, int& value, int low, int high, std::string_view sentence);
    void integer(std::string_view key, std::uint64_t& value, std::string_view sentence);
    void text(std::string_view key, std::string& value, std::string_view sentence = {});
    /// A text of any length, or empty; the caller checks it.
    void any_text(std::string_view key, std::string& value);
    void long_text(std::string_view key, std::string& value, std::string_view /*sentence*/) {
        any_text(key, value);
    }
    /// Texts under keys that the file chooses: { key = "text", ... }, in the keys' order.
    void named_texts(std::string_view key, std::vector<std::pair<std::string, std::string>>& values,
                     std::size_t most);
    void texts(std::string_view key, std::vector<std::string>& values, std::size_t most,
               std::string_view sentence = {});
    void path(std::string_view key, std::filesystem::path& value, std::string_view sentence);
    void paths(std::string_view key, std::vector<std::filesystem::path>& values, std::size_t most,
               std::string_view sentence);
    /// The value is the index of the word found.
    template <typename Choice>
    void choice(std::string_view key, Choice& value, std::span<const std::string_view> words,
                std::string_view /*sentence*/) {
        value = static_cast<Choice>(word_of(key, static_cast<std::size_t>(value), words));
    }
    /// A text with a meaning: `from_text` returns nothing for a text that is not `allowed`.
    template <typename Value>
    void parsed(std::string_view key, Value& value, const auto& to_text, const auto& from_text,
                std::string_view allowed, std::string_view /*sentence*/) {
        std::string written = to_text(value);
        text(key, written);
        if (const auto read = from_text(written)) {
            value = *read;
        } else {
            refuse_text(key, written, allowed);
        }
    }
    /// The same for each text of a list; a missing key leaves `values` as they are.
    template <typename Value>
    void parsed_list(std::string_view key, std::vector<Value>& values, std::size_t most,
                     const auto& /*to_text*/, const auto& from_text, std::string_view allowed,
                     std::string_view /*sentence*/) {
        std::vector<std::string> written;
        texts(key, written, most);
        if (!has(key)) {
            return;
        }
        values.clear();
        for (const std::string& each : written) {
            if (const auto read = from_text(each)) {
                values.push_back(*read);
            } else {
                refuse_text(key, each, allowed);
            }
        }
    }
    void table(std::string_view key, std::string_view /*sentence*/, const auto& describe) {
        TableReader inner = table_of(key);
        describe(inner);
        inner.finish();
    }
    /// One value for each table of the list `key`.
    template <typename Value>
    void tables(std::string_view key, std::vector<Value>& values, std::size_t most, const auto& describe,
                std::string_view /*sentence*/) {
        for (TableReader& item : tables_of(key, most)) {
            describe(item, values.emplace_back());
            item.finish();
        }
    }
    /// Refuses `key` with `what` ("is ...; allowed ...") unless `well`.
    void require(MessageId id, bool well, std::string_view key, std::string_view what) {
        if (!well) {
            refuse(id, key, what);
        }
    }
    /// Refuses `key` if one of `others` is present as well.
    void one_way(std::string_view key, std::initializer_list<std::string_view> others,
                 std::string_view words);
    /// Refuses keys that were not asked for. Call it last.
    void finish();

    /// Refuses `key` with `what` ("is ...; allowed ..."), at its line.
    void refuse(MessageId id, std::string_view key, std::string_view what);
    /// `file:line: name` of a key that was read, for messages about its value.
    [[nodiscard]] std::string place(std::string_view key) const;
    /// The keys asked for so far.
    [[nodiscard]] std::span<const std::string> known() const { return known_; }

private:
    [[nodiscard]] std::string full_name(std::string_view key) const;
    /// The table's own line for a key that is missing.
    [[nodiscard]] std::uint32_t line_of_key(std::string_view name) const;
    const toml::node* take(std::string_view key);
    void read_matrix(std::string_view key, glm::dmat4& value, const Range& range);
    bool number_of(const toml::node& node, const std::string& name, double& value, const Range& range);
    bool point_of(const toml::array& array, const std::string& name, glm::dvec3& value, const Range& range);
    bool text_of(const toml::node& node, const std::string& name, std::string& value);
    void refuse_text(std::string_view key, std::string_view found, std::string_view allowed);
    /// The index of the word found; `usual` if the key is missing.
    [[nodiscard]] std::size_t word_of(std::string_view key, std::size_t usual,
                                      std::span<const std::string_view> words);
    [[nodiscard]] TableReader table_of(std::string_view key);
    [[nodiscard]] std::vector<TableReader> tables_of(std::string_view key, std::size_t most);
    const toml::array* list_of(std::string_view key, std::size_t least, std::size_t most,
                               std::string_view allowed_items);

    ReadState* state_;
    const toml::table* table_;
    std::string name_;
    std::uint32_t line_;
    std::vector<std::string> known_;
};

} // namespace frustumscreen::settings
