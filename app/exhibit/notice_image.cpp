#include "app/exhibit/notice_image.h"

#include "app/typography/captions.h"
#include "app/typography/coverage.h"
#include "app/typography/glyph_image.h"
#include "app/typography/ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace frustumscreen::exhibit {

namespace {

using Coverage = image::Image<std::uint8_t>;

/// Lengths in type sizes.
constexpr double wide_em = 36.0;   ///< the width for which texts are broken at the bake
constexpr double middle_em = 25.0; ///< beside a prop in the middle of the table
constexpr double narrow_em = 18.0;
constexpr double narrowest_em = 9.0;
constexpr double max_label_share = 0.36; ///< of the width, if beside a word
constexpr double between_columns_em = 1.0;
constexpr double number_em = 2.5;
constexpr double between_lines_em = 0.3;
constexpr double between_packs_em = 0.5; ///< if a pack takes two lines
constexpr double below_sentences_em = 0.7;
constexpr double beside_ring_em = 1.0;
constexpr double fades_over_em = 1.5;

constexpr double ring_reach_m = notice_ring_radius_m + typography::ring_gap_m + typography::ring_width_m;

/// Set text, and the row of its first baseline.
struct SetText {
    Coverage image;
    int baseline = 0;
};

/// The place of a text, from the side where the reader begins: from the right for languages that run from there.
struct Piece {
    SetText text;
    int from_begin = 0;
    int top = 0;
    double brightness = 1.0;
};

class Page {
public:
    Page(const NoticeType& type, double width_em)
        : type_(type), em_px_(typography::min_caption_em_m * type.texels_per_m), width_em_(width_em) {}

    void sentences(const std::vector<std::string_view>& keys, bool ring) {
        const int ring_px = ring ? px_of(2.0 * ring_reach_m * type_.texels_per_m / em_px_) : 0;
        const bool beside = ring && width_em_ > narrowest_em;
        const int indent = beside ? ring_px + px_of(beside_ring_em) : 0;
        top_ = ring && !beside ? ring_px + px_of(between_lines_em) : 0;
        const std::size_t first = pieces_.size();
        for (const std::string_view key : keys) {
            add(word(key, width_em_, width_em_ > narrowest_em ? typography::caption_title_em : 1.0), indent,
                top_ + (pieces_.size() > first ? px_of(between_lines_em) : 0), 1.0);
        }
        if (beside) { // centre text and ring on each other
            const int lower = std::max(0, (ring_px - top_) / 2);
            for (std::size_t k = first; k < pieces_.size(); ++k) {
                pieces_[k].top += lower;
            }
            top_ = std::max(top_, ring_px);
        }
        if (ring) {
            reach(0, ring_px, top_);
            ring_px_ = glm::dvec2(0.5 * ring_px, beside ? 0.5 * top_ : 0.5 * ring_px);
        }
    }

    /// Lines in two columns: labels and words.
    void columns(const std::vector<NoticeLine>& lines) {
        std::vector<SetText> labels;
        int column = 0;
        for (const NoticeLine& line : lines) {
            labels.push_back(label(line, max_label_share * width_em_));
            column = std::max(column, labels.back().image.width);
        }
        column += px_of(between_columns_em);
        for (std::size_t k = 0; k < lines.size(); ++k) {
            top_ += px_of(k == 0 ? below_sentences_em : between_lines_em);
            row(std::move(labels[k]), word(lines[k].key, width_em_ - column / em_px_), column);
        }
    }

    /// Lines with words below labels, or beside them if both fit in one line.
    void stacked(const std::vector<NoticeLine>& lines) {
        const bool numbers =
            std::all_of(lines.begin(), lines.end(), [](const NoticeLine& line) { return line.file.empty(); });
        if (numbers) {
            columns(lines);
            return;
        }
        for (const NoticeLine& line : lines) {
            top_ += px_of(&line == &lines.front() ? below_sentences_em : between_packs_em);
            SetText name = label(line, width_em_);
            const int least = line.file.empty() ? px_of(number_em) : 0; // numbers share one column
            const int column = std::max(name.image.width, least) + px_of(between_columns_em);
            const double left_em = width_em_ - column / em_px_;
            const pack::GlyphSetting* const setting =
                typography::fitting_setting(type_.runs.find(line.key), left_em);
            if (setting != nullptr && setting->lines.size() == 1 &&
                setting->width <= left_em * pack::em_units) {
                row(std::move(name), word(line.key, left_em), column);
            } else {
                add(std::move(name), 0, top_, 1.0);
                add(word(line.key, width_em_), 0, top_, typography::caption_text_brightness);
            }
        }
    }

    /// Uses the kiosk's own typeface, from left to right: the remark is English, for a technician.
    void remark(const std::string& text) {
        if (text.empty() || !type_.typesetter.can_set(text)) {
            return;
        }
        const typography::Paragraph paragraph{
            .text = text, .em_px = em_px_, .bold = false, .brightness = 1.0, .space_before_px = 0.0};
        top_ += px_of(between_packs_em);
        add({type_.typesetter.set(std::span(&paragraph, 1), width_em_ * em_px_), 0}, 0, top_,
            typography::caption_text_brightness);
    }

