#include "app/typography/text_image.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace frustumscreen::typography {

namespace {

constexpr std::array<const char*, 3> debian_folders{"/usr/share/fonts/truetype/dejavu",
                                                    "/usr/share/fonts/truetype/ttf-dejavu",
                                                    "/usr/local/share/fonts/dejavu"};
constexpr double descent_em = 0.27;

struct CloseFace {
    void operator()(FT_Face face) const { FT_Done_Face(face); }
};
using Face = std::unique_ptr<FT_FaceRec_, CloseFace>;

struct CloseLibrary {
    void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};

/// The next code point of UTF-8 text; U+FFFD for an invalid byte.
char32_t next_code_point(std::string_view& text) {
    constexpr char32_t replacement = 0xFFFD;
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned char lead = byte(0);
    const std::size_t length = lead < 0x80   ? 1
                               : lead < 0xC2 ? 0
                               : lead < 0xE0 ? 2
                               : lead < 0xF0 ? 3
                               : lead < 0xF5 ? 4
                                             : 0;
    char32_t code = length == 1 ? lead : lead & (0xFFU >> (length + 1));
    bool sound = length > 0 && length <= text.size();
    for (std::size_t k = 1; sound && k < length; ++k) {
        sound = (byte(k) & 0xC0U) == 0x80U;
        code = (code << 6U) | (byte(k) & 0x3FU);
    }
    constexpr std::array<char32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    sound = sound && code >= least[length] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    text.remove_prefix(sound ? length : 1);
    return sound ? code : replacement;
}

std::u32string decode(std::string_view text) {
    std::u32string codes;
    while (!text.empty()) {
        codes.push_back(next_code_point(text));
    }
    return codes;
}

/// Letters of scripts that run from right to left, join or stack, and characters that control text direction.
bool needs_shaping(char32_t code) {
    return (code >= 0x0590 && code < 0x10A0) || (code >= 0x1100 && code < 0x1200) ||
           (code >= 0x1700 && code < 0x1C80) || (code >= 0x200B && code < 0x2010) ||
           (code >= 0x202A && code < 0x202F) || (code >= 0x2060 && code < 0x2070) ||
           (code >= 0xFB1D && code < 0xFE10) || code >= 0xFE70;
}

void set_size(FT_Face face, double em_px) {
    FT_Set_Char_Size(face, 0, static_cast<FT_F26Dot6>(std::lround(std::clamp(em_px, 1.0, 2000.0) * 64.0)), 72,
                     72);
}

double kerning(FT_Face face, char32_t left, char32_t right) {
    FT_Vector delta{};
    if (left == 0 || FT_Get_Kerning(face, FT_Get_Char_Index(face, left), FT_Get_Char_Index(face, right),
                                    FT_KERNING_UNFITTED, &delta) != 0) {
        return 0.0;
    }
    return static_cast<double>(delta.x) / 64.0;
}

double advance(FT_Face face, char32_t code) {
    if (FT_Load_Char(face, code, FT_LOAD_NO_HINTING) != 0) {
        return 0.0;
    }
    return static_cast<double>(face->glyph->linearHoriAdvance) / 65536.0;
}

struct Line {
    std::u32string text;
    double width_px = 0.0;
    const Paragraph* paragraph = nullptr;
};

double width_of(FT_Face face, std::u32string_view text) {
    double width = 0.0;
    char32_t before = 0;
    for (const char32_t code : text) {
        width += kerning(face, before, code) + advance(face, code);
        before = code;
    }
    return width;
}

/// Number of characters of a text on its first line, and number consumed, including the space after them.
struct Cut {
    std::size_t shown = 0;
    std::size_t used = 0;
};
Cut first_line(FT_Face face, std::u32string_view text, double limit_px) {
    double width = 0.0;
    char32_t before = 0;
    Cut at_space;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == U'\n') {
            return {k, k + 1};
        }
        if (text[k] == U' ') {
            at_space = {k, k + 1};
        }
        width += kerning(face, before, text[k]) + advance(face, text[k]);
        before = text[k];
        if (width > limit_px && text[k] != U' ' && k > 0) {
            return at_space.used > 0 ? at_space : Cut{k, k};
        }
    }
    return {text.size(), text.size()};
}

void break_lines(FT_Face face, const Paragraph& paragraph, double limit_px, std::vector<Line>& lines) {
    const std::u32string codes = decode(paragraph.text);
    std::u32string_view rest = codes;
    while (!rest.empty()) {
        const Cut cut = first_line(face, rest, limit_px);
        const std::u32string_view shown = rest.substr(0, cut.shown);
        lines.push_back({std::u32string(shown), width_of(face, shown), &paragraph});
        rest.remove_prefix(cut.used);
    }
}

/// Draws a glyph's coverage, keeping the lighter value, so that touching neighbours do not add up.
void blend(const FT_GlyphSlot& glyph, double brightness, int left, int top,
           image::Image<std::uint8_t>& image) {
    const FT_Bitmap& bitmap = glyph->bitmap;
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row) {
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
            const int x = left + column;
            const int y = top + row;
            if (x >= 0 && y >= 0 && x < image.width && y < image.height) {
                const double cover = brightness * bitmap.buffer[row * bitmap.pitch + column];
                image.at(x, y) = std::max(image.at(x, y), static_cast<std::uint8_t>(std::lround(cover)));
            }
        }
    }
}

