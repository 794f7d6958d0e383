/// Losses and guesses while a model is read, for the curator.
///
/// Threads  values; any.
#pragma once

#include "assets_baked/bake/source_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace frustumscreen::bake {

class LoadNotes {
public:
    template <typename... Arguments>
    void lost(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add({SourceNote::Kind::Lost, fmt::format(format, std::forward<Arguments>(arguments)...)});
    }
    template <typename... Arguments>
    void guessed(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add({SourceNote::Kind::Guessed, fmt::format(format, std::forward<Arguments>(arguments)...)});
    }
    [[nodiscard]] std::vector<SourceNote> take() { return std::move(notes_); }

private:
    /// Keeps equal notes once, and at most 20 notes.
    void add(SourceNote note) {
        constexpr std::size_t most = 20;
        const bool is_known = std::any_of(notes_.begin(), notes_.end(),
                                          [&](const SourceNote& each) { return each.text == note.text; });
        if (!is_known && notes_.size() < most) {
            notes_.push_back(std::move(note));
        }
    }

    std::vector<SourceNote> notes_;
};

/// "1 face", "2 faces".
[[nodiscard]] inline std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

} // namespace frustumscreen::bake
