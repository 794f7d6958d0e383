#include "assets_baked/texts/fonts.h"

#include <fmt/format.h>
#include <fontconfig/fontconfig.h>
#include <pango/pango.h>

#include <array>
#include <utility>

namespace frustumscreen::texts {

namespace {

/// Only Debian's folders, and the caches made when their packages are installed. Without hinting, because
/// texts are set at any size.
constexpr const char* noto_alone =
    R"(<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd"><fontconfig>
<dir>/usr/share/fonts/truetype/noto</dir><dir>/usr/share/fonts/opentype/noto</dir>
<cachedir>/var/cache/fontconfig</cachedir><cachedir prefix="xdg">fontconfig</cachedir>
<selectfont><acceptfont><glob>*/NotoSans*</glob></acceptfont><rejectfont><glob>*</glob></rejectfont></selectfont>
<match target="pattern"><edit name="hinting" mode="assign"><bool>false</bool></edit>
<edit name="hintstyle" mode="assign"><const>hintnone</const></edit></match>
</fontconfig>)";

/// The scripts with a family of their own; Noto Sans itself has Latin, Greek and Cyrillic.
constexpr std::array<std::pair<PangoScript, const char*>, 19> families{{
    {PANGO_SCRIPT_ARABIC, "Arabic"},     {PANGO_SCRIPT_ARMENIAN, "Armenian"},
    {PANGO_SCRIPT_BENGALI, "Bengali"},   {PANGO_SCRIPT_DEVANAGARI, "Devanagari"},
    {PANGO_SCRIPT_ETHIOPIC, "Ethiopic"}, {PANGO_SCRIPT_GEORGIAN, "Georgian"},
    {PANGO_SCRIPT_GUJARATI, "Gujarati"}, {PANGO_SCRIPT_GURMUKHI, "Gurmukhi"},
    {PANGO_SCRIPT_HANGUL, "CJK KR"},     {PANGO_SCRIPT_HEBREW, "Hebrew"},
    {PANGO_SCRIPT_KANNADA, "Kannada"},   {PANGO_SCRIPT_KHMER, "Khmer"},
    {PANGO_SCRIPT_LAO, "Lao"},           {PANGO_SCRIPT_MALAYALAM, "Malayalam"},
    {PANGO_SCRIPT_MYANMAR, "Myanmar"},   {PANGO_SCRIPT_SINHALA, "Sinhala"},
    {PANGO_SCRIPT_TAMIL, "Tamil"},       {PANGO_SCRIPT_TELUGU, "Telugu"},
    {PANGO_SCRIPT_THAI, "Thai"},
}};

PangoScript script_of(std::string_view language) {
    int count = 0;
    const PangoScript* scripts =
        pango_language_get_scripts(pango_language_from_string(std::string(language).c_str()), &count);
    return count > 0 ? scripts[0] : PANGO_SCRIPT_LATIN;
}

bool begins_with_subtag(std::string_view language, std::string_view subtag) {
    return language.starts_with(subtag) &&
           (language.size() == subtag.size() || language[subtag.size()] == '-');
}

/// Han letters look different in each region.
const char* han_family(std::string_view language) {
    const auto has = [&](std::string_view part) { return language.find(part) != std::string_view::npos; };
    if (begins_with_subtag(language, "ja")) {
        return "CJK JP";
    }
    if (begins_with_subtag(language, "ko")) {
        return "CJK KR";
    }
    if (begins_with_subtag(language, "yue") || has("-HK") || has("-MO")) {
        return "CJK HK";
    }
    if (begins_with_subtag(language, "zh")) {
        return has("Hant") || has("-TW") ? "CJK TC" : "CJK SC";
    }
    return nullptr;
}

} // namespace

std::string family_of(std::string_view language) {
    if (const char* han = han_family(language); han != nullptr) {
        return fmt::format("Noto Sans {}", han);
    }
    const PangoScript script = script_of(language);
    for (const auto& [of, name] : families) {
        if (of == script) {
            return fmt::format("Noto Sans {}", name);
        }
    }
    return "Noto Sans";
}

pack::TextDirection direction_of(std::string_view language) {
    switch (script_of(language)) {
    case PANGO_SCRIPT_ARABIC:
    case PANGO_SCRIPT_HEBREW:
    case PANGO_SCRIPT_SYRIAC:
    case PANGO_SCRIPT_THAANA:
    case PANGO_SCRIPT_NKO:
        return pack::TextDirection::RightToLeft;
    default:
        return pack::TextDirection::LeftToRight;
    }
}

void Fonts::Free::operator()(_FcConfig* config) const {
    FcConfigDestroy(config);
}
Fonts::Fonts(Fonts&&) noexcept = default;
Fonts& Fonts::operator=(Fonts&&) noexcept = default;
Fonts::~Fonts() = default;

Result<Fonts> Fonts::open() {
    Fonts fonts;
    fonts.config_.reset(FcConfigCreate());
    const bool read =
        fonts.config_ != nullptr &&
        FcConfigParseAndLoadFromMemory(fonts.config_.get(), reinterpret_cast<const FcChar8*>(noto_alone),
                                       FcTrue) == FcTrue &&
        FcConfigBuildFonts(fonts.config_.get()) == FcTrue;
    if (!read) {
        return fail(ErrorKind::Internal, "typeface.no_fontconfig", "typefaces: fontconfig cannot start");
    }
    return fonts;
}

Result<void> Fonts::check(std::string_view language) const {
    const std::string family = family_of(language);
    const FcFontSet* set = FcConfigGetFonts(config_.get(), FcSetSystem);
    for (int k = 0; set != nullptr && k < set->nfont; ++k) {
        FcChar8* name = nullptr;
        for (int n = 0; FcPatternGetString(set->fonts[k], FC_FAMILY, n, &name) == FcResultMatch; ++n) {
            if (family == reinterpret_cast<const char*>(name)) {
                return {};
            }
        }
    }
    const bool cjk = family.find("CJK") != std::string::npos;
    return fail(
        ErrorKind::BadConfiguration, "typeface.not_installed",
        "the language '{}' needs the typeface {}, which is not installed; install Debian's package {}",
        language, family, cjk ? "fonts-noto-cjk" : "fonts-noto-core");
}

std::string Fonts::families_for(std::string_view language) const {
    const std::string family = family_of(language);
    return family == "Noto Sans" ? family : family + ",Noto Sans";
}

} // namespace frustumscreen::texts
