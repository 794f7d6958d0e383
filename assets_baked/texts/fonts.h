/// The typefaces that texts are set in: Debian's Noto Sans for every script, and no others on the machine.
///
/// Threads  one caller (fontconfig's and Pango's objects are not shared).
/// Errors   the typeface that a language needs is not installed: its name, and the Debian package.
/// Library  fontconfig; Pango names the scripts of a language.
#pragma once

#include "app/pack/glyph_runs.h"
#include "firmware_host/base/result.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct _FcConfig;

namespace frustumscreen::texts {

class Fonts {
public:
    [[nodiscard]] static Result<Fonts> open();
    Fonts(Fonts&&) noexcept;
    Fonts& operator=(Fonts&&) noexcept;
    ~Fonts();

    /// Succeeds if the typeface of `language` (BCP 47) is installed; the error names the package to install.
    [[nodiscard]] Result<void> check(std::string_view language) const;
    /// Font families for Pango: the language's own family first.
    [[nodiscard]] std::string families_for(std::string_view language) const;
    [[nodiscard]] _FcConfig* config() const { return config_.get(); }

private:
    struct Free {
        void operator()(_FcConfig* config) const;
    };
    Fonts() = default;
    std::unique_ptr<_FcConfig, Free> config_;
};

/// The Noto Sans family with the letters of `language`.
[[nodiscard]] std::string family_of(std::string_view language);
/// The direction of the language's paragraphs.
[[nodiscard]] pack::TextDirection direction_of(std::string_view language);

} // namespace frustumscreen::texts
