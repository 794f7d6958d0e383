/// Who speaks a text: a recording of the museum's, else a program that takes text on its standard input and writes WAV to its
/// standard output.
///
/// Without another program espeak-ng speaks, where it knows the sounds: not letters that it would spell (Japanese kanji, Cyrillic
/// in an English text), and not languages that leave vowels out (Hebrew, Arabic). Single words of another language it may read
/// as that language.
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

namespace frustumscreen {

/// What became of a text.
struct Spoken {
    std::optional<Speech> speech;
    std::string why_silent; ///< where there is no speech
};

class Voice {
public:
    /// espeak-ng.
    Voice() = default;
    /// A program with its arguments, separated by blanks; `{language}` in them is replaced by the text's language.
    explicit Voice(std::string_view program, ProgramLimits limits = {});

    /// Why this voice cannot speak `text`, a sentence; nothing if it can.
    [[nodiscard]] std::optional<std::string> why_silent(std::string_view text,
                                                        const std::string& language) const;
    /// A voice that says nothing had nothing to speak; that is no error.
    [[nodiscard]] Result<Spoken> speak(std::string_view text, const std::string& language) const;

private:
    [[nodiscard]] std::vector<std::string> command_for(const std::string& language) const;

    std::vector<std::string> program_; ///< empty: espeak-ng
    ProgramLimits limits_;
};

} // namespace frustumscreen