void draw_line(FT_Face face, const Line& line, double x_px, double baseline_px,
               image::Image<std::uint8_t>& image) {
    const double baseline = std::round(baseline_px);
    char32_t before = 0;
    for (const char32_t code : line.text) {
        x_px += kerning(face, before, code);
        before = code;
        FT_Vector part{static_cast<FT_Pos>(std::lround((x_px - std::floor(x_px)) * 64.0)), 0};
        FT_Set_Transform(face, nullptr, &part);
        if (FT_Load_Char(face, code, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) == 0) {
            blend(face->glyph, line.paragraph->brightness,
                  static_cast<int>(std::floor(x_px)) + face->glyph->bitmap_left,
                  static_cast<int>(baseline) - face->glyph->bitmap_top, image);
            x_px += static_cast<double>(face->glyph->linearHoriAdvance) / 65536.0;
        }
    }
    FT_Set_Transform(face, nullptr, nullptr);
}

} // namespace

struct Typesetter::Faces {
    std::unique_ptr<FT_LibraryRec_, CloseLibrary> library; ///< outlives the faces
    Face regular;
    Face bold;

    [[nodiscard]] FT_Face of(const Paragraph& paragraph) const {
        return paragraph.bold ? bold.get() : regular.get();
    }
};

Typesetter::Typesetter(std::unique_ptr<Faces> faces) : faces_(std::move(faces)) {}
Typesetter::Typesetter(Typesetter&&) noexcept = default;
Typesetter& Typesetter::operator=(Typesetter&&) noexcept = default;
Typesetter::~Typesetter() = default;

Result<Typesetter> Typesetter::open(const std::filesystem::path& folder) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) {
        return fail(ErrorKind::Internal, "typeface.no_freetype", "typeface: FreeType cannot start");
    }
    auto faces = std::make_unique<Faces>();
    faces->library.reset(library);
    const auto load = [library](const std::filesystem::path& file) {
        FT_Face face = nullptr;
        return Face(FT_New_Face(library, file.c_str(), 0, &face) == 0 ? face : nullptr);
    };
    std::vector<std::filesystem::path> places(debian_folders.begin(), debian_folders.end());
    if (!folder.empty()) {
        places.assign(1, folder);
    }
    for (const std::filesystem::path& place : places) {
        faces->regular = load(place / "DejaVuSans.ttf");
        faces->bold = load(place / "DejaVuSans-Bold.ttf");
        if (faces->regular && faces->bold) {
            return Typesetter(std::move(faces));
        }
    }
    return fail(ErrorKind::BadConfiguration, "typeface.missing",
                "typeface: DejaVuSans.ttf and DejaVuSans-Bold.ttf are not in " + places.front().string() +
                    "; install Debian's package fonts-dejavu-core");
}

struct Typesetter::Layout {
    std::vector<Line> lines;
    std::vector<double> baselines_px;
    int side_px = 0; ///< margin on the left and right: letters may lean over
    glm::ivec2 size_px{1};
};

Typesetter::Layout Typesetter::lay_out(std::span<const Paragraph> paragraphs, double width_px) const {
    Layout layout;
    std::vector<Line>& lines = layout.lines;
    for (const Paragraph& paragraph : paragraphs) {
        set_size(faces_->of(paragraph), paragraph.em_px);
        break_lines(faces_->of(paragraph), paragraph, width_px, lines);
    }
    if (lines.empty()) {
        return layout;
    }
    double widest = 1.0;
    double y = 0.0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        const Paragraph& paragraph = *lines[k].paragraph;
        const bool begins = k == 0 || lines[k - 1].paragraph != &paragraph;
        y += k == 0 ? ascent_em * paragraph.em_px : line_pitch_em * paragraph.em_px;
        y += begins && k > 0 ? paragraph.space_before_px : 0.0;
        layout.baselines_px.push_back(y);
        widest = std::max(widest, lines[k].width_px);
    }
    const double em = lines.back().paragraph->em_px;
    layout.side_px = static_cast<int>(std::ceil(0.06 * paragraphs.front().em_px));
    layout.size_px = {static_cast<int>(std::ceil(widest)) + 2 * layout.side_px,
                      static_cast<int>(std::ceil(y + descent_em * em))};
    return layout;
}

bool Typesetter::can_set(std::string_view text) const {
    const std::u32string codes = decode(text);
    return std::all_of(codes.begin(), codes.end(), [&](char32_t code) {
        return !needs_shaping(code) && FT_Get_Char_Index(faces_->regular.get(), code) != 0 &&
               FT_Get_Char_Index(faces_->bold.get(), code) != 0;
    });
}

glm::ivec2 Typesetter::extent(std::span<const Paragraph> paragraphs, double width_px) const {
    return lay_out(paragraphs, width_px).size_px;
}

image::Image<std::uint8_t> Typesetter::set(std::span<const Paragraph> paragraphs, double width_px) const {
    const Layout layout = lay_out(paragraphs, width_px);
    image::Image<std::uint8_t> image(layout.size_px.x, layout.size_px.y);
    for (std::size_t k = 0; k < layout.lines.size(); ++k) {
        const Line& line = layout.lines[k];
        FT_Face face = faces_->of(*line.paragraph);
        set_size(face, line.paragraph->em_px);
        draw_line(face, line, layout.side_px, layout.baselines_px[k], image);
    }
    return image;
}

image::Image<std::uint8_t> Typesetter::line(std::string_view text, double em_px, bool bold) const {
    const Paragraph paragraph{
        .text = std::string(text), .em_px = em_px, .bold = bold, .brightness = 1.0, .space_before_px = 0.0};
    return set(std::span(&paragraph, 1), std::numeric_limits<double>::infinity());
}

} // namespace frustumscreen::typography
