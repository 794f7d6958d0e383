#include "app/settings/settings_page.h"

#include "app/settings/describe_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace frustumscreen::settings {

namespace {

constexpr std::string_view head =
    "# Settings\n"
    "\n"
    "The exhibit's settings are a TOML file; [config/kiosk.toml](../config/kiosk.toml) is the one that "
    "ships.\n"
    "Every key may be left out and has its default then; a key that is not here is refused. Coordinates are "
    "the\n"
    "table's (see [conventions.md](conventions.md)), paths are relative to the file's own folder.\n"
    "\n"
    "This page is what `frustumscreen config --describe` prints; it is described in\n"
    "`app/settings/describe_settings.h`.\n";

std::string in_quotes(std::string_view text) {
    return fmt::format("`\"{}\"`", text);
}

/// Walks the description of the settings and writes a row for each.
class Page {
public:
    static constexpr bool reads = false;

    void number(const char* key, double value, const Range& range, std::string_view sentence) {
        row(key, fmt::format("`{}`", value), words_of(range), sentence);
    }
    void vector(const char* key, const glm::dvec3& value, const Range& range, std::string_view sentence) {
        row(key, fmt::format("`[{}, {}, {}]`", value.x, value.y, value.z),
            "3 numbers, each " + words_of(range), sentence);
    }
    void points(const char* key, std::span<const glm::dvec3> values, const Range& range,
                std::string_view sentence) {
        std::vector<std::string> texts;
        for (const glm::dvec3& value : values) {
            texts.push_back(fmt::format("[{}, {}, {}]", value.x, value.y, value.z));
        }
        row(key, fmt::format("`[{}]`", fmt::join(texts, ", ")),
            fmt::format("{} points, each number {}", values.size(), words_of(range)), sentence);
    }
    void input(const char* key, double value, const Range& range, std::string_view sentence) {
        number(key, value, range, sentence);
    }
    void input(const char* key, const glm::dvec3& value, const Range& range, std::string_view sentence) {
        vector(key, value, range, sentence);
    }
    void rigid(const char* key, const geometry::RigidTransform& value, const Range& range,
               std::string_view sentence) {
        const glm::dmat4 matrix = value.matrix();
        const std::span<const double> numbers(&matrix[0][0], 16);
        row(key, fmt::format("`[{}]`", fmt::join(numbers, ", ")), "16 numbers, each " + words_of(range),
            sentence);
    }
    void integer(const char* key, int value, int low, int high, std::string_view sentence) {
        row(key, fmt::format("`{}`", value), fmt::format("whole numbers {} to {}", low, high), sentence);
    }
    void integer(const char* key, std::uint64_t value, std::string_view sentence) {
        row(key, fmt::format("`{}`", value), "whole numbers from 0", sentence);
    }
    void flag(const char* key, bool value, std::string_view sentence) {
        row(key, fmt::format("`{}`", value), "true, false", sentence);
    }
    template <typename Choice>
    void choice(const char* key, Choice value, std::span<const std::string_view> words,
                std::string_view sentence) {
        row(key, in_quotes(words[static_cast<std::size_t>(value)]),
            fmt::format("`\"{}\"`", fmt::join(words, "\"`, `\"")), sentence);
    }
    void text(const char* key, const std::string& value, std::string_view sentence) {
        text_row(key, value, "text", sentence);
    }
    void long_text(const char* key, const std::string& /*value*/, std::string_view sentence) {
        row(key, "", "a text of several lines", sentence);
    }
    template <typename Value>
    void parsed(const char* key, const Value& value, const auto& to_text, const auto& /*from_text*/,
                std::string_view allowed, std::string_view sentence) {
        text_row(key, to_text(value), allowed, sentence);
    }
    void parsed_list(const char* key, const auto& values, std::size_t most, const auto& to_text,
                     const auto& /*from_text*/, std::string_view allowed, std::string_view sentence) {
        std::vector<std::string> texts;
        for (const auto& value : values) {
            texts.push_back(fmt::format("\"{}\"", to_text(value)));
        }
        row(key, fmt::format("`[{}]`", fmt::join(texts, ", ")),
            fmt::format("at most {} texts: {}", most, allowed), sentence);
    }
    void path(const char* key, const std::filesystem::path& /*value*/, std::string_view sentence) {
        row(key, "", "a file", sentence);
    }
    void texts(const char* key, const auto& /*values*/, std::size_t most, std::string_view sentence) {
        row(key, "`[]`", fmt::format("at most {} texts", most), sentence);
    }
    void paths(const char* key, const auto& /*values*/, std::size_t most, std::string_view sentence) {
        row(key, "`[]`", fmt::format("at most {} files", most), sentence);
    }
    template <typename Value>
    void tables(const char* key, const std::vector<Value>& /*values*/, std::size_t most, const auto& describe,
                std::string_view sentence) {
        row(key, "`[]`", fmt::format("at most {} tables", most), sentence);
        prefix_ = fmt::format("{}[].", key);
        const Value usual;
        describe(*this, usual);
        prefix_.clear();
    }
    void table(const char* name, std::string_view sentence, const auto& describe) {
        const std::string outer = table_;
        table_ = outer.empty() ? name : fmt::format("{}.{}", outer, name);
        text_ += fmt::format("\n## [{}]\n\n{}\n\n| key | default | allowed | what it is |\n"
                             "|---|---|---|---|\n",
                             table_, sentence);
        describe(*this);
        table_ = outer;
    }
    void require(MessageId /*id*/, bool /*well*/, const char* /*key*/, std::string_view /*what*/) {}

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    /// An empty text is shown as no default: a person could not write it.
    void text_row(const char* key, const std::string& usual, std::string_view allowed,
                  std::string_view sentence) {
        row(key, usual.empty() ? usual : in_quotes(usual), allowed, sentence);
    }
    void row(const char* key, std::string_view usual, std::string_view allowed, std::string_view sentence) {
        text_ += fmt::format("| `{}{}` | {} | {} | {} |\n", prefix_, key, usual, allowed, sentence);
    }

    std::string text_{head};
    std::string prefix_; ///< of the keys in a list of tables
    std::string table_;  ///< that is being described
};

} // namespace

std::string settings_page() {
    Page page;
    const Settings usual;
    all_settings(page, usual);
    return page.text();
}

} // namespace frustumscreen::settings
