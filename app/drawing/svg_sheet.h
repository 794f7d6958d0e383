/// A sheet of paper with a technical drawing on it, written as SVG.
///
/// Frame    paper: origin at the top left, x to the right, y down; millimetres. Printed at 100 %, lengths are
///          true.
/// Threads  values; any.
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen::drawing {

struct Pen {
    std::string_view stroke = "#000000";
    double width_mm = 0.25;
    std::string_view fill = "none";
    std::string_view dashes = ""; ///< lengths in mm, as in SVG; empty: a solid line
};

/// The part of a text that is at its position.
enum class TextAnchor { Start, Middle, End };
struct Lettering {
    double height_mm = 2.8; ///< type size; capitals are 0.73 of it
    TextAnchor anchor = TextAnchor::Start;
    double turned_deg = 0.0; ///< clockwise, about its position
    bool bold = false;
};
/// Upper bound of a text's length in the typefaces that a drawing requests.
[[nodiscard]] double length_mm(std::string_view words, double height_mm);

class SvgSheet {
public:
    explicit SvgSheet(const glm::dvec2& size_mm);

    void line(const glm::dvec2& from, const glm::dvec2& to, const Pen& pen);
    /// `name` is written to the file, for programs that read it; empty: none.
    void polygon(std::span<const glm::dvec2> corners, const Pen& pen, std::string_view name = "");
    void circle(const glm::dvec2& middle, double radius_mm, const Pen& pen);
    /// The baseline is at `at`, which the anchor refers to.
    void text(const glm::dvec2& at, std::string_view words, const Lettering& lettering = {});
    /// Begins a view: the following elements have its frame, which the file records.
    void begin_view(std::string_view name, const glm::dvec2& origin_mm, double mm_per_m);
    void end_view();

    /// The whole file.
    [[nodiscard]] std::string take() const;

private:
    glm::dvec2 size_mm_;
    std::string body_;
};

/// Position of a view on the paper: its axes point to the right and up, in metres.
struct View {
    glm::dvec2 origin_mm{0.0};
    double mm_per_m = 1000.0;
    [[nodiscard]] glm::dvec2 operator()(const glm::dvec2& at_m) const {
        return origin_mm + mm_per_m * glm::dvec2(at_m.x, -at_m.y);
    }
    [[nodiscard]] std::vector<glm::dvec2> operator()(std::span<const glm::dvec2> places_m) const;
};

/// The bounding box of a view's content, in metres.
struct Extent {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
    void include(const glm::dvec2& at);
};

/// The view that shows `extent` in the middle of a field of the paper, in the largest standard scale (ISO
/// 5455) that fits.
[[nodiscard]] View fitted_view(const Extent& extent, const glm::dvec2& field_low_mm,
                               const glm::dvec2& field_high_mm);
/// "1 : 10", "2 : 1".
[[nodiscard]] std::string scale_words(const View& view);

/// A length as drawings write it: in millimetres, to a tenth if it is not whole.
[[nodiscard]] std::string mm_words(double metres);

} // namespace frustumscreen::drawing
