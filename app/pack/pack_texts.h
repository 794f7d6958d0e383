/// The texts of an artifact in forms other than plain text: set as glyph runs (the section `texts`) and spoken (the
/// section `sounds`), in separate parts for each language.
///
/// Keys     `title`, `text`, `attribution` (attribution.h; older packs have `period`, `place`, `maker` and `credit`
///          in its place); `description.0` ... for the description's portions (text_portions.h); `label.0` ... for the
///          hotspots, `behaviour.0` ... for the titles of the behaviours and `torch.0` ... for those of a torch's
///          contents, in their order. A text that is empty, or that could not be set, is missing. The sound of the
///          description has the key `description`.
/// Errors   one line: data that FORMAT.md does not allow; a part that contradicts the manifest. Messages of
///          `load_...` begin with the file's name. A pack without the sections is no error.
/// Threads  pure; any.
#pragma once

#include "app/pack/glyph_runs.h"
#include "app/pack/pack.h"
#include "firmware_host/base/file.h"
#include "firmware_host/base/result.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::pack {

[[nodiscard]] std::string label_key(std::size_t hotspot);
[[nodiscard]] std::string behaviour_key(std::size_t behaviour);
[[nodiscard]] std::string torch_key(std::size_t content);
[[nodiscard]] std::string state_key(std::size_t state);

struct SetLanguage {
    std::string language; ///< BCP 47
    GlyphRuns runs;
    DistanceAtlas atlas;
};

struct SpokenLanguage {
    std::string language;                ///< BCP 47
    std::map<std::string, Bytes> sounds; ///< Ogg Opus by key
};

/// Call each once for a pack; a language without texts or sounds is left out.
void put_sounds(Pack& pack, std::span<const SpokenLanguage> languages);
void put_set_texts(Pack& pack, std::span<const SetLanguage> languages);

/// `NotRead`: layout alone needs no pictures of the glyphs.
enum class Atlases : std::uint8_t { Read, NotRead };
/// The languages that the pack has, of `languages`; parts of others are not read.
[[nodiscard]] Result<std::vector<SetLanguage>> load_set_texts(const std::filesystem::path& file,
                                                              std::span<const std::string> languages,
                                                              Atlases atlases = Atlases::Read);

struct SpokenText {
    std::string language;
    std::string key;
    bool operator==(const SpokenText&) const = default;
};
/// The texts that have a sound.
[[nodiscard]] Result<std::vector<SpokenText>> list_sounds(const PackDescription& pack);

/// Ogg Opus, not decoded; empty if the text is silent. Reads only the sound's part and the manifest.
[[nodiscard]] Result<Bytes> load_sound(const std::filesystem::path& file, std::string_view language,
                                       std::string_view key);

/// Checks both sections against FORMAT.md; `pack` was read whole.
[[nodiscard]] Result<void> check_set_and_spoken(const Pack& pack);

} // namespace frustumscreen::pack