    [[nodiscard]] NoticeShape drawn() const {
        NoticeShape shape;
        shape.image.coverage = Coverage(std::max(width_, 1), std::max(height_, 1));
        Coverage& page = shape.image.coverage;
        for (const Piece& piece : pieces_) {
            const int left =
                to_the_left() ? page.width - piece.from_begin - piece.text.image.width : piece.from_begin;
            typography::draw_lighter(piece.text.image, piece.brightness, left, piece.top, page);
        }
        const glm::dvec2 size_px(page.width, page.height);
        shape.image.size_m = size_px / type_.texels_per_m;
        if (ring_px_) {
            const double x = to_the_left() ? size_px.x - ring_px_->x : ring_px_->x;
            shape.ring_m =
                glm::dvec2(x - 0.5 * size_px.x, 0.5 * size_px.y - ring_px_->y) / type_.texels_per_m;
        }
        return shape;
    }

private:
    [[nodiscard]] int px_of(double em) const { return static_cast<int>(std::lround(em * em_px_)); }
    [[nodiscard]] bool to_the_left() const {
        return !type_.runs.texts.empty() &&
               type_.runs.texts.front().direction == pack::TextDirection::RightToLeft;
    }

    /// Sets a word. `em`: its type size.
    [[nodiscard]] SetText word(std::string_view key, double width_em, double em = 1.0) const {
        const pack::GlyphSetting* const setting =
            typography::fitting_setting(type_.runs.find(key), width_em / em);
        if (setting == nullptr || setting->lines.empty()) {
            return {};
        }
        typography::GlyphImage image =
            typography::glyph_image(type_.runs, type_.atlas, *setting, em * em_px_);
        const double baseline_px = setting->lines.front().baseline * em * em_px_ / pack::em_units;
        return {std::move(image.coverage), image.top_px + static_cast<int>(std::lround(baseline_px))};
    }

    [[nodiscard]] SetText label(const NoticeLine& line, double max_em) const {
        const typography::Typesetter& typesetter = type_.typesetter;
        const bool has_file = !line.file.empty() && typesetter.can_set(line.file);
        const std::string& text = typesetter.can_set(line.label) ? line.label
                                  : has_file                     ? line.file
                                                                 : "\u2013";
        Coverage image = typesetter.line(text, em_px_);
        if (image.width > px_of(max_em)) {
            image = typography::cut_off(image, px_of(max_em), px_of(fades_over_em), false);
        }
        return {std::move(image), px_of(typography::Typesetter::ascent_em)};
    }

    /// Puts a name and an outcome on one baseline.
    void row(SetText name, SetText outcome, int column) {
        const int baseline = top_ + std::max(name.baseline, outcome.baseline);
        const int name_top = baseline - name.baseline;
        const int outcome_top = baseline - outcome.baseline;
        add(std::move(name), 0, name_top, 1.0);
        add(std::move(outcome), column, outcome_top, typography::caption_text_brightness);
    }

    void add(SetText text, int from_begin, int top, double brightness) {
        if (text.image.width > 0) {
            reach(from_begin, text.image.width, top + text.image.height);
            pieces_.push_back(
                {.text = std::move(text), .from_begin = from_begin, .top = top, .brightness = brightness});
        }
    }
    void reach(int from_begin, int width, int bottom) {
        width_ = std::max(width_, from_begin + width);
        height_ = std::max(height_, bottom);
        top_ = std::max(top_, bottom);
    }

    const NoticeType& type_;
    double em_px_;
    double width_em_;
    std::vector<Piece> pieces_;
    std::optional<glm::dvec2> ring_px_; ///< from the side where the reader begins, and from the top
    int width_ = 0, height_ = 0;
    int top_ = 0; ///< where the next piece begins
};

NoticeShape shape_of(const NoticeText& text, double width_em, bool in_columns, const NoticeType& type) {
    Page page(type, width_em);
    page.sentences(text.sentences, text.ring);
    if (in_columns) {
        page.columns(text.lines);
    } else {
        page.stacked(text.lines);
    }
    page.remark(text.remark);
    return page.drawn();
}

} // namespace

NoticePicture draw_notice(const NoticeText& text, const NoticeText& counts, const NoticeType& type) {
    NoticePicture picture{text, {}, {}};
    picture.shapes.push_back(shape_of(text, wide_em, true, type));
    picture.shapes.push_back(shape_of(text, middle_em, true, type));
    picture.shapes.push_back(shape_of(counts, narrow_em, false, type));
    picture.shapes.push_back(shape_of(counts, narrowest_em, false, type));
    for (const NoticeShape& shape : picture.shapes) {
        picture.sizes_m.push_back(shape.image.size_m);
    }
    return picture;
}

} // namespace frustumscreen::exhibit
