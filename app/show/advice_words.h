/// The exhibit's own words in the languages that it shows: pictures for the table, prompts for the loudspeaker.
///
/// Units    metres on the table.
/// Threads  made on the render thread before the first frame.
/// Errors   the file cannot be read or is none of words. A word that cannot be played is silent, and a note says so.
#pragma once

#include "app/exhibit/exhibit.h"
#include "app/render/gpu_store.h"
#include "firmware_host/base/result.h"
#include "firmware_host/sound/prompt.h"

#include <filesystem>
#include <string>
#include <vector>

namespace frustumscreen {

/// One sentence, wrapped to each of the captions' widths, and spoken.
struct AdviceWord {
    std::vector<TextureId> textures; ///< one for each of AdviceText::sizes_m
    SharedPrompt prompt;             ///< none: it is silent
};

struct AdviceWords {
    std::vector<AdviceLanguage> languages;      ///< for the exhibit
    std::vector<std::vector<AdviceWord>> words; ///< [language][text], in the same order
    std::uint64_t planned_gpu_bytes = 0;
    std::vector<std::string> notes;
};

struct AdviceWordsRequest {
    std::filesystem::path file;
    std::vector<std::string> languages; ///< that are shown; the nearest ones are read
    double em_m = 0.010;
    double texels_per_m = 2400.0;
    bool spoken = false;
};

[[nodiscard]] Result<AdviceWords> load_advice_words(const AdviceWordsRequest& request, GpuStore& store);

} // namespace frustumscreen
