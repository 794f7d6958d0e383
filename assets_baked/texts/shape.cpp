#include "assets_baked/texts/shape.h"

#include "assets_baked/texts/check_text.h"
#include "firmware_host/base/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fontconfig/fontconfig.h>
#include <pango/pangofc-font.h>
#include <pango/pangoft2.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace frustumscreen::texts {

namespace {

/// The size at which texts are shaped. Pango's units are 1/1024 of a pixel in 32 bits: the longest allowed
/// word must not overflow them, and the rounding, 1/8192 em, is invisible in projection.
constexpr int shaping_px = 8;
constexpr std::size_t max_named_letters = 10;

struct Unref {
    void operator()(void* object) const { g_object_unref(object); }
};
struct FreeDescription {
    void operator()(PangoFontDescription* description) const { pango_font_description_free(description); }
};
template <typename Object> using Owned = std::unique_ptr<Object, Unref>;

/// Converts Pango's units at the shaping size to 1/1024 em.
std::int32_t em_units_of(std::int64_t pango_units) {
    static_assert(pack::em_units == PANGO_SCALE);
    return static_cast<std::int32_t>(std::lround(static_cast<double>(pango_units) / shaping_px));
}

std::int32_t em_units_up(int pango_units) {
    return static_cast<std::int32_t>(std::ceil(static_cast<double>(pango_units) / shaping_px));
}

FontFace face_of(PangoFont* font) {
    FcPattern* pattern = pango_fc_font_get_pattern(PANGO_FC_FONT(font));
    FcChar8* file = nullptr;
    int index = 0;
    FcPatternGetString(pattern, FC_FILE, 0, &file);
    FcPatternGetInteger(pattern, FC_INDEX, 0, &index);
    return {file == nullptr ? "" : reinterpret_cast<const char*>(file), index};
}

/// Collects the glyphs of one text over its settings.
class Collector {
public:
    explicit Collector(ShapedText& text) : text_(text) {}

    void add_line(PangoLayoutLine* line, std::int32_t x_units, ShapedSetting& setting) {
        std::int64_t pen = 0;
        for (const GSList* each = line->runs; each != nullptr; each = each->next) {
            add_run(*static_cast<const PangoGlyphItem*>(each->data), x_units, pen, setting);
        }
    }
    [[nodiscard]] const std::set<char32_t>& missing() const { return missing_; }

private:
    void add_run(const PangoGlyphItem& run, std::int32_t x_units, std::int64_t& pen, ShapedSetting& setting) {
        const std::uint32_t face = number_of(face_of(run.item->analysis.font));
        for (int k = 0; k < run.glyphs->num_glyphs; ++k) {
            const PangoGlyphInfo& info = run.glyphs->glyphs[k];
            const bool unknown = (info.glyph & PANGO_GLYPH_UNKNOWN_FLAG) != 0;
            if (unknown) {
                missing_.insert(static_cast<char32_t>(info.glyph & ~PANGO_GLYPH_UNKNOWN_FLAG));
            } else if (info.glyph != PANGO_GLYPH_EMPTY) {
                setting.glyphs.push_back(
                    {.face = face,
                     .glyph = info.glyph,
                     .x = x_units + em_units_of(pen + info.geometry.x_offset),
                     .up = static_cast<std::int16_t>(em_units_of(-info.geometry.y_offset - run.y_offset))});
            }
            pen += info.geometry.width;
        }
    }
    std::uint32_t number_of(const FontFace& face) {
        const auto found = std::find(text_.faces.begin(), text_.faces.end(), face);
        if (found == text_.faces.end()) {
            text_.faces.push_back(face);
            return static_cast<std::uint32_t>(text_.faces.size() - 1);
        }
        return static_cast<std::uint32_t>(found - text_.faces.begin());
    }

