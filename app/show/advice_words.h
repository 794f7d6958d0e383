/// The exhibit's own texts in the languages that it shows: pictures for the table, recordings for the loudspeaker.
///
/// Units    metres on the table.
/// Threads  read on any thread, without a context; the render thread uploads the pictures (LoadedTexts).
/// Memory   recordings stay encoded as in the file; prompt_reader.h decodes those that are spoken.
/// Errors   the file cannot be read or is not a file of words.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/residency/artifact_texts.h"
#include "app/residency/prompt_reader.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace frustumscreen::show {

/// One sentence, wrapped to each of the captions' widths, and spoken.
struct AdviceWord {
    std::size_t first_picture = 0; ///< index into AdviceWords::pictures: one for each of AdviceText::sizes_m
    residency::SharedRecording recording; ///< none: silent
};

struct AdviceWords {
    std::vector<exhibit::AdviceLanguage> languages; ///< for the exhibit
    std::vector<std::vector<AdviceWord>> words;     ///< [language][text], in the same order
    residency::TextPictures pictures;
};

struct AdviceWordsRequest {
    std::filesystem::path file;
    std::vector<std::string> languages; ///< shown ones; the nearest of the file's are read
    double em_m = 0.010;
    double texels_per_m = 2400.0;
    bool spoken = false;
    bool room = false; ///< a screen behind the table shows a room: it has an invitation of its own
};

[[nodiscard]] Result<AdviceWords> read_advice_words(const AdviceWordsRequest& request);

/// A set's own invitation, in place of the exhibit's, while no visitor is present. The exhibit need not have texts of
/// its own.
struct AttractLine {
    std::string language; ///< BCP 47
    std::string text;
};
/// Sets the line nearest to the house's `language` in the kiosk's typeface, and ignores the others.
[[nodiscard]] Result<void> set_attract_line(std::span<const AttractLine> lines, const std::string& language,
                                            const residency::TextStyle& style, AdviceWords& words);

} // namespace frustumscreen::show
