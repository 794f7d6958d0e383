/// Reads one TOML table key by key: every key that is asked for is consumed, what is left over is refused.
///
/// Errors   the first one of a file is kept in `ReadState`, as one line: file, line, key, what was found,
///          what is allowed. After it every call leaves its value alone, so callers read on without asking.
/// Threads  one caller.
#pragma once

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frustumscreen {

/// Allowed values of a number, both ends included; `unit` is a plural word or empty.
struct Range {
    double low = 0.0;
    double high = 0.0;
    std::string_view unit;
};

/// Line of every key that was read, by its dotted name; a key that the file leaves out has none.
using KeyLines = std::map<std::string, std::uint32_t, std::less<>>;

struct ReadState {
    std::string file;
    KeyLines lines;
    std::optional<std::string> error;

    void refuse(std::uint32_t line, std::string_view what);
};

/// `file:line: what`, without a line where there is none.
[[nodiscard]] std::string located(std::string_view file, std::uint32_t line, std::string_view what);
[[nodiscard]] std::string allowed(const Range& range);

class TableReader {
public:
    /// `table` may be null: every key is then left out. `name` is empty for the whole file.
    TableReader(ReadState& state, const toml::table* table, std::string name, std::uint32_t line = 0);

    [[nodiscard]] bool has(std::string_view key) const;
    void number(std::string_view key, double& value, const Range& range);
    void flag(std::string_view key, bool& value);
    void integer(std::string_view key, int& value, int low, int high);
    void integer(std::string_view key, std::uint64_t& value);
    void text(std::string_view key, std::string& value);
    void texts(std::string_view key, std::vector<std::string>& values, std::size_t most);
    void vector(std::string_view key, glm::dvec3& value, const Range& range);
    /// 16 numbers, column-major.
    void matrix(std::string_view key, glm::dmat4& value, const Range& range);
    /// Index of the word found in `words`.
    void choice(std::string_view key, int& index, std::span<const std::string_view> words);
    [[nodiscard]] TableReader table(std::string_view key);
    /// One reader for each table of the list `key`.
    [[nodiscard]] std::vector<TableReader> tables(std::string_view key, std::size_t most);
    /// Refuses what nobody asked for. Call once, last.
    void finish();

    /// Refuses `key` with `what` ("is ...; allowed ..."), at its line.
    void refuse(std::string_view key, std::string_view what);
    [[nodiscard]] std::string full_name(std::string_view key) const;
    /// `file:line: name` of a key that was read, for messages about what it names.
    [[nodiscard]] std::string place(std::string_view key) const;

private:
    [[nodiscard]] std::uint32_t line_of_key(std::string_view name) const;
    const toml::node* take(std::string_view key);
    bool number_of(const toml::node& node, const std::string& name, double& value, const Range& range);
    bool text_of(const toml::node& node, const std::string& name, std::string& value);
    const toml::array* list_of(std::string_view key, std::size_t least, std::size_t most,
                               std::string_view allowed_items);

    ReadState* state_;
    const toml::table* table_;
    std::string name_;
    std::uint32_t line_;
    std::vector<std::string> known_;
};

} // namespace frustumscreen