    ShapedText& text_;
    std::set<char32_t> missing_;
};

struct Measures {
    int widest = 0, ascent = 0, descent = 0; ///< over the lines; Pango's units
};

Measures measure(PangoLayout* layout) {
    Measures measures;
    for (const GSList* each = pango_layout_get_lines_readonly(layout); each != nullptr; each = each->next) {
        PangoRectangle logical{};
        pango_layout_line_get_extents(static_cast<PangoLayoutLine*>(each->data), nullptr, &logical);
        measures.widest = std::max(measures.widest, logical.width);
        measures.ascent = std::max(measures.ascent, -logical.y);
        measures.descent = std::max(measures.descent, logical.height + logical.y);
    }
    return measures;
}

ShapedSetting set_lines(PangoLayout* layout, std::int32_t limit, pack::TextDirection direction,
                        Collector& collector) {
    const Measures measures = measure(layout);
    const std::int32_t pitch = em_units_up(measures.ascent + measures.descent);
    ShapedSetting setting;
    setting.limit = limit;
    setting.width = em_units_up(measures.widest);
    for (const GSList* each = pango_layout_get_lines_readonly(layout); each != nullptr; each = each->next) {
        auto* line = static_cast<PangoLayoutLine*>(each->data);
        PangoRectangle logical{};
        pango_layout_line_get_extents(line, nullptr, &logical);
        const bool flush_right = direction == pack::TextDirection::RightToLeft;
        const std::size_t before = setting.glyphs.size();
        collector.add_line(line, flush_right ? setting.width - em_units_of(logical.width) : 0, setting);
        setting.lines.push_back({em_units_up(measures.ascent) + setting.height,
                                 static_cast<std::uint32_t>(setting.glyphs.size() - before)});
        setting.height += pitch;
    }
    return setting;
}

Result<void> check_limits(const TextToShape& text) {
    const bool allowed = !text.limits.empty() && text.limits.size() <= pack::glyph_limits::max_settings &&
                         std::all_of(text.limits.begin(), text.limits.end(), [](std::int32_t limit) {
                             return limit >= pack::em_units && limit <= pack::glyph_limits::max_side;
                         });
    return allowed ? Result<void>()
                   : bad_input("text.widths",
                               "the widths are {}; allowed are 1 to {} of 1 to {} times the type size",
                               fmt::join(text.limits, ", "), pack::glyph_limits::max_settings,
                               pack::glyph_limits::max_side / pack::em_units);
}

/// A single word of this many letters takes Pango a second or two; the time grows with the square of its
/// length.
Result<void> check_length(std::string_view text) {
    const auto letters = static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
    return letters <= max_shaped_letters
               ? Result<void>()
               : bad_input("text.letters", "the text has {} letters; allowed are {}: shorten it", letters,
                           max_shaped_letters);
}

Result<void> check_size(const ShapedSetting& setting) {
    using namespace pack::glyph_limits;
    if (setting.lines.size() > max_lines || setting.glyphs.size() > max_glyphs || setting.height > max_side ||
        setting.width > max_side) {
        return bad_input(
            "text.setting",
            "the text takes {} lines and {} letters at a width of {} times the type size; allowed are {} "
            "lines, {} letters and a height of {} times the type size: shorten it",
            setting.lines.size(), setting.glyphs.size(), setting.limit / pack::em_units, max_lines,
            max_glyphs, max_side / pack::em_units);
    }
    return {};
}

void note_missing(const std::set<char32_t>& missing, const std::string& language, ShapedText& shaped) {
    std::size_t named = 0;
    for (const char32_t code : missing) {
        if (++named > max_named_letters) {
            shaped.notes.push_back(
                fmt::format("{} more letters are in no typeface", missing.size() - max_named_letters));
            return;
        }
        shaped.notes.push_back(fmt::format(
            "the letter {} in a text of the language '{}' is in no Noto typeface and is left out; "
            "write it with other letters",
            named_letter(code), language));
    }
}

} // namespace

struct Shaper::Engine {
    Owned<PangoFontMap> map;
    Owned<PangoContext> context;
};

Shaper::Shaper(Fonts fonts, std::unique_ptr<Engine> engine)
    : fonts_(std::move(fonts)), engine_(std::move(engine)) {}
Shaper::Shaper(Shaper&&) noexcept = default;
Shaper& Shaper::operator=(Shaper&&) noexcept = default;
Shaper::~Shaper() = default;

Result<Shaper> Shaper::open() {
    TRY(Fonts fonts, Fonts::open());
    auto engine = std::make_unique<Engine>();
    engine->map.reset(pango_ft2_font_map_new());
    pango_fc_font_map_set_config(PANGO_FC_FONT_MAP(engine->map.get()), fonts.config());
    engine->context.reset(pango_font_map_create_context(engine->map.get()));
    pango_context_set_round_glyph_positions(engine->context.get(), FALSE);
    return Shaper(std::move(fonts), std::move(engine));
}

Result<ShapedText> Shaper::shape(const TextToShape& text) const {
    for (const Result<void>& checked : {check_shaped_text(text.text), check_length(text.text),
                                        check_limits(text), fonts_.check(text.language)}) {
        TRY_VOID(checked);
    }
    ShapedText shaped;
    shaped.direction = direction_of(text.language);
    PangoContext* context = engine_->context.get();
    pango_context_set_language(context, pango_language_from_string(text.language.c_str()));
    pango_context_set_base_dir(context, shaped.direction == pack::TextDirection::RightToLeft
                                            ? PANGO_DIRECTION_RTL
                                            : PANGO_DIRECTION_LTR);
    const std::unique_ptr<PangoFontDescription, FreeDescription> description(pango_font_description_new());
    pango_font_description_set_family(description.get(), fonts_.families_for(text.language).c_str());
    pango_font_description_set_weight(description.get(), text.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_font_description_set_absolute_size(description.get(), shaping_px * PANGO_SCALE);

    const Owned<PangoLayout> layout(pango_layout_new(context));
    pango_layout_set_auto_dir(layout.get(), FALSE);
    pango_layout_set_font_description(layout.get(), description.get());
    pango_layout_set_text(layout.get(), text.text.data(), static_cast<int>(text.text.size()));

    Collector collector(shaped);
    std::vector<std::int32_t> limits = text.limits;
    std::sort(limits.begin(), limits.end(), std::greater<>());
    for (const std::int32_t limit : limits) {
        pango_layout_set_width(layout.get(), limit * shaping_px);
        pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD);
        const bool fits = measure(layout.get()).widest <= limit * shaping_px;
        if (!fits && limit != limits.front()) {
            continue;
        }
        if (!fits) {
            shaped.notes.push_back(fmt::format(
                "'{}': a word is wider than {:.1f} times the type size, the widest that the text may "
                "be, and is broken anywhere; write it with a hyphen or a soft hyphen",
                printable(text.text, 60), static_cast<double>(limit) / pack::em_units));
            pango_layout_set_wrap(layout.get(), PANGO_WRAP_WORD_CHAR);
        }
        shaped.settings.push_back(set_lines(layout.get(), limit, shaped.direction, collector));
        if (const Result<void> sized = check_size(shaped.settings.back()); !sized) {
            if (limit == limits.front()) {
                return tl::unexpected<Error>(sized.error());
            }
            shaped.settings.pop_back();
        }
    }
    note_missing(collector.missing(), text.language, shaped);
    return shaped;
}

} // namespace frustumscreen::texts
