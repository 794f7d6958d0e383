/// A voice: a program that takes text on its standard input and writes WAV to its standard output.
///
/// By default espeak-ng speaks, if it knows the sounds: not letters that it would spell (Japanese kanji,
/// Cyrillic in an English text), and not languages written without vowels (Hebrew, Arabic). It may read
/// single words of another language as that language.
///
/// Errors   one sentence: the program cannot be started, hangs, fails, or writes no recording.
/// Threads  any; waits for the program.
#pragma once

#include "assets_baked/texts/level_speech.h"
#include "firmware_host/base/result.h"
#include "firmware_host/base/run_program.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::texts {

/// The result for one text.
struct Spoken {
    std::optional<Speech> speech;
    std::string why_silent; ///< set without speech
};

class Voice {
public:
    /// espeak-ng.
    Voice() = default;
    /// A program with its arguments, separated by blanks; `{language}` in them is replaced by the text's
    /// language.
    explicit Voice(std::string_view program, ProgramLimits limits = {});

    /// A sentence if this voice cannot speak `text`; otherwise nullopt.
    [[nodiscard]] std::optional<std::string> why_silent(std::string_view text,
                                                        const std::string& language) const;
    /// A silent recording means that the text has nothing to speak; this is not an error.
    [[nodiscard]] Result<Spoken> speak(std::string_view text, const std::string& language) const;

private:
    [[nodiscard]] std::vector<std::string> command_for(const std::string& language) const;

    std::vector<std::string> program_; ///< empty: espeak-ng
    ProgramLimits limits_;
};

} // namespace frustumscreen::texts
